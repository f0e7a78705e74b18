#include "modes/modes_command.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "case/error.hpp"
#include "case/suggest.hpp"
#include "model/elements/hourglass_scale.hpp"

namespace railwave {
namespace {

class Selection {
 public:
  Selection(const scene::Scene& scene, const std::vector<std::string>& names) {
    std::vector<std::string> known, complaints;
    for (const auto& part : scene.parts) known.push_back(part.name);
    for (const auto& point : scene.points) known.push_back(point.name);
    for (const std::string& name : names)
      if (std::find(known.begin(), known.end(), name) == known.end())
        complaints.push_back(fmt::format("{}: --part {}: there is no part or point mass of that name; {}", scene.path,
                                         name, suggestion(name, known)));
    if (!complaints.empty()) throw InputError(complaints);
    const std::vector<std::string>& kept = names.empty() ? known : names;
    kept_.insert(kept.begin(), kept.end());
  }

  bool has(const std::string& name) const { return kept_.count(name) > 0; }
  /// Of `part`, `part.set`, a point mass; ground belongs to everybody.
  bool owns(const std::string& set) const { return set == "ground" || has(set.substr(0, set.find('.'))); }

  template <class Entry, class Keep>
  int keep(std::vector<Entry>& entries, const Keep& wanted) const {
    const auto end = std::stable_partition(entries.begin(), entries.end(), wanted);
    const int removed = static_cast<int>(entries.end() - end);
    entries.erase(end, entries.end());
    return removed;
  }

 private:
  std::set<std::string> kept_;
};

/// Elements that hourglass freely have a motion without strain for nearly each of their nodes.
void refuse_free_hourglass(const scene::Scene& scene) {
  std::vector<std::string> complaints;
  for (const scene::Part& part : scene.parts)
    if (settling_hourglass_coefficient(part) == 0)
      complaints.push_back(
          fmt::format("{}:{}: [parts.{}] hourglass_coefficient: is 0, so that elements have motions without strain, "
                      "which are no modes; set it above 0, e.g. --set parts.{}.hourglass_coefficient=0.05",
                      scene.path, part.line, part.name, part.name));
  if (!complaints.empty()) throw InputError(complaints);
}

template <class Entries, class Wanted>
std::string names_of(const Entries& entries, const Wanted& wanted) {
  std::string list;
  int count = 0;
  for (const auto& entry : entries) {
    if (!wanted(entry)) continue;
    if (++count <= 3) list += (list.empty() ? "" : ", ") + entry.name;
  }
  return count > 3 ? fmt::format("{} and {} more", list, count - 3) : list;
}

void note_on_stiffness(const scene::Scene& scene, std::vector<std::string>& notes) {
  const auto viscous = [](const scene::Part& part) { return part.hourglass == scene::HourglassType::viscous; };
  if (const auto list = names_of(scene.parts, viscous); !list.empty())
    notes.push_back(fmt::format(
        "hourglass control of {} is viscous in a run, which has no stiffness: here it is of the stiffness type with "
        "coefficient {:g}, as while a scene settles",
        list, settling_coefficient));
  const bool plastic = std::any_of(scene.materials.begin(), scene.materials.end(),
                                   [](const auto& m) { return m.yield_stress.has_value(); });
  const bool damped = std::any_of(scene.parts.begin(), scene.parts.end(), [](const auto& p) { return p.damped(); }) ||
                      std::any_of(scene.connectors.begin(), scene.connectors.end(),
                                  [](const auto& c) { return c.damping != scene::Vec3{}; });
  if (plastic) notes.push_back("materials are elastic");
  if (damped || !scene.absorbing_layers.empty()) notes.push_back("damping is left out");
  if (!scene.prescribed_motions.empty() || !scene.non_reflecting.empty())
    notes.push_back("sets of prescribed motion and non-reflecting ends are held");
}

}  // namespace

ModeScene mode_scene(const scene::Scene& whole, const std::vector<std::string>& names) {
  const Selection selection(whole, names);
  ModeScene result{whole, {}};
  scene::Scene& scene = result.scene;
  const auto owned = [&](const std::string& set) { return selection.owns(set); };

  if (const auto list = names_of(
          scene.contacts,
          [&](const auto& c) { return owned(c.slave) || std::any_of(c.master.begin(), c.master.end(), owned); });
      !list.empty())
    result.notes.push_back("contacts are left out: " + list);
  const auto crossing = [&](const auto& entry) { return owned(entry.from) != owned(entry.to); };
  if (const auto list = names_of(scene.connectors,
                                 [&](const auto& c) { return crossing(c) && c.from != "ground" && c.to != "ground"; });
      !list.empty())
    result.notes.push_back("connectors to what is not named are left out: " + list);
  if (const auto list = names_of(scene.beams, crossing); !list.empty())
    result.notes.push_back("beams to what is not named are left out: " + list);
  if (const auto list = names_of(scene.ties, [&](const auto& t) { return owned(t.slave) != owned(t.master); });
      !list.empty())
    result.notes.push_back("ties to what is not named are left out: " + list);

  selection.keep(scene.parts, [&](const auto& part) { return selection.has(part.name); });
  selection.keep(scene.points, [&](const auto& point) { return selection.has(point.name); });
  selection.keep(scene.node_sets, [&](const auto& set) { return selection.has(set.part); });
  selection.keep(scene.connectors, [&](const auto& c) { return owned(c.from) && owned(c.to); });
  selection.keep(scene.beams, [&](const auto& beam) { return owned(beam.from) && owned(beam.to); });
  selection.keep(scene.constraints, [&](const auto& c) { return owned(c.target); });
  selection.keep(scene.prescribed_motions, [&](const auto& motion) { return owned(motion.target); });
  selection.keep(scene.non_reflecting, [&](const auto& end) { return owned(end.target); });
  selection.keep(scene.absorbing_layers, [&](const auto& layer) { return owned(layer.target); });
  selection.keep(scene.ties, [&](const auto& tie) { return owned(tie.slave) && owned(tie.master); });
  const bool tied = !scene.ties.empty();
  selection.keep(scene.contacts, [&](const auto& c) {
    return tied && c.close_gap && owned(c.slave) && std::all_of(c.master.begin(), c.master.end(), owned);
  });
  if (scene.parts.empty())
    throw InputError(fmt::format("{}: --part names no part: modes are those of at least one", whole.path));

  refuse_free_hourglass(scene);

  scene.loads.clear();
  scene.initial_motions.clear();
  scene.hammers.clear();
  scene.probes.clear();
  scene.element_sets.clear();
  scene.settle = {};
  scene.output.history_sets.clear();
  scene.output.field_sets.clear();
  scene.solver = {};
  note_on_stiffness(scene, result.notes);
  scene.absorbing_layers.clear();
  return result;
}

}  // namespace railwave
