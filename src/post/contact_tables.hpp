#pragma once

#include "output/file_kind.hpp"
#include "post/centre_cut.hpp"
#include "post/contact_patch.hpp"
#include "post/table.hpp"

namespace railwave {

/// By what the tables of `railwave contact` are known again, see FileKind.
FileKind patch_table_kind();
FileKind node_table_kind();
FileKind cut_table_kind();

/// What `railwave contact` writes of one contact: docs/results-file.md lists the columns.
class ContactTables {
 public:
  ContactTables();

  /// Which of the larger ones are wanted.
  bool with_nodes = false, with_facets = false, with_cuts = false;

  /// Adds one instant: row 0 of all patches together, then a row for each, by their numbers.
  /// @param numbers of the solution's patches, see PatchIdentities; empty: from 1 in the solution's order
  void add(double time, const ContactState& state, const ContactSolution& solution, std::vector<int> numbers = {});

  /// Fills the creepages once it is known how fast the patches move over ground: m/s, by instant, NaN where it is not.
  void set_patch_velocity(const std::vector<Vector>& velocities);

  /// The same by row of `patches`: each patch has a velocity of its own.
  void set_velocity_of_rows(const std::vector<Vector>& velocities);

  /// The same with one rolling velocity for all instants, m/s.
  void set_rolling_velocity(double velocity);

  Table patches, nodes, facets, cuts;

 private:
  void set_creepages(std::size_t row, double rolling_velocity);
  void add_patch(double time, int number, const ContactSolution& solution, const ContactPatch& patch);
  void add_nodes(double time, int number, const ContactState& state, const ContactPatch& patch);
  void add_facets(const ContactState& state, const ContactPatch& patch, std::size_t first_node);
  void add_cut(double time, int number, const ContactState& state, const ContactPatch& patch, CutDirection direction);

  std::vector<int> instants_;  ///< of each row of patches
  int instant_count_ = 0;
};

/// Positions of at most `most` of `count` entries, ascending and evenly spread, the first and the last among them; of
/// one alone the last.
std::vector<std::size_t> evenly_chosen(std::size_t count, std::size_t most);

class ResultsReader;
struct ContactRequest;

/// The contact solution at the output times that a request asks for, of one contact or of several that are one contact
/// solution. Throws InputError where no output lies in the times asked for, or where several contacts have outputs at
/// different times.
/// @param name of the solution, for messages
ContactTables contact_tables(const ResultsReader& results, const std::string& name,
                             const std::vector<std::string>& contacts, const ContactRequest& request);

}  // namespace railwave
