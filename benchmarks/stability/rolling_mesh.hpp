#pragma once

#include "benchmarks/rolling_scene.hpp"
#include "solve/statics/settle.hpp"

namespace railwave::bench {

/// cases/rolling.toml by the global estimate with penalty springs, which have a border of their own, the wheel
/// standing: without its torque. Not in full: with a solution zone as fine, but of 16 mm by 16 mm instead of 175 by 30,
/// and coarse elsewhere.
inline scene::Scene rolling_mesh_scene(bool full) {
  std::vector<std::string> overrides{"solver.step_estimate=global", "settle.method=automatic", "settle.tolerance=1e-3",
                                     "settle.cache=false", "contacts.tread.algorithm=penalty"};
  if (!full)
    for (const char* more :
         {"meshes.wheel.zone_start=-0.008", "meshes.wheel.zone_length=0.016", "meshes.rail.zone_start=-0.008",
          "meshes.rail.zone_end=0.008", "meshes.wheel.zone_width=0.016", "meshes.rail.zone_width=0.016",
          "meshes.wheel.section_size=0.012", "meshes.rail.section_size=0.012", "meshes.wheel.growth=1.5",
          "meshes.rail.growth=1.5", "meshes.wheel.coarse_size=0.06", "meshes.rail.coarse_size=0.05",
          "meshes.wheel.core_size=0.15", "meshes.rail.core_size=0.05", "meshes.wheel.web_columns=2",
          "meshes.rail.start=-0.08", "meshes.rail.end=0.08"})
      overrides.push_back(more);
  scene::Scene scene = rolling_scene(overrides);
  scene.loads.clear();
  return scene;
}

}  // namespace railwave::bench
