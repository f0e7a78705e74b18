#include "case/references.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "case/perpendicular.hpp"
#include "case/suggest.hpp"

// Entries of one case file that cannot all hold, as far as their names show it; model/checks/contradictions.cpp looks
// at what the names mean.
namespace railwave::case_file {
namespace {

void check_names(const scene::Scene& scene, Complaints& complaints) {
  for (const auto& mass : scene.points)
    for (const auto& part : scene.parts) {
      if (part.name != mass.name) continue;
      const bool mass_later = mass.line >= part.line;
      complaints.add(
          {mass_later ? mass.line : part.line},
          fmt::format("[{}.{}]: a part and a point mass are both called '{}' (line {}); rename one",
                      mass_later ? "points" : "parts", mass.name, mass.name, mass_later ? part.line : mass.line));
    }
}

/// Two surfaces that an entry presses, or ties, on each other. A contact with several masters has several such pairs.
using SurfacePair = std::pair<std::string, std::string>;

template <class Entry>
std::set<SurfacePair> pairs_of(const Entry& entry) {
  std::set<SurfacePair> pairs;
  for (const std::string& master : scene::SurfaceNames(entry.master))
    if (!entry.slave.empty() && entry.slave != master) pairs.insert(std::minmax(entry.slave, master));
  return pairs;
}

/// The first pair of surfaces that two entries, of one section or two, have in common.
template <class Later, class Earlier>
std::optional<SurfacePair> common_pair(const Later& later, const Earlier& earlier) {
  const auto known = pairs_of(earlier);
  for (const SurfacePair& pair : pairs_of(later))
    if (known.count(pair) != 0) return pair;
  return std::nullopt;
}

/// "has the same two surfaces as", with their names where one of the entries has more.
template <class Later, class Earlier>
std::string same_surfaces(const Later& later, const Earlier& earlier, const SurfacePair& pair) {
  if (scene::SurfaceNames(later.master).size() == 1 && scene::SurfaceNames(earlier.master).size() == 1)
    return "has the same two surfaces as";
  return fmt::format("has '{}' and '{}' like", pair.first, pair.second);
}

template <class Entry>
void check_pairs_of(const std::vector<Entry>& entries, const char* section, const char* why, Complaints& complaints) {
  for (std::size_t i = 0; i < entries.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (const auto pair = common_pair(entries[i], entries[j])) {
        const bool several =
            scene::SurfaceNames(entries[i].master).size() > 1 || scene::SurfaceNames(entries[j].master).size() > 1;
        complaints.add({entries[i].line},
                       fmt::format("[{}.{}]: {} [{}.{}], {}; keep {}", section, entries[i].name,
                                   same_surfaces(entries[i], entries[j], *pair), section, entries[j].name, why,
                                   several ? "them in one of the two" : "one of them"));
      }
}

void check_ties_and_contacts(const scene::Scene& scene, Complaints& complaints) {
  for (const auto& tie : scene.ties)
    for (const auto& contact : scene.contacts)
      if (const auto pair = common_pair(tie, contact))
        complaints.add(
            {tie.line},
            fmt::format(
                "[ties.{}]: {} [contacts.{}] (line {}), but what is tied neither opens nor slides; keep one of the two",
                tie.name, same_surfaces(tie, contact, *pair), contact.name, contact.line));
}

/// Velocities would add up.
void check_initial_motions(const scene::Scene& scene, Complaints& complaints) {
  std::map<std::string, const scene::InitialMotion*> moved;
  for (const auto& motion : scene.initial_motions)
    for (const auto& part : motion.parts) {
      const auto [known, first] = moved.try_emplace(part, &motion);
      if (first || known->second == &motion) continue;
      complaints.add({motion.line},
                     fmt::format("[initial_motion.{}] parts: '{}' has an initial motion already, [initial_motion.{}] "
                                 "(line {}), and the two would add up; give its velocity and "
                                 "its angular velocity in one entry",
                                 motion.name, part, known->second->name, known->second->line));
    }
}

void check_prescribed_motions(const scene::Scene& scene, Complaints& complaints) {
  const auto& motions = scene.prescribed_motions;
  for (auto motion = motions.begin(); motion != motions.end(); ++motion) {
    const auto other = std::find_if(motions.begin(), motion, [&](const auto& before) {
      return !motion->target.empty() && before.target == motion->target && !perpendicular(before, *motion);
    });
    if (other == motion) continue;
    complaints.add({motion->line},
                   fmt::format("[prescribed_motion.{}] target: '{}' is moved in the same directions by "
                               "[prescribed_motion.{}] (line {}); {}",
                               motion->name, motion->target, other->name, other->line, perpendicular_advice));
  }
}

void check_output_windows(const scene::Scene& scene, Complaints& complaints) {
  for (const scene::OutputWindow& window : scene.output_windows) {
    if (window.start > scene.time.end)
      complaints.add({window.line},
                     fmt::format("[output_windows.{}]: starts at {} s, after the run's end (time.end = {} s); let it "
                                 "start earlier, or the run end later",
                                 window.name, window.start, scene.time.end));
    const auto expect_known = [&](const char* key, const std::optional<std::vector<std::string>>& names,
                                  const std::vector<std::string>& known) {
      for (const std::string& name : names.value_or(std::vector<std::string>{}))
        if (std::find(known.begin(), known.end(), name) == known.end())
          complaints.add({window.line}, fmt::format("[output_windows.{}] {}: there is no '{}'; {}", window.name, key,
                                                    name, suggestion(name, known)));
    };
    std::vector<std::string> contacts;
    for (const scene::Contact& contact : scene.contacts) contacts.push_back(contact.name);
    expect_known("field_sets", window.field_sets, scene.output.field_sets);
    expect_known("contacts", window.contacts, contacts);
    if (window.field_sets.value_or(scene.output.field_sets).empty() && window.contacts.value_or(contacts).empty())
      complaints.add({window.line},
                     fmt::format("[output_windows.{}]: nothing would be written; name output.field_sets and "
                                 "output.fields",
                                 window.name));
  }
}

}  // namespace

void check_scene(const scene::Scene& scene, Complaints& complaints) {
  check_names(scene, complaints);
  check_pairs_of(scene.contacts, "contacts", "so that their forces would count twice", complaints);
  check_pairs_of(scene.ties, "ties", "which are tied once only", complaints);
  check_ties_and_contacts(scene, complaints);
  check_initial_motions(scene, complaints);
  check_prescribed_motions(scene, complaints);
  check_output_windows(scene, complaints);
}

}  // namespace railwave::case_file
