#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "model/build_steps.hpp"
#include "model/checks/stiff_surfaces.hpp"
#include "model/contact/initial_overlap.hpp"

// The algorithm of contacts that leave it to the scene: multipliers, which have less error in less time
// (docs/contact.md), unless the scene has what they do not go with.
namespace railwave {
namespace {

/// Keys of springs, where a contact has one.
std::string key_of_springs(const scene::Contact& contact) {
  const scene::Contact usual;
  if (contact.penalty_scale != usual.penalty_scale) return "penalty_scale";
  if (!contact.penalty_growth.empty()) return "penalty_growth";
  if (contact.damping > 0) return "damping";
  return contact.symmetric ? "symmetric" : "";
}

bool has_nodes_of(const AssembledScene& assembled, const ContactPair& pair, const scene::Place& entry, const char* key,
                  const std::string& surface) {
  const auto nodes =
      surface_nodes(assembled.assembly, find_surface(assembled.scene, assembled.assembly, entry, key, surface));
  const std::set<int> own(nodes.begin(), nodes.end());
  const auto is_own = [&](int n) { return own.count(n) != 0; };
  return std::any_of(pair.slave_nodes.begin(), pair.slave_nodes.end(), is_own) ||
         std::any_of(pair.master_nodes.begin(), pair.master_nodes.end(), is_own);
}

/// Why a contact has springs; empty: it has multipliers. What build_ties(), build_non_reflecting() and
/// refuse_contradictions() refuse of multipliers is a reason, and so is what would throw bodies apart.
std::string why_springs(const AssembledScene& assembled, const ContactPair& pair,
                        const std::vector<InitialOverlap>& overlaps) {
  const scene::Scene& scene = assembled.scene;
  if (const std::string key = key_of_springs(*pair.contact); !key.empty()) return key + " is of springs";
  for (const scene::Tie& tie : scene.ties)
    if (has_nodes_of(assembled, pair, tie, "slave", tie.slave))
      return fmt::format("nodes of its surfaces are slaves of [ties.{}]", tie.name);
  for (const scene::NonReflecting& end : scene.non_reflecting)
    if (has_nodes_of(assembled, pair, end, "target", end.target))
      return fmt::format("nodes of its surfaces are of [non_reflecting.{}]", end.name);
  if (const auto meeting = stiff_meeting(assembled, pair)) return *meeting;
  for (const InitialOverlap& overlap : overlaps)
    if (overlap.contact == pair.contact)
      return "its surfaces overlap where the run begins, and nothing settles: multipliers would part them within a "
             "step";
  return {};
}

}  // namespace

void choose_algorithms(AssembledScene& assembled, std::vector<ContactPair>& contacts) {
  const auto automatic = [](const scene::Contact& contact) {
    return contact.algorithm == scene::ContactAlgorithm::automatic;
  };
  auto& chosen = assembled.scene.contacts;
  if (std::none_of(chosen.begin(), chosen.end(), automatic)) return;
  std::vector<InitialOverlap> overlaps;
  if (!assembled.scene.settle.active) overlaps = initial_overlaps(assembled, contacts, 0);
  for (std::size_t c = 0; c < chosen.size(); ++c) {  // pairs of the same number; halves of symmetric ones come later
    if (!automatic(chosen[c])) continue;
    const std::string why = why_springs(assembled, contacts[c], overlaps);
    chosen[c].algorithm_reason = why;
    chosen[c].algorithm = why.empty() ? scene::ContactAlgorithm::multiplier : scene::ContactAlgorithm::penalty;
  }
  for (ContactPair& pair : contacts)
    if (pair.contact->algorithm_reason) set_algorithm(pair);
}

}  // namespace railwave
