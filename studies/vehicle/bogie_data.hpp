#pragma once

#include <array>
#include <string>

#include "interface_motion.hpp"

namespace railwave::vehicle {

/// Springs and dampers side by side, along x, y, z.
struct Suspension {
  Vector stiffness{};  ///< N/m
  Vector damping{};    ///< N s/m
};

/// What of a Railwave case is the interface: forces on a node set along the axes, each with a curve of its own, and the
/// history of the set's motion.
struct Interface {
  std::string set;                   ///< such as "wheelset.journal": target of the loads, one of output.history_sets
  std::array<std::string, 3> loads;  ///< names of load and of curve along x, y, z; empty where nothing acts
};

/// One side of a bogie over the wheelset that Railwave computes: its frame on that one's primary suspension, and, where
/// it has them, a second wheelset behind on the same suspension and the share of the car body above.
struct BogieData {
  Interface interface;
  double gravity = 0;  ///< m/s2, downwards
  double frame_mass = 0;
  double pitch_inertia = 0;  ///< kg m2 about y through the frame's centre, of a frame on two wheelsets
  Suspension primary;

  bool has_trailing_wheelset = false;
  double wheelbase = 0;         ///< m, from the leading to the trailing wheelset
  double trailing_mass = 0;     ///< kg
  double trailing_contact = 0;  ///< N/m, vertically between trailing wheel and an even, rigid rail

  bool has_car_body = false;
  double car_body_mass = 0;  ///< kg
  Suspension secondary;

  Vector start_displacement{};  ///< m, of the frame from its equilibrium
  Vector start_velocity{};      ///< m/s, of the frame besides the train's speed
};

/// Reads a bogie's TOML file. Throws std::runtime_error with file, key and what is wanted for what is not known,
/// missing or out of range.
BogieData read_bogie(const std::string& path);

}  // namespace railwave::vehicle
