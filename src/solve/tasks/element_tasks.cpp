#include "kernels/nodes/shared_nodes.hpp"
#include "model/contact/contact_law.hpp"
#include "model/elements/materials.hpp"
#include "solve/tasks.hpp"
#include "solve/tasks/contributions.hpp"
#include "solve/tasks/damping_forces.hpp"
#include "solve/tasks/element_forces.hpp"

namespace railwave {
namespace {

/// Single precision's frames may lag so far behind the bodies' motion: at 30 m/s some tenths of a millimetre, which
/// costs strain a few parts in 1e9. Whole rounds of any levels, so that every block is evaluated when its frame is due.
constexpr long steps_between_frames = 64;
static_assert(steps_between_frames % (1L << (most_levels - 1)) == 0);

/// Nodes in single precision need frames only for what the account and the outputs compute from the double ones.
std::vector<Task> frame_tasks(const Model& model, const ElementGroup& group, StepKind kind, long every) {
  if (group.blocks.frame.extent(0) == 0) return {};
  const bool carried = model.carried.active() && kind != StepKind::settling;
  if (carried && kind == StepKind::advancing) return {};
  Task task{"reference frames of " + group.parts, "j",
            [&model, &group](const Instant&) { renew_frames(model, group); }};
  task.every = carried ? every : steps_between_frames;
  return {task};
}

std::string name_of(const ElementGroup& group) {
  std::string material;
  with_material_type(group.material,
                     [&](auto type) { material = MaterialTrait<typename decltype(type)::type>::words; });
  const bool viscous = group.hourglass == scene::HourglassType::viscous;
  return "elements of " + group.parts + material + (viscous ? ", viscous" : ", stiffness") + " hourglass control";
}

Task force_task(const Model& model, const ElementGroup& group, StepKind kind) {
  const ElementLaunch launch{kind, &group == &model.elements.front() && contact_goes_along(model, kind),
                             &group == &model.elements.front() && sets_go_along(model, kind)};
  Task task{name_of(group), "b, c", {}};
  if (launch.with_contact && model.contacts.front().has_springs())
    task = {"contact " + describe_contact(*model.contacts.front().contact) + " and " + task.name, "d, b, c", {}};
  if (launch.with_sets) task = {"connectors and torques, " + task.name, "a, " + task.step, {}};
  if (kind == StepKind::advancing) task = {task.name + ", with their inner nodes", task.step + ", f to j", {}};
  // While a scene settles its nodes are in double precision whatever the run's own.
  if (!model.scene.solver.elements_in_single())
    task.run = [&model, &group, launch](const Instant& instant) {
      element_forces<double, NodeAdvance>(model, group, instant, launch);
    };
  else if (kind == StepKind::settling || !model.carried.active())
    task.run = [&model, &group, launch](const Instant& instant) {
      element_forces<float, NodeAdvance>(model, group, instant, launch);
    };
  else
    task.run = [&model, &group, launch](const Instant& instant) {
      element_forces<float, CarriedAdvance>(model, group, instant, launch);
    };
  return task;
}

std::vector<Task> damping_tasks(const Model& model, const ElementGroup& group) {
  std::vector<Task> tasks;
  const long pace = 1L << group.level;
  if (pace > 1)
    tasks.push_back({"account of damping of " + group.parts, "b",
                     [&model, &group](const Instant& instant) { book_damping(model, group, instant.elapsed); }, pace,
                     1});
  tasks.push_back({"damping of " + group.parts, "b",
                   [&model, &group](const Instant& instant) { element_damping(model, group, instant); }, pace});
  return tasks;
}

}  // namespace

std::vector<Task> element_tasks(Model& model, StepKind kind) {
  std::vector<Task> tasks;
  const bool settling = kind == StepKind::settling;
  for (const ElementGroup& group : model.elements) {
    const long pace = settling ? 1 : 1L << group.level;
    append(tasks, frame_tasks(model, group, kind, pace));
    tasks.push_back(force_task(model, group, kind));
    tasks.back().every = pace;
  }
  // Statics know no damping: while the scene settles its rows stay empty. No block moves nodes of damped elements.
  for (const ElementGroup& group : model.elements)
    if (group.damping.active() && !settling) append(tasks, damping_tasks(model, group));
  return tasks;
}

}  // namespace railwave
