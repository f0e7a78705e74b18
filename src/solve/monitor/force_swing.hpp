#pragma once

#include <string>
#include <vector>

#include "mesh/mesh.hpp"

namespace railwave {

/// How a contact's normal force oscillates in a run that did not begin in equilibrium, and from when on it is quiet:
/// the dynamic relaxation of thesis 3.3.5, which ends when the oscillation is below a tenth of the static value. That
/// value is the mean over the second half of the run.
class ForceSwing {
 public:
  static constexpr double quiet = 0.1;

  void add(double time, const Vec3& normal_force);

  /// See StateSaver.
  template <class Archive>
  void archive(Archive& archive, const std::string& name) {
    archive.values(name + "_time", time_);
    archive.values(name + "_force", force_);
  }

  /// Half of what lies between the largest and the smallest force from `from` to `to` of the run, over the static
  /// value.
  double swing(double from, double to) const;
  /// s, from when on the force stays within `quiet` of the static value; infinite: it doesn't.
  double quiet_from() const;
  double static_value() const;  ///< N

  /// For people; empty where nothing touched, or too little was seen.
  std::string summary(const std::string& contact) const;

 private:
  std::vector<double> time_, force_;
};

}  // namespace railwave
