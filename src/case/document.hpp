#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "case/complaints.hpp"

namespace railwave::case_file {

/// A value of the TOML text, with the line where it stands. In a table each child has a name, in the file's order.
struct Node {
  enum class Type { text, integer, number, boolean, date, list, table };
  Type type = Type::table;
  std::string name;  ///< as a child of a table
  Where where;       ///< of the name in a table, of the value in a list
  std::string text;
  std::int64_t integer = 0;
  double number = 0;  ///< also of an integer
  bool boolean = false;
  std::vector<Node> children;  ///< of a list or a table

  bool is_number() const { return type == Type::integer || type == Type::number; }
  Node* find(const std::string& child);
  const Node* find(const std::string& child) const;

  /// "text", "a number", "a list": what the value is, for messages.
  std::string described() const;
};

struct Document {
  Node root;
  bool usable = false;  ///< false: only the syntax errors are worth telling
  bool complete =
      false;  ///< false: some lines were left out for their syntax, so that something may only seem to be missing
};

/// The text of a case file. Throws InputError when it is not there, a folder, cannot be read or is not text.
std::string load_text(const std::string& path);

/// Parses TOML. Syntax errors are added to the complaints; a line that is wrong in itself is left out and the rest is
/// read.
Document parse_document(std::string text, Complaints& complaints);

/// The value of an override as TOML; text that is no TOML value counts as a text. Returns false, with
/// a complaint, when it looks like a list, table or quoted text but is broken.
/// @param where the override stands
bool parse_override_value(const std::string& text, const std::string& whole, Where where, Node& value,
                          Complaints& complaints);

/// Puts `section.key=value` texts of the command line into the document, where they replace what the file says;
/// `section.key[1]=value` replaces one entry of a list in the file, which count from 0. A named
/// entry must exist in the file; keys are checked later, like the file's own. Former names of sections bring a remark.
void apply_overrides(const std::vector<std::string>& overrides, Node& root, Complaints& complaints,
                     Complaints& remarks);

/// The values of a case on which its settled state can depend, one line each; blanks and remarks of the file do not
/// matter. Left out are the title, [time], [checkpoint], [monitor], [output] and its windows, probes, element sets,
/// absorbing layers, the choice of the time loop's steps, and the velocities and displacements of initial and
/// prescribed motions, but for the velocity of what rolls: the list is `without` in static_text.cpp. Mesh files count
/// by their names.
std::string static_text(const Node& root);

/// All values of a case, one line each: like static_text(), with nothing left out.
std::string whole_text(const Node& root);

/// A value as it stands in TOML, numbers with as few digits as tell them from others.
std::string toml_text(const Node& value);

}  // namespace railwave::case_file
