#pragma once

#include <string>
#include <vector>

#include "mesh/mesh.hpp"

namespace railwave {

/// What the monitor checks.
enum class FaultKind {
  not_finite,
  inversion,
  energy,
  speed,
  kinetic,
  hourglass_share,
  hourglass_distortion,
  penetration,
  chatter,
  material,
  yield,
  size,
  shape,
  contact_edge,
  contact_zone,
  contact_lost
};

inline constexpr int fault_kinds = 16;

/// What may have brought a fault about, and how to mend it.
struct Cause {
  std::string name;   ///< short and always the same for the same cause, such as "step beyond contact springs"
  std::string text;   ///< with figures and the mend
  double weight = 0;  ///< the likeliest has the largest
};

/// Something that the monitor found, where and when first, and how likely causes are.
struct Fault {
  FaultKind kind = FaultKind::not_finite;
  bool fatal = false;
  double time = 0;  ///< s
  long step = 0;
  double value = 0, limit = 0;  ///< in the unit of what is monitored
  std::string part;             ///< of the culprit; empty: no part
  std::string contact;          ///< that it is about; each contact is reported by itself; empty: none
  int element = -1;             ///< number among the model's elements, -1: none
  int element_in_part = -1;     ///< number within its part
  int node = -1;                ///< number among the model's nodes, -1: none
  Vec3 place{};                 ///< m, undeformed: where it began
  double element_volume = 0;    ///< m3, of the culprit
  std::vector<Cause> causes;    ///< the likeliest first

  std::string summary() const;  ///< time, step, part, element, place, value against limit, cause and runner-up
};

/// The quantity's name, as in messages.
const char* name_of(FaultKind kind);

/// The key of [monitor] that limits it; null: none does.
const char* key_of(FaultKind kind);

}  // namespace railwave
