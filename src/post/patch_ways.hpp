#pragma once

#include <vector>

#include "post/contact_patch.hpp"
#include "post/field_vectors.hpp"
#include "post/patch_identities.hpp"

namespace railwave {

/// Where a contact was at one instant.
struct PatchInstant {
  double time = 0;  ///< s
  bool touches = false;
  Vector centre = Vector::Zero();  ///< m, of the normal force
  double semi_axis = 0;            ///< m, longitudinal
};

/// Velocity of the contact over ground, m/s, at each instant: the slope of a straight line, by least squares, through
/// its centres at that and as many instants before and after as it takes to travel two semi-axes either way, of those
/// that the run has. The mesh shifts a centre by a fraction of a cell, which on this way is little. NaN where nothing
/// touches, and where the contact did not travel a semi-axis in all.
std::vector<Vector> patch_velocity(const std::vector<PatchInstant>& instants);

/// The ways of all patches of a contact over the outputs of a run: which is which, and how fast each moves over ground.
class PatchWays {
 public:
  /// @param rolling direction, of any length
  explicit PatchWays(const Vector& rolling) : identities_(rolling) {}

  /// Adds an output.
  /// @param time s
  /// @return number of each of the solution's patches
  std::vector<int> add(double time, const ContactSolution& solution);

  /// Of the rows that ContactTables::add makes of the same outputs: each patch's own velocity over ground, m/s, from
  /// the slope of its own centre's way (patch_velocity), outputs at which it was not there left out. Row 0 has that of
  /// its only patch, or only one that is not small. NaN where it is not known.
  std::vector<Vector> velocity_of_rows() const;

 private:
  struct Row {
    int number;    ///< of the patch, 0: none
    int sighting;  ///< among the patch's
  };

  PatchIdentities identities_;
  std::vector<std::vector<PatchInstant>> ways_;  ///< of each patch, number 1 first
  std::vector<Row> rows_;
};

}  // namespace railwave
