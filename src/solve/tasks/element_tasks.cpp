#include <fmt/format.h>

#include <algorithm>

#include "model/contact/contact_law.hpp"
#include "model/elements/materials.hpp"
#include "solve/tasks/element_forces.hpp"

namespace railwave {
namespace {

/// Single precision's frames may lag so far behind the bodies' motion: at 30 m/s some tenths of a millimetre, which
/// costs strain a few parts in 1e9. Whole cycles of any levels, so that every block is evaluated when its frame is due.
constexpr long steps_between_frames = 64;
static_assert(steps_between_frames % (1L << (most_levels - 1)) == 0);

/// Nodes in single precision need frames only for what the account and the outputs compute from the double ones.
std::vector<Task> frame_tasks_of(const NodalState& nodal, const ElementGroup& group, StepKind kind, long every) {
  if (group.blocks.frame.extent(0) == 0) return {};
  const bool relative = nodal.relative.active() && kind != StepKind::settling;
  if (relative && kind == StepKind::advancing) return {};
  Task task{"reference frames of " + group.parts, "j",
            [&nodal, &group](const Instant& instant) { renew_frames(nodal.nodes, group, instant.space()); }};
  task.every = relative ? every : steps_between_frames;
  return {task};
}

/// More than a GPU has places for, twice over.
bool fills_device(const ElementGroup& group) { return 2 * fills_of_device(group) > 1; }

std::string name_of(const ElementGroup& group) {
  std::string material;
  with_material_type(group.material,
                     [&](auto type) { material = MaterialTrait<typename decltype(type)::type>::words; });
  const bool viscous = group.hourglass == scene::HourglassType::viscous;
  return "elements of " + group.parts + material + (viscous ? ", viscous" : ", stiffness") + " hourglass control";
}

template <class S, class Nodes>
auto forces_by_material(const NodalState& nodal, const ElementGroup& group, const ElementLaunch& launch) {
  return [&nodal, &group, launch](const Instant& instant) {
    with_material_type(group.material, [&](auto type) {
      element_forces_of<S, Nodes, typename decltype(type)::type>(nodal, group, instant, launch);
    });
  };
}

Task force_task(const NodalState& nodal, const ElementGroup& group, bool in_single, const ElementLaunch& launch) {
  Task task{name_of(group), "b, c", {}};
  if (launch.contact != nullptr && launch.contact->has_springs())
    task = {"contact " + describe_contact(*launch.contact->contact) + " and " + task.name, "d, b, c", {}};
  if (launch.sets != nullptr) task = {"connectors and torques, " + task.name, "a, " + task.step, {}};
  if (launch.kind == StepKind::advancing) task = {task.name + ", with their inner nodes", task.step + ", f to j", {}};
  // While a scene settles its nodes are in double precision whatever the run's own.
  if (!in_single)
    task.run = forces_by_material<double, NodeAdvance>(nodal, group, launch);
  else if (launch.kind == StepKind::settling || !nodal.relative.active())
    task.run = forces_by_material<float, NodeAdvance>(nodal, group, launch);
  else
    task.run = forces_by_material<float, RelativeAdvance>(nodal, group, launch);
  return task;
}

std::vector<Task> damping_tasks(const NodalState& nodal, const ElementGroup& group, bool in_single, bool first,
                                const Array<int*>* listed) {
  std::vector<Task> tasks;
  const long steps = 1L << group.level;
  if (steps > 1 && first)
    tasks.push_back(
        {"account of damping of " + group.parts, "b",
         [&nodal, &group, in_single](const Instant& instant) { book_damping(nodal, group, in_single, instant); }, steps,
         1});
  tasks.push_back({"damping of " + group.parts, "b",
                   [&nodal, &group, in_single, listed](const Instant& instant) {
                     element_damping(nodal, group, in_single, instant, listed);
                   },
                   steps});
  return tasks;
}

}  // namespace

std::vector<Task> frame_tasks(const NodalState& nodal, const ElementModel& elements, StepKind kind) {
  std::vector<Task> tasks;
  for (const ElementGroup& group : elements.elements)
    append(tasks, frame_tasks_of(nodal, group, kind, kind == StepKind::settling ? 1 : 1L << group.level));
  return placed(std::move(tasks), Stage::begin, 0);
}

std::vector<Task> element_tasks(const NodalState& nodal, const ElementModel& elements,
                                const std::vector<ContactPair>& contacts, const LoadModel& loads, StepKind kind,
                                GoingAlong along, const ListedBlocks& listed) {
  std::vector<Task> tasks;
  const bool settling = kind == StepKind::settling;
  const auto number_of = [&](const ElementGroup& group) { return static_cast<int>(&group - elements.elements.data()); };
  const auto lane_of = [&](const ElementGroup& group) { return OwnForceLanes::elements + number_of(group); };
  const int lanes_of_groups = OwnForceLanes::elements + static_cast<int>(elements.elements.size());
  const auto by_blocks = [](const ElementGroup& one, const ElementGroup& other) {
    return one.blocks.count < other.blocks.count;
  };
  const auto largest = std::max_element(elements.elements.begin(), elements.elements.end(), by_blocks);
  const auto listed_of = [&](const ElementGroup& group) {
    return listed.of_group == nullptr ? nullptr : &(*listed.of_group)[number_of(group)];
  };
  for (const ElementGroup& group : elements.elements) {
    const long steps = settling ? 1 : 1L << group.level;
    ElementLaunch launch{kind, nullptr, nullptr, listed_of(group)};
    if (&group == &elements.elements.front() && along.contact) launch.contact = &contacts.front();
    if (&group == &elements.elements.front() && along.sets) launch.sets = &loads;
    const bool in_parts = nodal.parts.group == number_of(group) && kind == StepKind::advancing && !launch.listed;
    const int parts = in_parts ? static_cast<int>(nodal.parts.blocks.size()) : 1;
    for (int part = 0; part < parts; ++part) {
      if (in_parts) launch.listed = &nodal.parts.blocks[part];
      if (part > 0) launch.contact = nullptr, launch.sets = nullptr;
      Task task = force_task(nodal, group, elements.in_single, launch);
      if (in_parts) task.name += fmt::format(", part {} of {}", part + 1, parts);
      task.every = steps;
      task.bulk = &group == &*largest && fills_device(group);
      task.part = part;
      append(tasks, placed({task}, Stage::own_forces, part == 0 ? lane_of(group) : lanes_of_groups + part - 1));
    }
  }
  // Statics know no damping: while the scene settles its rows stay empty. No block moves nodes of damped elements.
  for (const ElementGroup& group : elements.elements)
    if (group.damping.active() && !settling)
      append(tasks, placed(damping_tasks(nodal, group, elements.in_single, listed.first, listed_of(group)),
                           Stage::own_forces, lane_of(group)));
  return tasks;
}

}  // namespace railwave
