#pragma once

#include "kernels/statics/tangent.hpp"
#include "model/beams/beams.hpp"
#include "model/contact/contact_springs.hpp"

namespace railwave {

/// Collects springs on the host.
class SpringCollector {
 public:
  /// Springs and dashpots of all connectors.
  void add_connectors(const scene::Scene& scene, const std::vector<ConnectorCell>& cells);
  /// A pair's contact springs: along the normal, there with their dashpots, and with friction the stick springs across
  /// it. The spring to a place on a segment becomes four to its corners by the place's shape functions N: (u - sum N
  /// u_k)^2 <= sum N (u - u_k)^2. That is never softer, and hardly less stiff between nodes than on one, where the
  /// slave may be a moment later.
  void add_contact(const std::vector<ContactSpring>& springs, bool friction);
  /// Beams (kernels/beams/beam_tangent.hpp); the rows of their rotations follow the nodes'.
  /// @param beams null: none
  /// @param held as they settle, when bolts keep their pretension whatever their stretch
  void add_beams(const std::shared_ptr<BeamModel>& beams, const NodeArrays& nodes, bool held = true);

  /// Springs and dashpots along all axes from a node to the ground.
  void add_ground(int node, double stiffness, double damping);

  /// One spring between nodes: stretch = sum of weight times displacement along the direction.
  void add_spring(const std::vector<int>& nodes, const std::vector<double>& weights, const Vec3& direction,
                  double stiffness);

  /// What has been collected: spring s has the rows first()[s] ... first()[s + 1] - 1 of node() and share().
  std::size_t count() const { return stiffness_.size(); }
  const std::vector<int>& first() const { return first_; }
  const std::vector<int>& node() const { return node_; }
  const std::vector<Vec3>& share() const { return share_; }
  const std::vector<double>& stiffness() const { return stiffness_; }

  /// Everything collected, to the device, in place of what was there: a GPU takes longer to make arrays anew.
  void bring_to(TangentSprings& springs) const;

 private:
  void add(int node, double weight, const Vec3& direction);
  void add_end(const WeightedNodes& end, double sign, const Vec3& direction);
  void close(double stiffness, double damping);
  void reserve(std::size_t springs);

  std::vector<int> first_{0}, node_;
  std::vector<Vec3> share_;
  std::vector<double> stiffness_, damping_;
};

}  // namespace railwave
