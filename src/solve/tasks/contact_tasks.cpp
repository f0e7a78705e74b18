#include <fmt/format.h>

#include "model/contact/contact_law.hpp"
#include "solve/tasks.hpp"
#include "solve/tasks/contributions.hpp"

namespace railwave {
namespace {

Task search_task(const scene::Scene& scene, const NodalState& nodal, ContactPair& pair, StepKind kind) {
  Task task{"search of contact " + describe_contact(*pair.contact) + (pair.reversed ? " reversed" : ""), "d",
            [&scene, &nodal, &pair, kind](const Instant& instant) { keep_window(scene, nodal, pair, instant, kind); }};
  task.recordable = false;
  return task;
}

template <bool Friction, class Normals, class Law>
void launch_springs(const NodalState& nodal, const ContactPair& pair, const Instant& instant, const Law& law) {
  Kokkos::parallel_for("contact_force", SpreadRange(instant.space(), 0, pair.window.launched()),
                       contact_force<Friction, Normals>(nodal, pair, instant, law, pair.law.state));
}

template <bool Friction>
void press_springs(const NodalState& nodal, const ContactPair& pair, const Instant& instant, bool settling) {
  with_contact_law(*pair.contact, pair.law, settling, [&](const auto& law) {
    if (pair.contact->normals != scene::ContactNormals::smooth)
      launch_springs<Friction, FacetNormals>(nodal, pair, instant, law);
    else if constexpr (ContactLawTrait<std::decay_t<decltype(law)>>::with_smooth_normals)
      launch_springs<Friction, SmoothNormals>(nodal, pair, instant, law);
  });
}

Task spring_task(const NodalState& nodal, const ContactPair& pair, StepKind kind, bool friction) {
  return {"contact " + describe_contact(*pair.contact) + (pair.reversed ? " reversed" : "") +
              describe_contact_law(*pair.contact),
          "d", [&nodal, &pair, kind, friction](const Instant& instant) {
            (friction ? press_springs<true> : press_springs<false>)(nodal, pair, instant, kind == StepKind::settling);
          }};
}

}  // namespace

bool has_friction(const scene::Scene& scene, const ContactPair& pair, StepKind kind) {
  return pair.arrays.friction > 0 && (kind != StepKind::settling || scene.settle.friction);
}

std::vector<Task> contact_tasks(const scene::Scene& scene, const NodalState& nodal, std::vector<ContactPair>& contacts,
                                StepKind kind, GoingAlong along) {
  std::vector<Task> tasks;
  if (contacts.empty()) return tasks;
  // The node update leaves the sums cleared. Settling does not, nor does who computes an instant's forces twice.
  if (kind != StepKind::advancing)
    tasks.push_back({"clearing of contact forces", "d", [&nodal](const Instant& instant) {
                       Kokkos::deep_copy(instant.space(), nodal.external.sum.contact, std::uint64_t{0});
                     }});
  for (ContactPair& pair : contacts) {
    if (!pair.has_springs()) continue;
    tasks.push_back(search_task(scene, nodal, pair, kind));
    if (!along.contact) tasks.push_back(spring_task(nodal, pair, kind, has_friction(scene, pair, kind)));
  }
  return tasks;
}

}  // namespace railwave
