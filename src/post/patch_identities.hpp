#pragma once

#include <vector>

#include "post/field_vectors.hpp"

namespace railwave {

/// A patch at one output, as far as its identity depends on it.
struct SeenPatch {
  Vector centre = Vector::Zero();  ///< m, of the normal force
  double size = 0;                 ///< m, larger semi-axis
  bool small = false;              ///< fewer nodes than smallest_patch
};

/// Numbers the patches of a contact from output to output by their places: a patch keeps its number as long as it is
/// where its way so far leads it, whatever its force, also when it was not there at outputs between. Forces take no
/// part in it.
///
/// A patch's way is predicted with its velocity between the last two outputs at which it was seen; where it was seen
/// once, with that of the patch nearest to it; while no velocity is known, with any common motion along the rolling
/// direction, the smallest that fits most patches. Of the pairs of known and seen patches the nearest take each other
/// first, patches of enough nodes before small ones. What lies farther from every predicted place than two to four of
/// the patch's sizes is a new patch.
class PatchIdentities {
 public:
  /// @param rolling direction, of any length
  explicit PatchIdentities(const Vector& rolling) : rolling_(rolling.normalized()) {}

  /// Numbers from 1 of the patches at the next output.
  /// @param time of the output, s, later than that before
  /// @param patches in any order; new ones are numbered in it
  std::vector<int> numbers(double time, const std::vector<SeenPatch>& patches);

 private:
  struct Track {
    SeenPatch last;
    double time = 0;                    ///< s, of `last`
    bool moving = false;                ///< its velocity is known
    Vector velocity = Vector::Zero();   ///< m/s
    Vector predicted = Vector::Zero();  ///< m, at the present output
    double doubt = 0;                   ///< m, of that
  };
  struct Match {
    std::vector<int> track;  ///< of each patch, -1: none
    int large = 0, all = 0;
    double distance = 0;  ///< m, sum
  };

  void predict(double time);
  Match match(const std::vector<SeenPatch>& patches, const Vector& shift) const;

  Vector rolling_;
  std::vector<Track> tracks_;  ///< number 1 first
};

}  // namespace railwave
