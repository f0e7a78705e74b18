#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "mesh/files/numbered_mesh.hpp"

namespace railwave {

/// The node sets or the element sets of an Abaqus file, gathered as they are read and turned into positions when the
/// whole file is known, since a set may name numbers and sets that come later.
class AbaqusSets {
 public:
  enum class Of { nodes, elements };
  AbaqusSets(Of kind, const NumberedMesh& mesh);

  /// Begins or continues the set. Sets of a part and of the assembly have names of their own in Abaqus, but not in a
  /// case file: throws InputError when both define `name`.
  void open(const std::string& name, bool in_assembly, bool internal, const FilePlace& place);

  void add_number(const std::string& name, std::int64_t number, const FilePlace& place);
  /// Numbers first, first + step, ... up to last; those that don't exist are passed over.
  void add_range(const std::string& name, std::int64_t first, std::int64_t last, std::int64_t step,
                 const FilePlace& place);
  /// All of another set of the same kind.
  void add_set(const std::string& name, const std::string& other, const FilePlace& place);

  /// Positions in the set, ascending, without repeats. Throws InputError for what the file doesn't define, and for sets
  /// that contain themselves.
  const std::vector<int>& positions(const std::string& name, const FilePlace& place);

  /// Positions of all sets; of internal ones only where these are asked for.
  std::map<std::string, std::vector<int>> all(bool with_internal = false);

 private:
  struct Number {
    std::int64_t number;
    FilePlace place;
  };
  struct Range {
    std::int64_t first, last, step;
    FilePlace place;
  };
  struct Reference {
    std::string name;
    FilePlace place;
  };
  struct Definition {
    bool in_assembly = false;
    bool internal = false;
    FilePlace place;
    std::vector<Number> numbers;
    std::vector<Range> ranges;
    std::vector<Reference> sets;
    std::optional<std::vector<int>> positions;
    bool being_resolved = false;
  };

  const std::vector<std::int64_t>& defined_numbers() const;
  std::optional<int> find(std::int64_t number) const;
  void resolve(const std::string& name, Definition& set, int depth);
  void add_range_positions(const std::string& name, const Range& range, std::vector<int>& positions) const;

  bool of_nodes_;
  std::string kind_;  // for messages
  const NumberedMesh& mesh_;
  std::map<std::string, Definition> sets_;
};

}  // namespace railwave
