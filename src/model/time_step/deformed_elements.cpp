#include "model/time_step/deformed_elements.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "kernels/contact/strike_ahead.hpp"
#include "kernels/support/reductions.hpp"
#include "mesh/vectors.hpp"
#include "model/beams/beams.hpp"
#include "model/host_copy.hpp"
#include "model/model.hpp"
#include "model/ranks/rank_share.hpp"
#include "model/time_step/automatic_step.hpp"
#include "model/time_step/stable_step.hpp"

namespace railwave {
namespace {

/// Nodes on which springs, dashpots or beams act besides elements. Multipliers are constraints: they make nothing
/// stiffer.
std::vector<char> nodes_under_springs(const Model& model) {
  std::vector<char> under(model.assembly.nodes.size(), 0);
  for (const ContactPair& pair : model.contacts)
    if (pair.has_springs())
      for (const auto* nodes : {&pair.slave_nodes, &pair.master_nodes})
        for (const int n : *nodes) under[n] = 1;
  for (const ConnectorCell& cell : model.connectors.cells)
    for (const WeightedNodes* end : {&cell.from, &cell.to})
      for (const int n : end->nodes) under[n] = 1;
  if (model.beams)
    for (std::size_t n = 0; n < model.beams->number.size(); ++n)
      if (model.beams->number[n] >= 0) under[n] = 1;
  return under;
}

std::vector<int> levels_of_elements(const Model& model) {
  std::vector<int> level(model.subcycling.levels > 1 ? model.assembly.elements.size() : 0, 0);
  if (level.empty()) return level;
  for (const ElementGroup& group : model.elements)
    for (std::size_t b = 0; b < group.first_element.size(); ++b)
      for (int e = group.first_element[b]; e < group.first_element[b] + group.element_count[b]; ++e)
        level[e] = group.level;
  return level;
}

DeformedShape shape_of(const DeformedElements& elements, const NodalState& nodal) {
  return {elements, nodal.nodes.reference, nodal.nodes.position, nodal.nodes.velocity};
}

double undeformed_stiffness(const Assembly& assembly, int element, double lame_ratio) {
  double x[3][7];
  for (int i = 0; i < 3; ++i) {
    double place[8];
    for (int N = 0; N < 8; ++N) place[N] = assembly.nodes[assembly.elements[element][N]][i];
    modes_of(place, x[i]);
  }
  return stiffness_over_mass(x, lame_ratio);
}

/// lambda / mu, or 0 where that is below.
double lame_ratio_of(const scene::Material& material) {
  return std::fmax(0, material.dilatational_modulus() / material.shear_modulus() - 2);
}

}  // namespace

DeformedElements deformed_elements(const Model& model, const OwnItems* own) {
  DeformedElements made;
  const Assembly& assembly = model.assembly;
  made.count = static_cast<int>(own != nullptr ? own->elements.size() : assembly.elements.size());
  made.corners = unset_array<int* [8]>("corners of deformed elements", made.count);
  made.value = unset_array<float * [DeformedElements::values]>("deformed elements", made.count);
  const auto corners = Kokkos::create_mirror_view(made.corners);
  const auto value = Kokkos::create_mirror_view(made.value);
  const auto under_springs = nodes_under_springs(model);
  const auto level = levels_of_elements(model);
  const bool steps_of_all = model.own_steps.size() == assembly.elements.size();
  std::size_t p = 0;
  for (int i = 0; i < made.count; ++i) {
    const int e = own != nullptr ? own->elements[i] : i;  // ascending
    while (e >= assembly.parts[p].first_element + assembly.parts[p].element_count) ++p;
    const double ratio = lame_ratio_of(model.scene.materials[assembly.parts[p].material]);
    bool springs = false;
    for (int N = 0; N < 8; ++N) {
      corners(i, N) = assembly.elements[e][N];
      springs = springs || under_springs[corners(i, N)] != 0;
    }
    const bool coarse = !springs && !level.empty() && level[e] > 0;
    const double share = coarse ? 1 / (margin_of_levels * static_cast<double>(1L << level[e])) : 1;
    const float power = model.scene.parts[p].damped() ? 2 : 1;
    value(i, DeformedElements::own_step) =
        springs ? 0 : static_cast<float>(share * model.own_steps[steps_of_all ? e : i]);
    value(i, DeformedElements::lame_ratio) = static_cast<float>(ratio);
    value(i, DeformedElements::stiffness) = static_cast<float>(undeformed_stiffness(assembly, e, ratio));
    value(i, DeformedElements::power) = coarse ? -power : power;
  }
  Kokkos::deep_copy(made.corners, corners);
  Kokkos::deep_copy(made.value, value);
  return made;
}

namespace {

TrackedMotion tracked_motion(const NodalState& nodal, const ContactPair& pair) {
  return {pair.arrays, pair.window, nodal.nodes.position, nodal.nodes.velocity};
}

/// @param fastest gets it
void queue_approach(const NodalState& nodal, const std::vector<ContactPair>& contacts, Reductions& reductions,
                    double& fastest) {
  for (const ContactPair& pair : contacts)
    reductions.largest(Approach{tracked_motion(nodal, pair)}, pair.window.count, [&fastest](const Largest<1>& of) {
      if (of.place[0] >= 0) fastest = std::fmax(fastest, of.value[0]);
    });
}

}  // namespace

DeformedNow measure_now(const DeformedElements& elements, const NodalState& nodal, double first_limit,
                        double second_limit, const std::vector<ContactPair>& approaching) {
  DeformedNow found{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity(), 0, 0};
  Reductions reductions(*nodal.reduction_space);
  reductions.largest(DeformedStepNow{shape_of(elements, nodal), {first_limit, second_limit}}, elements.count,
                     [&](const Largest<3>& of) {
                       if (of.place[0] >= 0) found = {-of.value[0], -of.value[1], std::sqrt(of.value[2]), 0};
                     });
  queue_approach(nodal, approaching, reductions, found.approach);
  reductions.fetch();
  return found;
}

DeformedAhead measure_ahead(const DeformedElements& elements, const NodalState& nodal, double limit, double step,
                            double least) {
  DeformedAhead found{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity(), 0};
  Reductions reductions(*nodal.reduction_space);
  reductions.largest(DeformedStepAhead{shape_of(elements, nodal), {limit}, step, least}, elements.count,
                     [&](const Largest<3>& of) {
                       if (of.place[0] >= 0) found = {-of.value[0], -of.value[1], of.value[2]};
                     });
  reductions.fetch();
  return found;
}

void join(DeformedNow& own, const DeformedNow& other) {
  own.first = std::fmin(own.first, other.first);
  own.second = std::fmin(own.second, other.second);
  own.speed = std::fmax(own.speed, other.speed);
  own.approach = std::fmax(own.approach, other.approach);
}

void join(DeformedAhead& own, const DeformedAhead& other) {
  own.allowed = std::fmin(own.allowed, other.allowed);
  own.steps = std::fmin(own.steps, other.steps);
  own.loss = std::fmax(own.loss, other.loss);
}

double fastest_approach(const NodalState& nodal, const std::vector<ContactPair>& contacts) {
  double fastest = 0;
  Reductions reductions(*nodal.reduction_space);
  queue_approach(nodal, contacts, reductions, fastest);
  reductions.fetch();
  return fastest;
}

double steps_to_strike(const NodalState& nodal, const std::vector<ContactPair>& contacts, double fast, double step) {
  double least = std::numeric_limits<double>::infinity();
  Reductions reductions(*nodal.reduction_space);
  for (const ContactPair& pair : contacts)
    reductions.largest(StrikeAhead{tracked_motion(nodal, pair), fast, step}, pair.window.count,
                       [&](const Largest<1>& of) {
                         if (of.place[0] >= 0 && of.value[0] > -1e299) least = std::fmin(least, -of.value[0]);
                       });
  reductions.fetch();
  return least;
}

double striking_speed(const AssembledScene& assembled) {
  constexpr double share_of_wave_speed = 0.01;
  double least = std::numeric_limits<double>::infinity();
  for (const Assembly::PartRange& part : assembled.assembly.parts) {
    const scene::Material& material = assembled.scene.materials[part.material];
    least = std::fmin(least, share_of_wave_speed * material.dilatational_speed());
    if (material.yield_stress)
      least = std::fmin(least, std::sqrt(moderate_damage * *material.yield_stress / material.density));
  }
  return least;
}

}  // namespace railwave
