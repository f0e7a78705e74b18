#pragma once

#include <random>

#include "modes/modes.hpp"
#include "modes/shifted_matrix.hpp"
#include "modes/stiffness_matrix.hpp"
#include "tests/verify/beam_scene.hpp"

namespace railwave::verify {

inline Eigen::VectorXd random_vector(Eigen::Index size, unsigned seed) {
  std::mt19937 generator(seed);
  std::uniform_real_distribution<double> spread(-1, 1);
  Eigen::VectorXd x(size);
  for (double& value : x) value = spread(generator);
  return x;
}

/// Frequencies (Hz) of a scene's modes that are not rigid.
inline std::vector<double> elastic_frequencies(const scene::Scene& scene, double up_to, int rigid) {
  Model model;
  build_model(scene, model);
  const ModeList list = modes_below(model, up_to);
  std::vector<double> result;
  for (const Mode& mode : list.modes)
    if (!mode.rigid) result.push_back(mode.frequency);
  CHECK(static_cast<int>(list.modes.size() - result.size()) == rigid);
  return result;
}

/// A block whose part has stiffness hourglass control.
inline scene::Scene mode_block(const Vec3& size, const std::array<int, 3>& divisions, double coefficient) {
  scene::Scene scene = block_scene(size, divisions, 1e-3);
  set_hourglass(scene.parts[0], scene::HourglassType::stiffness, coefficient);
  return scene;
}

}  // namespace railwave::verify
