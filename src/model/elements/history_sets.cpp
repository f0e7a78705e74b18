#include "model/elements/history_sets.hpp"

#include <algorithm>
#include <iterator>

#include "case/error.hpp"
#include "mesh/hexahedron.hpp"
#include "model/sets/place_sets.hpp"

namespace railwave {
namespace {

/// The probe that made a set `part.NAME` or `part.NAME_3`, with that one's position.
struct AskedProbe {
  const scene::Probe* probe = nullptr;
  Vec3 position{};
};

AskedProbe probe_of(const scene::Scene& scene, const std::string& part, const std::string& name) {
  const auto made_sets = [&](const auto& sets, const scene::Probe& probe) -> const std::optional<Vec3>* {
    for (const auto& set : sets)
      if (set.part == part && set.name == name && set.line == probe.line && set.position) return &set.position;
    return nullptr;
  };
  for (const scene::Probe& probe : scene.probes) {
    if (probe.part != part) continue;
    if (probe.name != name && (probe.count == 1 || name.rfind(probe.name + "_", 0) != 0)) continue;
    for (const auto* position : {made_sets(scene.element_sets, probe), made_sets(scene.node_sets, probe)})
      if (position) return {&probe, **position};
  }
  return {};
}

bool yields(const scene::Scene& scene, const Assembly& assembly, const std::vector<int>& elements) {
  return std::any_of(assembly.parts.begin(), assembly.parts.end(), [&](const Assembly::PartRange& part) {
    return scene.materials[part.material].yield_stress && std::any_of(elements.begin(), elements.end(), [&](int e) {
             return e >= part.first_element && e < part.first_element + part.element_count;
           });
  });
}

bool asks(const scene::Probe& probe, const FieldRow& row) {
  return std::find(probe.quantities.begin(), probe.quantities.end(), row.name) != probe.quantities.end();
}

HistorySet resolve(const scene::Scene& scene, const Assembly& assembly, const std::string& name) {
  HistorySet set;
  set.name = name;
  const auto dot = name.find('.');
  const std::string part = name.substr(0, dot), own = dot == std::string::npos ? "" : name.substr(dot + 1);
  const auto nodes = assembly.node_sets.find(name);
  const auto elements = assembly.element_sets.find(name);
  const bool has_nodes = nodes != assembly.node_sets.end() && !nodes->second.empty();
  const bool has_elements = !own.empty() && elements != assembly.element_sets.end() && !elements->second.empty();
  if (!has_nodes && !has_elements) {
    std::vector<std::string> known;
    for (const auto* sets : {&assembly.node_sets, &assembly.element_sets})
      for (const auto& one : *sets)
        if (one.first.find('.') != std::string::npos || find_entry(scene.points, one.first)) known.push_back(one.first);
    std::sort(known.begin(), known.end());
    known.erase(std::unique(known.begin(), known.end()), known.end());
    throw InputError(unknown_set(scene, {"history_sets", 0}, "output", name, known));
  }
  const AskedProbe asked = probe_of(scene, part, own);
  for (const FieldRow* row : fields_for(FieldRow::histories)) {
    if (row->of_nodes() ? !has_nodes : !has_elements) continue;
    const bool idle =
        !asked.probe && std::string(row->name) == "plastic_strain" && !yields(scene, assembly, elements->second);
    if (!idle && (!asked.probe || asks(*asked.probe, *row))) set.quantities.push_back(row);
  }
  if (const auto* hammer = find_entry(scene.hammers, own); hammer && hammer->part == part)
    set.asked_by = "hammer " + own;
  if (asked.probe) {
    set.asked_by = "probe " + asked.probe->name;
    set.asked_position = asked.position;
  }
  if (!set.inside()) return set;
  set.elements = elements->second;
  std::sort(set.elements.begin(), set.elements.end());
  set.elements.erase(std::unique(set.elements.begin(), set.elements.end()), set.elements.end());
  const auto share = volume_shares(assembly, set.elements);
  for (std::size_t k = 0; k < share.size(); ++k)
    for (int i = 0; i < 3; ++i) set.element_centre[i] += share[k] * element_centre(assembly, set.elements[k])[i];
  return set;
}

}  // namespace

bool HistorySet::has(const std::string& quantity) const {
  return std::any_of(quantities.begin(), quantities.end(), [&](const FieldRow* row) { return row->name == quantity; });
}

std::vector<const FieldRow*> HistorySet::quantities_of(FieldRow::Place place) const {
  std::vector<const FieldRow*> rows;
  std::copy_if(quantities.begin(), quantities.end(), std::back_inserter(rows),
               [&](const FieldRow* row) { return row->place == place; });
  return rows;
}

std::vector<double> volume_shares(const Assembly& assembly, const std::vector<int>& elements) {
  std::vector<double> share;
  double all = 0;
  for (int e : elements) {
    share.push_back(hexahedron_volume(corners_of(assembly.nodes, assembly.elements[e])));
    all += share.back();
  }
  for (double& one : share) one /= all;
  return share;
}

std::vector<HistorySet> resolve_history_sets(const scene::Scene& scene, const Assembly& assembly) {
  std::vector<HistorySet> sets;
  for (const std::string& name : scene.output.history_sets) sets.push_back(resolve(scene, assembly, name));
  return sets;
}

}  // namespace railwave
