#pragma once

#include <Eigen/Core>
#include <complex>
#include <optional>
#include <vector>

#include "model/assembled_scene.hpp"

namespace railwave {

/// What a mode of a body of revolution is called.
struct RoundName {
  enum class Kind { axial, radial, circumferential };
  Kind kind = Kind::axial;  ///< the direction in which most of the body's mass moves
  int diameters = 0;        ///< n: nodal diameters
  int circles = 0;          ///< m: nodal circles of the displacement along `kind`
  double order_share = 0;   ///< of the kinetic energy that goes with cos(n angle) and sin(n angle)
  double axial_share = 0, radial_share = 0, circumferential_share = 0;  ///< of the kinetic energy of that order
};

const char* text_of(RoundName::Kind kind);

/// The nodes of a body of revolution, ring by ring round its axis.
class RoundBody {
 public:
  /// Nothing unless most of the part's mass lies in rings of nodes round the axis: along y through the mesh's origin
  /// (wheels, rollers, meshes from files), along z for cylinders.
  static std::optional<RoundBody> of_part(const AssembledScene& assembled, int part);

  /// Fourier analysis round each ring: n is the order with the most kinetic energy; m counts where the displacement
  /// along the radius, a mean over the thickness, changes its sign.
  /// @param motion 3 values by node of the model
  RoundName name(const Eigen::VectorXd& motion) const;

  const Vec3& axis() const { return axis_; }
  const Vec3& centre() const { return centre_; }

 private:
  struct Ring {
    double radius = 0, mass = 0;
    std::vector<int> nodes;
    std::vector<double> angle, share;  ///< rad; of the way round
  };

  /// Nothing unless the nodes go all the way round at about one radius.
  /// @param nodes, local, mass of the part: numbers from its first node on; places about the axis, m; kg
  static std::optional<Ring> ring_of(const std::vector<int>& nodes, const std::vector<Eigen::Vector3d>& local,
                                     const double* mass);

  RoundBody(const Vec3& centre, const Vec3& axis) : centre_(centre), axis_(axis) {}
  int circles(const std::vector<std::complex<double>>& amplitude) const;

  Vec3 centre_, axis_;
  Eigen::Matrix3d frame_;  ///< columns: two directions across the axis, the axis
  std::vector<Ring> rings_;
  int most_orders_ = 0;
};

}  // namespace railwave
