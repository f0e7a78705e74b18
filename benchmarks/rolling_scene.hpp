#pragma once

#include <fmt/format.h>

#include <cmath>
#include <string>
#include <vector>

#include "benchmarks/common/scenes.hpp"
#include "case/read_case.hpp"
#include "mesh/build_mesh.hpp"

namespace railwave::bench {

/// Overrides by which cases/rolling.toml has every element size divided by `refinement`: zone, coarse and core sizes
/// of both meshes, and the sizes across their sections.
inline std::vector<std::string> refined_sizes(double refinement) {
  const scene::Scene original = read_case(project_folder() + "/cases/rolling.toml");
  std::vector<std::string> overrides;
  const auto size = [&](const std::string& mesh, const char* key, double value) {
    // Whole micrometres, so that somebody can type them.
    overrides.push_back(fmt::format("meshes.{}.{}={:g}", mesh, key, 1e-6 * std::round(1e6 * value / refinement)));
  };
  const auto all_sizes = [&](const std::string& mesh, const auto& m) {
    size(mesh, "zone_size", m.zone_size);
    size(mesh, "coarse_size", m.coarse_size);
    size(mesh, "core_size", m.core_size);
    // Meshes allow 2 to 12 mm here.
    size(mesh, "section_size", std::fmin(0.012, std::fmax(0.002, m.section_size / refinement)) * refinement);
  };
  for (const auto& source : original.meshes) {
    if (source.type == scene::MeshType::wheel) all_sizes(source.name, source.wheel);
    if (source.type == scene::MeshType::rail) all_sizes(source.name, source.rail);
  }
  return overrides;
}

inline scene::Scene rolling_scene(const std::vector<std::string>& overrides) {
  return read_case(project_folder() + "/cases/rolling.toml", overrides);
}

inline long elements_of(const scene::Scene& scene) {
  long count = 0;
  for (const auto& source : scene.meshes) count += static_cast<long>(build_mesh(source).elements.size());
  return count;
}

/// The overrides that bring the rolling scene nearest to a number of elements, by bisection; a few seconds for a
/// million.
inline std::vector<std::string> sizes_for(long elements) {
  double coarse = 0.5, fine = 6;
  std::vector<std::string> best;
  double least = 1e300;
  for (int trial = 0; trial < 9; ++trial) {
    const double middle = std::sqrt(coarse * fine);
    const auto overrides = refined_sizes(middle);
    const double count = static_cast<double>(elements_of(rolling_scene(overrides)));
    const double off = std::fabs(std::log(count / static_cast<double>(elements)));
    if (off < least) {
      least = off;
      best = overrides;
    }
    if (off < 0.01) break;
    (count > static_cast<double>(elements) ? fine : coarse) = middle;
  }
  return best;
}

/// Moves the wheel's nodes down, so that it presses on the rail from the first step as a loaded wheel does: without
/// settling it would only touch.
inline void press_wheel(const scene::Scene& scene, Assembly& assembly, double overlap) {
  for (const auto& part : assembly.parts)
    for (const auto& source : scene.meshes)
      if (source.type == scene::MeshType::wheel && part.name == source.name)
        for (int n = part.first_node; n < part.first_node + part.node_count; ++n) assembly.nodes[n][2] -= overlap;
}

}  // namespace railwave::bench
