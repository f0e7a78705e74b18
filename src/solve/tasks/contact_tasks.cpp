#include <fmt/format.h>

#include "model/contact/contact_law.hpp"
#include "solve/tasks.hpp"
#include "solve/tasks/contributions.hpp"

namespace railwave {
namespace {

Task search_task(Model& model, ContactPair& pair, StepKind kind) {
  return {"search of contact " + describe_contact(*pair.contact) + (pair.reversed ? " reversed" : ""), "d",
          [&model, &pair, kind](const Instant& instant) { keep_window(model, pair, instant.step, kind); }};
}

template <bool Friction, class Normals, class Law>
void launch_springs(const Model& model, const ContactPair& pair, const Instant& instant, const Law& law) {
  Kokkos::parallel_for("contact_force", SpreadRange(0, pair.window.count),
                       contact_force<Friction, Normals>(model, pair, instant, law, pair.law.state));
}

template <bool Friction>
void press_springs(const Model& model, const ContactPair& pair, const Instant& instant, bool settling) {
  with_contact_law(*pair.contact, pair.law, settling, [&](const auto& law) {
    if (pair.contact->normals != scene::ContactNormals::smooth)
      launch_springs<Friction, FacetNormals>(model, pair, instant, law);
    else if constexpr (ContactLawTrait<std::decay_t<decltype(law)>>::with_smooth_normals)
      launch_springs<Friction, SmoothNormals>(model, pair, instant, law);
  });
}

Task spring_task(Model& model, ContactPair& pair, StepKind kind) {
  const bool friction = has_friction(model, pair, kind);
  return {"contact " + describe_contact(*pair.contact) + (pair.reversed ? " reversed" : "") +
              describe_contact_law(*pair.contact),
          "d", [&model, &pair, kind, friction](const Instant& instant) {
            (friction ? press_springs<true> : press_springs<false>)(model, pair, instant, kind == StepKind::settling);
          }};
}

}  // namespace

bool has_friction(const Model& model, const ContactPair& pair, StepKind kind) {
  return pair.arrays.friction > 0 && (kind != StepKind::settling || model.scene.settle.friction);
}

std::vector<Task> contact_tasks(Model& model, StepKind kind) {
  std::vector<Task> tasks;
  if (model.contacts.empty()) return tasks;
  // The node update leaves the sums cleared. Settling does not, nor does who computes an instant's forces twice.
  if (kind != StepKind::advancing)
    tasks.push_back({"clearing of contact forces", "d", [&model](const Instant&) {
                       Kokkos::deep_copy(ExecutionSpace(), model.extra.sum.contact, std::uint64_t{0});
                     }});
  for (ContactPair& pair : model.contacts) {
    if (!pair.has_springs()) continue;
    tasks.push_back(search_task(model, pair, kind));
    if (!contact_goes_along(model, kind)) tasks.push_back(spring_task(model, pair, kind));
  }
  return tasks;
}

}  // namespace railwave
