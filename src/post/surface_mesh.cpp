#include "post/surface_mesh.hpp"

#include <algorithm>

#include "output/fields/contact_section.hpp"

namespace railwave {
namespace {

void sort_once(std::vector<int>& numbers) {
  std::sort(numbers.begin(), numbers.end());
  numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
}

}  // namespace

FacetsAroundNodes::FacetsAroundNodes(const ContactSide& side) : first_(side.nodes.size() + 1, 0) {
  for (const auto& facet : side.facets)
    for (const int corner : facet) ++first_[corner + 1];
  for (std::size_t i = 1; i < first_.size(); ++i) first_[i] += first_[i - 1];
  facets_.resize(first_.back());
  std::vector<int> next(first_.begin(), first_.end() - 1);
  for (std::size_t f = 0; f < side.facets.size(); ++f)
    for (const int corner : side.facets[f]) facets_[next[corner]++] = static_cast<int>(f);
}

TouchingNodes touching_nodes(const ContactSide& side) {
  TouchingNodes result{nodal_pressure(side), {}};
  for (std::size_t i = 0; i < side.nodes.size(); ++i) {
    if (result.pressure[i] * side.area[i] > contact_threshold)
      result.nodes.push_back(static_cast<int>(i));
    else
      result.pressure[i] = 0;
  }
  return result;
}

std::vector<std::vector<int>> connected_nodes(const ContactSide& side, const FacetsAroundNodes& around,
                                              const TouchingNodes& touching) {
  std::vector<std::vector<int>> components;
  std::vector<bool> seen(side.nodes.size(), false);
  for (const int start : touching.nodes) {
    if (seen[start]) continue;
    std::vector<int> component{start};
    seen[start] = true;
    for (std::size_t i = 0; i < component.size(); ++i)
      for (const int facet : around[component[i]])
        for (const int corner : side.facets[facet])
          if (touching.has(corner) && !seen[corner]) {
            seen[corner] = true;
            component.push_back(corner);
          }
    std::sort(component.begin(), component.end());
    components.push_back(std::move(component));
  }
  return components;
}

std::vector<int> facets_around(const FacetsAroundNodes& around, const std::vector<int>& nodes) {
  std::vector<int> facets;
  for (const int node : nodes) facets.insert(facets.end(), around[node].begin(), around[node].end());
  sort_once(facets);
  return facets;
}

std::vector<int> nodes_of_facets(const ContactSide& side, const std::vector<int>& facets) {
  std::vector<int> nodes;
  for (const int facet : facets) nodes.insert(nodes.end(), side.facets[facet].begin(), side.facets[facet].end());
  sort_once(nodes);
  return nodes;
}

}  // namespace railwave
