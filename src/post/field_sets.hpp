#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "post/results_reader.hpp"

namespace railwave {

/// A field that a set of a results file has.
struct SetField {
  std::string name;  ///< of its dataset
  bool of_nodes = true;
  std::size_t components = 1;
};

/// A set of bodies, facets or beams whose fields a run has written.
struct FieldSet {
  std::string name;
  hdf5::Group group;
  std::size_t corner_count = 8;     ///< 8: hexahedra; 4: facets of a surface; 2: elements of beams
  std::vector<double> coordinates;  ///< undeformed, three a node, m
  std::vector<long> connectivity;   ///< `corner_count` a cell, positions among the nodes
  std::vector<long> nodes;          ///< numbers in the model
  std::vector<long> elements;       ///< likewise, ascending by cell or not; of beams counted from the first beam on
  std::vector<double> times;        ///< of its whole outputs, s, ascending
  std::vector<SetField> fields;

  std::size_t node_count() const { return nodes.size(); }
  std::size_t cell_count() const { return elements.size(); }
  bool is_beam() const { return corner_count == 2; }
  /// Null where it has none of that name.
  const SetField* field(const std::string& name) const;
  /// One output of a field. Throws std::runtime_error where the file holds another number of values.
  std::vector<double> values(const SetField& field, std::size_t output) const;
};

/// All sets with cells of a results file: those of output.field_sets, then beams. Throws InputError where the file is
/// damaged.
std::vector<FieldSet> read_field_sets(const ResultsReader& results);

/// Whether all elements of the first are among those of the second.
bool is_within(const FieldSet& one, const FieldSet& other);

}  // namespace railwave
