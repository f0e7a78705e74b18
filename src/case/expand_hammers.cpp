#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "case/expand.hpp"
#include "case/field_table.hpp"
#include "case/track_entries.hpp"

namespace railwave::case_file {
namespace {

using scene::Scene;

class HammerExpansion {
 public:
  HammerExpansion(Scene& scene, Complaints& complaints) : scene_(scene), complaints_(complaints) {}

  void add(const scene::Hammer& hammer) {
    const std::string subject = "[hammers." + hammer.name + "]";
    if (!add_set(hammer, hammer.name, hammer.position, subject)) return;
    scene::Load load;
    load.name = hammer.name;
    load.type = scene::LoadType::nodal_force;
    load.target = hammer.part + "." + hammer.name;
    for (int i = 0; i < 3; ++i) load.force[i] = hammer.peak * hammer.direction[i];
    load.curve = hammer.curve.empty() ? hammer.name : hammer.curve;
    add_entry(scene_.loads, "loads", load, hammer.line, subject, complaints_);
    if (!hammer.curve.empty()) return;
    scene::Curve blow;
    blow.name = hammer.name;
    blow.type = scene::CurveType::half_sine;
    blow.start = hammer.start;
    blow.duration = hammer.duration;
    add_entry(scene_.curves, "curves", blow, hammer.line, subject, complaints_);
  }

  void add(const scene::Probe& probe) {
    const std::string subject = "[probes." + probe.name + "]";
    const auto asks = [&](FieldRow::Place place) {
      return std::any_of(probe.quantities.begin(), probe.quantities.end(), [&](const std::string& quantity) {
        const FieldRow* row = find_field(quantity);
        return row != nullptr && row->place == place;
      });
    };
    const bool motion = asks(FieldRow::Place::node), inside = asks(FieldRow::Place::element);
    for (int k = 0; k < probe.count; ++k) {
      scene::Vec3 position = probe.position;
      for (int i = 0; i < 3; ++i) position[i] += k * probe.spacing[i];
      const std::string name = probe.count == 1 ? probe.name : fmt::format("{}_{}", probe.name, k + 1);
      if (motion && !add_set(probe, name, position, subject)) return;
      if (inside && !add_element_set(probe, name, position, subject, motion)) return;
    }
  }

 private:
  template <class Entry>
  bool add_set(const Entry& entry, const std::string& name, const scene::Vec3& position, const std::string& subject) {
    if (is_taken(scene_.node_sets, "node", entry, name, subject)) return false;
    scene_.node_sets.push_back(placed<scene::NodeSet>(entry, name, position));
    return add_history(entry.part + "." + name);
  }

  /// @param with_nodes the probe has just made a node set of that name, which its elements share
  bool add_element_set(const scene::Probe& probe, const std::string& name, const scene::Vec3& position,
                       const std::string& subject, bool with_nodes) {
    if (is_taken(scene_.element_sets, "element", probe, name, subject)) return false;
    if (!with_nodes && is_taken(scene_.node_sets, "node", probe, name, subject)) return false;
    scene_.element_sets.push_back(placed<scene::ElementSet>(probe, name, position));
    return add_history(probe.part + "." + name);
  }

  template <class Set, class Entry>
  bool is_taken(const std::vector<Set>& sets, const char* kind, const Entry& entry, const std::string& name,
                const std::string& subject) {
    const auto taken = std::find_if(sets.begin(), sets.end(),
                                    [&](const Set& set) { return set.part == entry.part && set.name == name; });
    if (taken == sets.end()) return false;
    complaints_.add({entry.line},
                    fmt::format("{}: makes the {} set '{}.{}', which is there already (line {}); rename one", subject,
                                kind, entry.part, name, taken->line));
    return true;
  }

  template <class Set, class Entry>
  static Set placed(const Entry& entry, const std::string& name, const scene::Vec3& position) {
    Set set;
    set.name = name;
    set.line = entry.line;
    set.part = entry.part;
    set.surface = entry.surface;
    set.position = position;
    set.radius = entry.radius;
    return set;
  }

  bool add_history(const std::string& history) {
    auto& histories = scene_.output.history_sets;
    if (std::find(histories.begin(), histories.end(), history) == histories.end()) histories.push_back(history);
    return true;
  }

  Scene& scene_;
  Complaints& complaints_;
};

}  // namespace

void expand_hammers(Scene& scene, Complaints& complaints) {
  HammerExpansion expansion(scene, complaints);
  for (const auto& hammer : scene.hammers) expansion.add(hammer);
  for (const auto& probe : scene.probes) expansion.add(probe);
}

}  // namespace railwave::case_file
