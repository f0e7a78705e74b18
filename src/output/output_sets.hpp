#pragma once

#include <string>
#include <vector>

#include "case/field_table.hpp"
#include "case/scene.hpp"
#include "model/assembly.hpp"

namespace railwave {

/// The part of the model whose fields are written: elements of a part or an element set, the facets of a surface, or
/// beams.
struct OutputSet {
  std::string name;
  int corner_count = 8;       ///< 8: hexahedra; 4: facets of a surface; 2: elements of beams
  std::vector<int> nodes;     ///< model node numbers, ascending
  std::vector<int> elements;  ///< model element numbers, one an entry; of a surface: the element under the facet; of
                              ///< beams: their elements, counted from the first beam of the scene on
  std::vector<int> corners;   ///< `corner_count` an entry, positions in `nodes`
  std::vector<double> coordinates;  ///< undeformed, three a node, m

  bool is_surface() const { return corner_count == 4; }
  bool is_beam() const { return corner_count == 2; }
  /// Beams have no fields of elements but their section forces.
  bool has(const FieldRow& row) const { return row.of_nodes() || !is_beam(); }
  /// Nodes or elements of which the field is written.
  const std::vector<int>& numbers(const FieldRow& row) const { return row.of_nodes() ? nodes : elements; }
  /// Group of the results file.
  std::string group() const { return (is_beam() ? "/beams/" : "/fields/") + name; }
};

/// The sets that scene.output.field_sets names, each once; then the scene's beams, each of them a set. Throws
/// InputError naming every entry that is no part, element set or surface of the assembly.
std::vector<OutputSet> resolve_output_sets(const scene::Scene& scene, const Assembly& assembly);

}  // namespace railwave
