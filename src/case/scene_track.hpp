#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "case/scene_bodies.hpp"

/// Tracks and the sleepers under them, of which case/expand.hpp makes parts, connectors and constraints. Keys:
/// keys_track.cpp.
namespace railwave::scene {

/// What is under the rail at one place: half a sleeper, its fastening and its ballast. Absent: as `base` has it.
struct Sleeper : Place {
  enum class Base { concrete, timber };
  Base base = Base::concrete;
  std::string material;                              ///< empty: that of the base
  std::optional<double> half_length, width, height;  ///< m: across the track from its centre, along it, up
  std::optional<std::array<int, 3>> divisions;       ///< elements along x, y, z
  std::optional<double> pad_thickness, pad_length;   ///< m: gap between foot and sleeper, extent along the rail
  std::optional<Vec3> fastening_stiffness, fastening_damping;  ///< N/m, N s/m along x, y, z
  std::optional<double> ballast_stiffness, ballast_damping;    ///< vertical, N/m, N s/m
  std::optional<double> ballast_lateral_stiffness,
      ballast_lateral_damping;  ///< N/m, N s/m under half a sleeper; absent: its middle is held
  std::array<int, 2> fastening_spread{3, 3}, ballast_spread{2, 6};
  enum class Pad { springs, solid };
  Pad pad = Pad::springs;             ///< solid: a body between foot and sleeper, tied to both
  std::optional<double> pad_modulus;  ///< Pa; absent: of the vertical stiffness
  double pad_poissons_ratio = 0.3;
  double pad_density = 1000;          ///< kg/m3
  std::optional<double> pad_damping;  ///< s, stiffness damping; absent: of the vertical stiffness and damping
  int pad_layers = 2;                 ///< elements through its thickness
};

enum class FishplateFit { tie, contact };

/// Half a track or a whole one, generated: see case/expand.hpp for what it becomes.
struct Track : Place {
  RailMesh rail;
  std::string rail_material;          ///< empty: elastic rail steel of its own
  double rail_stiffness_damping = 0;  ///< s, Part::stiffness_damping of the rails
  Vec3 position{0, 0, 0};
  bool mirror = false;                                 ///< all its parts are mirrored
  bool both_rails = false;                             ///< whole sleepers and the other rail
  HourglassType hourglass = HourglassType::stiffness;  ///< of rails and sleepers
  double rail_distance = 0.755;  ///< m, from the track's centre plane to the middle of the rail's foot
  std::string sleeper = "concrete";
  double pitch = 0.6;                   ///< m
  std::optional<double> first_sleeper;  ///< x of the first regular one; absent: half a pitch from the rail's start
  std::vector<double> positions;        ///< x of the regular ones instead
  std::string other_sleeper = "timber";
  std::vector<double> other_positions;
  std::optional<double> pair_position;  ///< x of the middle of a pair of other sleepers
  double pair_distance = 0.24;          ///< m
  std::optional<double> gap_position;   ///< x of the middle of the gap between two rails
  double gap = 0.006;                   ///< m
  bool fishplates = false;              ///< and bolts, at the gap
  FishplateFit fishplate_fit = FishplateFit::tie;
  double fishplate_friction = 0.3;                                 ///< where they are in contact
  std::string fishplate_material;                                  ///< empty: the rail's
  double fishplate_length = 0.6;                                   ///< m
  double fishplate_thickness = 0.02;                               ///< m
  double fishplate_clearance = 0;                                  ///< m
  std::optional<double> fishplate_size;                            ///< m
  std::vector<double> bolt_positions{-0.23, -0.065, 0.065, 0.23};  ///< m along x from the gap's middle
  std::optional<double>
      bolt_height;                  ///< m above the foot's underside, before inclination; absent: the chamber's middle
  double bolt_diameter = 0.024;     ///< m
  double bolt_pretension = 12.5e3;  ///< N
};

}  // namespace railwave::scene
