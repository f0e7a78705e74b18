#pragma once

#include <vector>

#include "model/contact/contact_state.hpp"

namespace railwave {

/// Which facets meet at each node of a contact surface.
class FacetsAroundNodes {
 public:
  explicit FacetsAroundNodes(const ContactSide& side);

  struct List {
    const int *first, *last;
    const int* begin() const { return first; }
    const int* end() const { return last; }
  };
  List operator[](int node) const { return {facets_.data() + first_[node], facets_.data() + first_[node + 1]}; }

 private:
  std::vector<int> first_, facets_;
};

/// Nodes of a side that touch: their contact force along the inward normal is above `contact_threshold`.
struct TouchingNodes {
  std::vector<double> pressure;  ///< Pa, of every node of the side; zero of those that do not touch
  std::vector<int> nodes;        ///< those that touch

  bool has(int node) const { return pressure[node] > 0; }
};
TouchingNodes touching_nodes(const ContactSide& side);

/// Touching nodes that hang together over the surface: two that share a facet are of one component. Each is sorted.
std::vector<std::vector<int>> connected_nodes(const ContactSide& side, const FacetsAroundNodes& around,
                                              const TouchingNodes& touching);

/// Facets with one of `nodes` as a corner, sorted; and all nodes of such facets, sorted.
std::vector<int> facets_around(const FacetsAroundNodes& around, const std::vector<int>& nodes);
std::vector<int> nodes_of_facets(const ContactSide& side, const std::vector<int>& facets);

inline constexpr double contact_threshold = 1e-3;  ///< N, thesis 3.4.1

}  // namespace railwave
