#pragma once

#include <algorithm>
#include <functional>
#include <string>
#include <vector>

#include "kernels/statics/tangent.hpp"
#include "model/model.hpp"
#include "model/ranks/transport.hpp"
#include "solve/statics/static_state.hpp"
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

/// What unbalanced forces are held against, N: all that is applied now. Where that cancels node by node, as a load does
/// that a connector takes up on the same nodes, a ten-thousandth of what was applied where settling began; where next
/// to nothing is applied, so much that what the rounding of places leaves of the elements' forces counts as settled.
class AppliedForces {
 public:
  explicit AppliedForces(const Model& model);
  double operator()(double now) {
    if (first_ < 0) first_ = now;
    return std::max({now, 1e-4 * first_, least_});
  }

 private:
  double first_ = -1, least_ = 0;
};

/// Static equilibrium under the loads of t = 0, by Newton's method (static_newton.cpp), and where that finds none or
/// the case asks for it by dynamic relaxation with kinetic damping (velocities are reset at every peak of the kinetic
/// energy) and a little local damping: the state from which the run starts. Bodies that will rotate (initial_motion)
/// are loaded by the centrifugal field of that rotation, so that the start of rolling does not ring. In a relaxation
/// point masses on which no beam ends stay where they are: preload their connectors. Velocities are zero afterwards.
/// @throws InputError where a body that nothing holds or that its loads crush leaves no finite forces
/// @param go_on called every few steps with how far it is; false ends the relaxation early
/// @param others ranks that wait for rank 0's orders and take part; null: there are none
SettleReport settle(Model& model, const std::function<bool(const SettleReport&)>& go_on, Transport* others = nullptr);

/// Settles a scene, or takes its settled state from where an earlier run has kept it; goes on from one that was
/// interrupted. The state is kept in any case.
/// @param states null: nothing is kept
SettleReport come_to_rest(Model& model, SettledStates* states, const std::function<bool(const SettleReport&)>& go_on,
                          Transport* others = nullptr);

/// What the evaluation of forces, and a relaxation's step, are made of: a line for each task of each method in turn.
/// None where the scene does not settle.
struct SettlingTasks {
  std::string method;
  std::vector<std::string> lines;
};
std::vector<SettlingTasks> describe_settling(Model& model);

/// m/s2 by node: - omega x (omega x (X - c)) on the bodies that will rotate.
/// @param reference m, X by node
std::vector<Vec3> centrifugal_field(const AssembledScene& assembled, const Array<double* [3]>& reference,
                                    const std::shared_ptr<BeamModel>& beams);

/// Static equilibrium under the loads of t = 0 by Newton's method without a matrix: residuals are the forces that the
/// run computes (with the hourglass control of settling), steps come from conjugate gradients on the stiffness of the
/// present place, preconditioned by nodal blocks and rigid motions of aggregates, and are shortened until the forces
/// along them have come down: then contact may close on the way. Multipliers of contact are found by augmented
/// Lagrange. Throws InputError for a point mass that nothing holds against the force on it.
SettleReport settle_by_newton(Model& model, const std::function<bool(const SettleReport&)>& go_on,
                              Transport* others = nullptr);

/// A point mass has no shape to lean on: springs and constraints must hold it against its load while the scene settles
/// by Newton's method.
/// @param cells of the connectors
/// @param unbalanced N by node
/// @param applied N, sum of applied and contact forces
/// @throws InputError naming the point, the force and its direction
void refuse_drifting_points(const AssembledScene& assembled, const std::vector<ConnectorCell>& cells,
                            const std::shared_ptr<BeamModel>& beams, const NodeVector& unbalanced, double applied);

/// The part or beam on which the largest force is left after Newton's method, if that is more than rounding leaves of
/// deformation; else empty.
std::string what_drifts(const AssembledScene& assembled, const NodeVector& unbalanced, double applied);

/// Forces of an instant of Newton's method, in which pairs with multipliers press as `press` has them.
std::vector<Task> newton_tasks(Model& model, std::function<void()> press);

/// The point about which an initial motion turns a part: `centre`, else the axis of a round part (see
/// carried_axis() of model/contact/rolling.hpp), else the centre of mass of `around`, else the part's.
Vec3 rotation_centre(const AssembledScene& assembled, const scene::InitialMotion& motion, const std::string& part,
                     const Array<double* [3]>& position);

/// A held node that moved would do work that nobody counts.
/// @throws InputError where an initial motion moves a node in a direction in which a constraint holds it
void refuse_moving_held_nodes(const AssembledScene& assembled, const Array<double* [3]>& reference);

/// Adds the scene's initial motions to the velocities, v = V + omega x (x - centre), in the present configuration.
void set_initial_motion(const AssembledScene& assembled, const NodeArrays& arrays,
                        const std::shared_ptr<BeamModel>& beams);

}  // namespace railwave
