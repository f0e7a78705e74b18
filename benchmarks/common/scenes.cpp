#include "benchmarks/common/scenes.hpp"

#include <fmt/format.h>

#include <cmath>

#include "case/read_case.hpp"
#include "model/host_copy.hpp"

namespace railwave::bench {

std::string project_folder() { return RAILWAVE_BENCH_SOURCE_DIR; }

std::vector<std::string> overrides_of(const Choice& choice, const std::vector<std::string>& parts,
                                      const std::string& material) {
  std::vector<std::string> result;
  for (const std::string& part : parts) result.push_back("parts." + part + ".hourglass=" + choice.hourglass);
  if (choice.precision != "double") result.push_back("solver.precision=" + choice.precision);
  if (choice.material == "bilinear") {
    // The steel of the thesis's tables 4.1 and 4.3.
    result.push_back("materials." + material + ".yield_stress=500e6");
    result.push_back("materials." + material + ".tangent_modulus=21e9");
  }
  return result;
}

scene::Scene block_scene(const Vec3& size, const std::array<int, 3>& divisions, const Choice& choice) {
  auto overrides = overrides_of(choice, {"block"}, "steel");
  overrides.push_back(fmt::format("meshes.block.size=[{:.17g}, {:.17g}, {:.17g}]", size[0], size[1], size[2]));
  overrides.push_back(fmt::format("meshes.block.divisions=[{}, {}, {}]", divisions[0], divisions[1], divisions[2]));
  return read_case(project_folder() + "/benchmarks/cases/block.toml", overrides);
}

scene::Scene block_scene(long elements, const Choice& choice) {
  const int n = std::max(1, static_cast<int>(std::lround(std::cbrt(static_cast<double>(elements)))));
  const int layers = std::max(1, static_cast<int>(std::lround(static_cast<double>(elements) / (double(n) * n))));
  return block_scene({1e-3 * n, 1e-3 * n, 1e-3 * layers}, {n, n, layers}, choice);
}

void set_velocity(Model& model, const std::function<Vec3(const Vec3&)>& field) {
  const auto velocity = to_host(model.nodes.velocity);
  for (int n = 0; n < model.nodes.count; ++n) {
    const Vec3 v = field(model.assembly.nodes[n]);
    for (int i = 0; i < 3; ++i) velocity(n, i) = v[i];
  }
  Kokkos::deep_copy(model.nodes.velocity, velocity);
}

void stir(Model& model) {
  set_velocity(model, [](const Vec3& x) {
    const double k = 200;  // 1/m: waves of 31 mm
    return Vec3{5e-3 * std::cos(k * x[0] + 1) * std::cos(k * x[1]),
                4e-3 * std::sin(k * x[1] + 0.5) * std::cos(k * x[2]),
                3e-3 * std::cos(k * x[2] + 2) * std::sin(k * x[0] + 0.2)};
  });
}

}  // namespace railwave::bench
