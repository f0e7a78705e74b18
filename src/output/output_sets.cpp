#include "output/output_sets.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "case/error.hpp"
#include "case/suggest.hpp"

namespace railwave {
namespace {

/// Gives the nodes that `corners` (model numbers) uses their numbers in the set.
void number_nodes(OutputSet& set, const Assembly& assembly) {
  set.nodes = set.corners;
  std::sort(set.nodes.begin(), set.nodes.end());
  set.nodes.erase(std::unique(set.nodes.begin(), set.nodes.end()), set.nodes.end());
  for (int& corner : set.corners)
    corner = static_cast<int>(std::lower_bound(set.nodes.begin(), set.nodes.end(), corner) - set.nodes.begin());
  for (const int node : set.nodes)
    set.coordinates.insert(set.coordinates.end(), assembly.nodes[node].begin(), assembly.nodes[node].end());
}

OutputSet volume(const std::string& name, const std::vector<int>& elements, const Assembly& assembly) {
  OutputSet set;
  set.name = name;
  set.elements = elements;
  for (const int element : elements)
    set.corners.insert(set.corners.end(), assembly.elements[element].begin(), assembly.elements[element].end());
  number_nodes(set, assembly);
  return set;
}

OutputSet surface(const std::string& name, const std::vector<Face>& faces, const Assembly& assembly) {
  OutputSet set;
  set.name = name;
  set.corner_count = 4;
  for (const Face& face : faces) {
    const auto nodes = assembly.face_nodes(face);
    set.elements.push_back(face.element);
    set.corners.insert(set.corners.end(), nodes.begin(), nodes.end());
  }
  number_nodes(set, assembly);
  return set;
}

OutputSet beam(const scene::Scene& scene, int number, const Assembly& assembly) {
  OutputSet set;
  set.name = scene.beams[number].name;
  set.corner_count = 2;
  int element = 0;
  for (const Assembly::BeamChain& chain : assembly.beam_chains)
    for (std::size_t k = 0; k + 1 < chain.nodes.size(); ++k, ++element) {
      if (chain.beam != number) continue;
      set.elements.push_back(element);
      set.corners.insert(set.corners.end(), {chain.nodes[k], chain.nodes[k + 1]});
    }
  number_nodes(set, assembly);
  return set;
}

std::vector<int> elements_of(const Assembly::PartRange& part) {
  std::vector<int> elements(part.element_count);
  for (int i = 0; i < part.element_count; ++i) elements[i] = part.first_element + i;
  return elements;
}

std::string complaint(const scene::Scene& scene, const std::string& name, const Assembly& assembly) {
  if (assembly.node_sets.count(name))
    return fmt::format(
        "{}: output.field_sets: '{}' is a set of nodes; fields are written for a part, an element set or a surface",
        scene.path, name);
  std::vector<std::string> known;
  for (const auto& part : assembly.parts) known.push_back(part.name);
  for (const auto& entry : assembly.element_sets) known.push_back(entry.first);
  for (const auto& entry : assembly.surfaces) known.push_back(entry.first);
  std::sort(known.begin(), known.end());
  known.erase(std::unique(known.begin(), known.end()), known.end());
  return fmt::format("{}: output.field_sets: there is no part, element set or surface '{}'; {}", scene.path, name,
                     suggestion(name, known));
}

}  // namespace

std::vector<OutputSet> resolve_output_sets(const scene::Scene& scene, const Assembly& assembly) {
  std::vector<OutputSet> sets;
  std::vector<std::string> complaints;
  for (const std::string& name : scene.output.field_sets) {
    if (std::any_of(sets.begin(), sets.end(), [&](const OutputSet& set) { return set.name == name; })) continue;
    const auto part =
        std::find_if(assembly.parts.begin(), assembly.parts.end(), [&](const auto& p) { return p.name == name; });
    if (part != assembly.parts.end()) {
      sets.push_back(volume(name, elements_of(*part), assembly));
    } else if (const auto elements = assembly.element_sets.find(name); elements != assembly.element_sets.end()) {
      sets.push_back(volume(name, elements->second, assembly));
    } else if (const auto faces = assembly.surfaces.find(name); faces != assembly.surfaces.end()) {
      sets.push_back(surface(name, faces->second, assembly));
    } else {
      complaints.push_back(complaint(scene, name, assembly));
    }
  }
  if (!complaints.empty()) throw InputError(complaints);
  for (std::size_t b = 0; b < scene.beams.size(); ++b) sets.push_back(beam(scene, static_cast<int>(b), assembly));
  return sets;
}

}  // namespace railwave
