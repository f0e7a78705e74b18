#pragma once

#include "tests/verify/two_blocks.hpp"

namespace railwave::verify {

/// Two blocks, "coarse" below "fine" or beside it along x, tied over a plane where their meshes do not match.
struct TiedBlocks {
  Vec3 size{0.06, 0.06, 0.06};  ///< m, of each
  std::array<int, 3> coarse{3, 3, 3}, fine{9, 9, 9};
  int axis = 2;    ///< along which they follow each other
  double gap = 0;  ///< m, that the tie keeps
  scene::Precision precision = scene::Precision::double_precision;

  std::string end(int side) const { return std::string(".") + "xyz"[axis] + (side < 0 ? "_min" : "_max"); }

  scene::Scene scene(double time) const {
    scene::Scene made = block_scene(size, coarse, time);
    made.path = "tied blocks";
    made.parts[0].name = made.parts[0].mesh = made.meshes[0].name = "coarse";
    set_hourglass(made.parts[0], scene::HourglassType::stiffness, 0.05);
    made.parts.push_back(made.parts[0]);
    made.meshes.push_back(made.meshes[0]);
    made.parts[1].name = made.parts[1].mesh = made.meshes[1].name = "fine";
    made.meshes[1].box.divisions = fine;
    made.parts[1].position[axis] = size[axis] + gap;
    made.solver.precision = precision;
    scene::Tie tie;
    tie.name = "grown";
    tie.slave = "fine" + end(-1);
    tie.master = "coarse" + end(1);
    made.ties.push_back(tie);
    return made;
  }

  /// Pulled along z with 1 MPa, free to contract: the stress is uniaxial everywhere.
  scene::Scene pulled() const {
    scene::Scene made = scene(1e-5);
    for (const char* part : {"coarse", "fine"}) {
      hold(made, std::string(part) + ".x_min", {true, false, false});
      hold(made, std::string(part) + ".y_min", {false, true, false});
    }
    hold(made, "coarse.z_min", {false, false, true});
    add_traction(made, "fine.z_max", {0, 0, 1e6});
    return made;
  }
};

/// Masses as the scheme uses them.
inline std::vector<double> scheme_masses(const Model& model) {
  const auto mass = to_host(model.nodes.mass);
  std::vector<double> values(model.nodes.count);
  for (int n = 0; n < model.nodes.count; ++n) values[n] = mass(n);
  return values;
}

/// Linear and angular momentum of velocities half a step before the present positions.
struct Momentum {
  Vec3 linear{}, angular{};

  explicit Momentum(const Model& model) {
    const auto x = to_host(model.nodes.position), v = to_host(model.nodes.velocity);
    const auto mass = scheme_masses(model);
    for (int n = 0; n < model.nodes.count; ++n) {
      const Vec3 p = mass[n] * Vec3{v(n, 0), v(n, 1), v(n, 2)};
      linear = linear + p;
      angular = angular + cross(Vec3{x(n, 0), x(n, 1), x(n, 2)}, p);
    }
  }
};

}  // namespace railwave::verify
