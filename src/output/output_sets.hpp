#pragma once

#include <string>
#include <vector>

#include "case/scene.hpp"
#include "model/assembly.hpp"

namespace railwave {

/// The part of the model whose fields are written: elements of a part or an element set, or the facets of a surface.
struct OutputSet {
  std::string name;
  int corner_count = 8;             ///< 8: hexahedra; 4: facets of a surface
  std::vector<int> nodes;           ///< model node numbers, ascending
  std::vector<int> elements;        ///< model element numbers, one an entry; of a surface: the element under the facet
  std::vector<int> corners;         ///< `corner_count` an entry, positions in `nodes`
  std::vector<double> coordinates;  ///< undeformed, three a node, m

  bool is_surface() const { return corner_count == 4; }
};

/// The sets that scene.output.field_sets names, each once. Throws InputError naming every entry that is no part, element
/// set or surface of the assembly.
std::vector<OutputSet> resolve_output_sets(const scene::Scene& scene, const Assembly& assembly);

}  // namespace railwave
