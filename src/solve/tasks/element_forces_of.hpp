#pragma once

#include <algorithm>

#include "model/elements/block_launch.hpp"
#include "model/elements/materials.hpp"
#include "solve/tasks/contributions.hpp"
#include "solve/tasks/element_forces.hpp"

/// What the files that CMake writes from element_forces_of.cpp.in instantiate.
namespace railwave {

/// Of 32 slave nodes each: a GPU has about as many multiprocessors.
inline constexpr int most_contact_teams = 128;

template <class Block, bool Friction>
void forces_together(const NodalState& nodal, const ElementBlocks& blocks, Block functor, const Instant& instant,
                     const ElementLaunch& launch) {
  const ContactPair& pair = *launch.contact;
  using Together = ForcesTogether<Block, Friction>;
  const int set_teams = launch.sets != nullptr ? launch.sets->set_teams.with_sets : 0;
  // Multipliers have a launch of their own. How many nodes can touch is known on the device only; should they be more,
  // teams take several turns.
  const int contact_teams = pair.has_springs()
                                ? std::min(most_contact_teams, (pair.window.bound() + Together::slaves_of_team - 1) /
                                                                   Together::slaves_of_team)
                                : 0;
  SetLoads sets{};  // CUDA 13.0's compiler crashes on a conditional expression inside the functor's braces
  if (launch.sets != nullptr) sets = set_loads(nodal, *launch.sets, instant, launch.kind);
  if (launch.listed != nullptr) functor.listed = *launch.listed;
  const int block_teams = launch.listed != nullptr ? static_cast<int>(launch.listed->extent(0)) : blocks.count;
  std::size_t scratch = Block::scratch_size(blocks);
  if (launch.sets != nullptr) scratch = std::max(scratch, launch.sets->set_teams.scratch_size());
  launch_teams(set_teams + contact_teams + block_teams, scratch,
               Together{sets, contact_force<Friction>(nodal, pair, instant, LinearPenalty{pair.arrays.friction}, {}),
                        functor, set_teams, contact_teams},
               instant.space());
}

template <class S>
const Array<PartialForce<S>*>& partial_forces(const PartialForces& partial) {
  if constexpr (sizeof(S) == sizeof(double))
    return partial.in_double;
  else
    return partial.in_single;
}

template <class S, class Hourglass, bool Advance, class Nodes, class Material>
void block_forces(const NodalState& nodal, const ElementGroup& group, const Nodes& nodes, const Instant& instant,
                  const ElementLaunch& launch, const Material& material) {
  const double steps = static_cast<double>(1L << group.level);  // steps from one evaluation to the next
  const Array<float*>& scale =
      launch.kind == StepKind::settling ? group.blocks.settling_hourglass : group.blocks.hourglass_scale;
  using Force = ElementForce<S, Material, Hourglass, Advance, Nodes>;
  const Force force{
      material,           group.blocks, scale, nodes, steps * instant.step, partial_forces<S>(nodal.partial),
      group.first_partial};
  if constexpr (on_device && Advance) {
    if (launch.contact != nullptr) {
      if (launch.contact->arrays.friction > 0)
        forces_together<Force, true>(nodal, group.blocks, force, instant, launch);
      else
        forces_together<Force, false>(nodal, group.blocks, force, instant, launch);
      return;
    }
  }
  launch_blocks(group.blocks, launch.listed, force, instant.space());
}

inline NodeAdvance advance_of(const NodalState& nodal, const ElementGroup& group, double step,
                              const NodeAdvance* /*kind*/) {
  NodeAdvance nodes = node_advance(nodal, step);
  nodes.velocity_step *= static_cast<double>(1L << group.level);
  nodes.step *= static_cast<double>(1L << group.level);
  return nodes;
}

inline RelativeAdvance advance_of(const NodalState& nodal, const ElementGroup& group, double step,
                                  const RelativeAdvance* /*kind*/) {
  return relative_advance(nodal, group.relative, step);
}

template <class S, class Nodes, class Material>
void element_forces_of(const NodalState& nodal, const ElementGroup& group, const Instant& instant,
                       const ElementLaunch& launch) {
  const Material material = material_of<Material>(group.material);
  const Nodes nodes = advance_of(nodal, group, instant.step, static_cast<const Nodes*>(nullptr));
  const bool viscous = group.hourglass == scene::HourglassType::viscous && launch.kind != StepKind::settling;
  const bool advancing = launch.kind == StepKind::advancing;
  if (viscous && advancing)
    block_forces<S, ViscousHourglass, true>(nodal, group, nodes, instant, launch, material);
  else if (viscous)
    block_forces<S, ViscousHourglass, false>(nodal, group, nodes, instant, launch, material);
  else if (advancing)
    block_forces<S, StiffnessHourglass, true>(nodal, group, nodes, instant, launch, material);
  else
    block_forces<S, StiffnessHourglass, false>(nodal, group, nodes, instant, launch, material);
}

}  // namespace railwave
