#include <fmt/format.h>

#include "case/usual_sizes.hpp"
#include "solve/monitor/diagnosis.hpp"

namespace railwave {
namespace {

/// Yield stress over Young's modulus: lead's is some 1e-3.
constexpr double lowest_yield = 1e-5;
/// Nearly incompressible: waves are fast for that alone.
constexpr double high_poissons_ratio = 0.49;

struct PartOf {
  const AssembledScene& assembled;
  std::size_t number;
  const std::string& name() const { return assembled.scene.parts[number].name; }
  const Assembly::PartRange& range() const { return assembled.assembly.parts[number]; }
  const scene::Material& material() const { return assembled.scene.materials[range().material]; }
};

Fault fault_of(FaultKind kind, const PartOf& part, double value, double limit, Cause cause) {
  Fault fault;
  fault.kind = kind;
  fault.part = part.name();
  fault.value = value;
  fault.limit = limit;
  fault.causes.push_back(std::move(cause));
  return fault;
}

/// Each gives one fault or none.
using Found = std::vector<Fault>;

Found waves(const PartOf& part) {
  const scene::Material& material = part.material();
  const double speed = material.dilatational_speed();
  if (speed >= slowest_wave && speed <= fastest_wave) return {};
  if (material.poissons_ratio > high_poissons_ratio && speed > fastest_wave &&
      material.shear_speed() < 0.6 * fastest_wave)
    return {fault_of(FaultKind::material, part, speed, fastest_wave,
                     {"material",
                      fmt::format("material {} of part {} has waves of {:.3g} m/s, for it is nearly incompressible: "
                                  "see materials.{} poissons_ratio, {}; "
                                  "0.49 and below does",
                                  material.name, part.name(), speed, material.name, material.poissons_ratio),
                      90})};
  return {fault_of(FaultKind::material, part, speed, speed > fastest_wave ? fastest_wave : slowest_wave,
                   {"material",
                    fmt::format("material {} of part {} has waves of {:.3g} m/s: see materials.{} density (kg/m3) and "
                                "youngs_modulus (Pa); a table in "
                                "mm and tonnes must be converted",
                                material.name, part.name(), speed, material.name),
                    90})};
}

Found yield(const PartOf& part) {
  const scene::Material& material = part.material();
  if (!material.yield_stress) return {};
  const double share = *material.yield_stress / material.youngs_modulus;
  if (share >= lowest_yield) return {};
  return {fault_of(FaultKind::yield, part, share, lowest_yield,
                   {"yield stress",
                    fmt::format("material {} of part {} yields at {:.3g} Pa: see materials.{} yield_stress, in Pa",
                                material.name, part.name(), *material.yield_stress, material.name),
                    89})};
}

Found size(const PartOf& part) {
  const auto& range = part.range();
  double mean = 0;
  for (int e = range.first_element; e < range.first_element + range.element_count; ++e)
    mean += part.assembled.element_length[e] / range.element_count;
  if (range.element_count == 0 || (mean >= finest_mesh && mean <= coarsest_mesh)) return {};
  const std::string& mesh = part.assembled.scene.parts[part.number].mesh;
  return {fault_of(
      FaultKind::size, part, mean, mean > coarsest_mesh ? coarsest_mesh : finest_mesh,
      {"size",
       fmt::format("the elements of part {} are {:.3g} m across: see the lengths of meshes.{}, in m, or its scale",
                   part.name(), mean, mesh),
       95})};
}

}  // namespace

std::vector<Fault> absurd_units(const AssembledScene& assembled) {
  Found all;
  for (const auto check : {size, waves, yield})
    for (std::size_t p = 0; p < assembled.scene.parts.size(); ++p)
      if (Found found = check({assembled, p}); !found.empty()) {
        all.push_back(std::move(found[0]));
        break;
      }
  return all;
}

}  // namespace railwave
