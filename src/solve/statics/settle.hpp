#pragma once

#include <functional>
#include <string>
#include <vector>

#include "solve/tasks.hpp"

namespace railwave {

/// How settling went.
struct SettleReport {
  bool settled = false;
  int steps = 0;         ///< force evaluations, those of the linearised forces included
  int iterations = 0;    ///< steps of Newton's method
  double unbalance = 0;  ///< sum of |unbalanced nodal force| over sum of |applied and contact force|
  double wall_seconds = 0;
  std::string adrift;  ///< where it didn't settle: what is not in equilibrium as a whole; empty: nothing, or not known
  std::string taken_from;            ///< file that the settled state comes from; nothing was computed then
  std::string begun_from;            ///< file of an unfinished state from which it went on
  std::vector<std::string> remarks;  ///< on the method, and on the files of settled states
};

/// Static equilibrium under the loads of t = 0, by Newton's method (static_newton.hpp), and where that finds none or
/// the case asks for it by dynamic relaxation with kinetic damping (velocities are reset at every peak of the kinetic
/// energy) and a little local damping: the state from which the run starts. Bodies that will rotate (initial_motion)
/// are loaded by the centrifugal field of that rotation, so that the start of rolling does not ring. In a relaxation
/// point masses on which no beam ends stay where they are: preload their connectors. Velocities are zero afterwards.
/// @param go_on told every few steps how far it is; false ends the relaxation early
SettleReport settle(Model& model, const std::function<bool(const SettleReport&)>& go_on);

/// What the evaluation of forces, and a relaxation's step, are made of: a line for each task of each method in turn.
/// None where the scene does not settle.
struct SettlingTasks {
  std::string method;
  std::vector<std::string> lines;
};
std::vector<SettlingTasks> describe_settling(Model& model);

/// m/s2 by node: - omega x (omega x (X - c)) on the bodies that will rotate.
std::vector<Vec3> centrifugal_field(const Model& model);

/// Forces of an instant of Newton's method, in which pairs with multipliers press as `press` has them.
std::vector<Task> newton_tasks(Model& model, std::function<void()> press);

/// The point about which an initial motion turns a part: `centre`, else the centre of mass of `around`, else the
/// part's.
Vec3 rotation_centre(const Model& model, const scene::InitialMotion& motion, const std::string& part,
                     const Array<double* [3]>& position);

/// A held node that moved would do work that nobody counts.
/// @throws InputError where an initial motion moves a node in a direction in which a constraint holds it
void refuse_moving_held_nodes(const Model& model);

/// Adds the scene's initial motions to the velocities, v = V + omega x (x - centre), in the present configuration.
void set_initial_motion(Model& model);

}  // namespace railwave
