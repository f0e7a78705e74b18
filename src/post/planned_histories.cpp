#include "post/planned_histories.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "case/error.hpp"
#include "case/suggest.hpp"
#include "output/histories/history_values.hpp"

namespace railwave {

PlannedHistories::PlannedHistories(const scene::Scene& scene, const Assembly& assembly)
    : case_path_(scene.path), sets_(resolve_history_sets(scene, assembly)) {
  for (const HistorySet& set : sets_) {
    if (set.motion()) names_.sets.push_back(set.name);
    if (set.inside()) names_.element_sets.push_back(set.name);
  }
  for (const scene::Contact& contact : scene.contacts) names_.contacts.push_back(contact.name);
  for (const EnergyTerm& term : energy_terms) names_.energies.emplace_back(term.name);
  for (const scene::PrescribedMotion& motion : scene.prescribed_motions)
    names_.prescribed_motions.push_back(motion.name);
  for (const scene::Load& load : scene.loads) {
    names_.loads.push_back(load.name);
    torque_[load.name] = load.type == scene::LoadType::torque;
  }
  for (const scene::Beam& beam : scene.beams)
    if (scene::is_among(beam.name, scene.output.history_beams)) names_.beams.push_back(beam.name);
  for (const Assembly::BeamChain& chain : assembly.beam_chains)
    beam_elements_[scene.beams[chain.beam].name] += scene.beams[chain.beam].divisions;
}

std::optional<PlannedHistories> PlannedHistories::of(const scene::Scene& scene) {
  const auto assembly = [&]() -> std::optional<Assembly> {
    try {
      return assemble(scene);
    } catch (const InputError&) {
      return {};
    }
  }();
  if (!assembly) return {};
  return PlannedHistories(scene, *assembly);
}

void PlannedHistories::expect_written(const ChannelPlace& place) const {
  const auto refuse = [&](const std::string& why) {
    throw InputError(fmt::format("channel '{}' of {}: {}", place.name(), case_path_, why));
  };
  if (place.group == "set") {
    const auto set =
        std::find_if(sets_.begin(), sets_.end(), [&](const HistorySet& one) { return one.name == place.owner; });
    if (set->has(place.quantity)) return;
    std::vector<std::string> written;
    for (const FieldRow* row : set->quantities) written.emplace_back(row->name);
    refuse(fmt::format("the run does not write the {} of {}, but {}", place.quantity, place.owner, joined(written)));
  }
  if (place.group == "load" && place.quantity != "work" && torque_.at(place.owner) != (place.quantity == "moment"))
    refuse(
        fmt::format("the run does not write the {} of {}: of forces there are force and work, of torques moment "
                    "and work",
                    place.quantity, place.owner));
  if (place.group == "beam" && place.element >= beam_elements_.at(place.owner))
    refuse(fmt::format("the beam has {} elements, counted from 0", beam_elements_.at(place.owner)));
}

std::size_t PlannedHistories::count(const std::string& channel) const {
  const auto found = find_channels(channel, names_, case_path_);
  for (const auto& places : found)
    for (const ChannelPlace& place : places) expect_written(place);
  return found.size();
}

void PlannedHistories::expect_velocity(const std::string& set) const {
  std::vector<std::string> moving;
  for (const HistorySet& one : sets_)
    if (one.has("velocity")) moving.push_back(one.name);
  if (std::find(moving.begin(), moving.end(), set) != moving.end()) return;
  throw InputError(
      fmt::format("the run does not write the velocity of a set '{}'; {}", set,
                  moving.empty() ? "the case names sets of nodes in output.history_sets" : suggestion(set, moving)));
}

}  // namespace railwave
