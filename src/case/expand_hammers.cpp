#include "case/expand_hammers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "case/track_entries.hpp"

namespace railwave::case_file {
namespace {

using scene::Scene;

class Expansion {
 public:
  Expansion(Scene& scene, Complaints& complaints) : scene_(scene), complaints_(complaints) {}

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
    for (int k = 0; k < probe.count; ++k) {
      scene::Vec3 position = probe.position;
      for (int i = 0; i < 3; ++i) position[i] += k * probe.spacing[i];
      const std::string name = probe.count == 1 ? probe.name : fmt::format("{}_{}", probe.name, k + 1);
      if (!add_set(probe, name, position, subject)) return;
    }
  }

 private:
  template <class Entry>
  bool add_set(const Entry& entry, const std::string& name, const scene::Vec3& position, const std::string& subject) {
    const auto taken = std::find_if(scene_.node_sets.begin(), scene_.node_sets.end(), [&](const scene::NodeSet& set) {
      return set.part == entry.part && set.name == name;
    });
    if (taken != scene_.node_sets.end()) {
      complaints_.add({entry.line},
                      fmt::format("{}: makes the node set '{}.{}', which is there already (line {}); rename one",
                                  subject, entry.part, name, taken->line));
      return false;
    }
    scene::NodeSet set;
    set.name = name;
    set.line = entry.line;
    set.part = entry.part;
    set.surface = entry.surface;
    set.position = position;
    set.radius = entry.radius;
    scene_.node_sets.push_back(set);
    auto& histories = scene_.output.history_sets;
    const std::string history = set.part + "." + name;
    if (std::find(histories.begin(), histories.end(), history) == histories.end()) histories.push_back(history);
    return true;
  }

  Scene& scene_;
  Complaints& complaints_;
};

}  // namespace

void expand_hammers(Scene& scene, Complaints& complaints) {
  Expansion expansion(scene, complaints);
  for (const auto& hammer : scene.hammers) expansion.add(hammer);
  for (const auto& probe : scene.probes) expansion.add(probe);
}

}  // namespace railwave::case_file
