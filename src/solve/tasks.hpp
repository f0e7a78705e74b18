#pragma once

#include "kernels/statics/relaxation.hpp"
#include "solve/plan.hpp"

/// The tasks of which plans are made, by physics. Lists are empty where a scene has none of it.
namespace railwave {

/// (a) Loads, connectors, torques, beams, and their gather at the nodes.
std::vector<Task> load_tasks(Model& model, StepKind kind);

/// (d) Search, and forces by penalty springs.
std::vector<Task> contact_tasks(Model& model, StepKind kind);

/// (b, c) Element forces with hourglass control, and damping. In an advancing step they move the nodes that belong to
/// one block alone, so they come after all that must still find these nodes where they were.
std::vector<Task> element_tasks(Model& model, StepKind kind);

/// (d) Lagrange multipliers, of all pairs that have them at once: they may meet in a node. They predict where all other
/// forces take the nodes, so they come after these.
/// @param relaxation how the nodes move while a scene settles; null: by the central difference
std::vector<Task> multiplier_tasks(Model& model, StepKind kind, const RelaxationUpdate* relaxation = nullptr);

/// (a) Forces on tied nodes go to their masters: after all others on them.
std::vector<Task> tie_tasks(Model& model);

/// (a) Dashpots, after all other forces on their nodes. None while a scene settles.
std::vector<Task> non_reflecting_tasks(Model& model, StepKind kind);

/// Forces that follow from where the nodes are and how they move, not from other forces: loads, contact by springs,
/// elements. Every way of evaluating forces begins with them.
std::vector<Task> own_force_tasks(Model& model, StepKind kind);

/// All forces of an instant.
/// @param relaxation see multiplier_tasks
std::vector<Task> force_tasks(Model& model, StepKind kind, const RelaxationUpdate* relaxation = nullptr);

/// (a) Beams, and torques on points.
Task beam_task(Model& model, StepKind kind);

/// (f) to (j) Accelerations, constraints, velocities and positions.
std::vector<Task> motion_tasks(Model& model, StepKind kind);

/// Tied nodes after their masters.
Task tied_nodes_task(Model& model, StepKind kind);

/// Tasks of one list after those of another.
void append(std::vector<Task>& tasks, std::vector<Task> more);

/// Whether a pair has friction in steps of a kind: a scene may settle without.
bool has_friction(const Model& model, const ContactPair& pair, StepKind kind);

}  // namespace railwave
