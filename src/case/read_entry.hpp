#pragma once

#include <string>
#include <vector>

#include "case/document.hpp"
#include "case/key.hpp"
#include "case/references.hpp"

namespace railwave::case_file {

/// What is gathered while the entries of a file are read.
struct Reading {
  Complaints& complaints;
  Complaints& remarks;   ///< what is odd, but may be meant
  std::string folder;    ///< of the case file: what paths are relative to
  bool complete = true;  ///< false: don't tell what is missing, a line with broken syntax may have held it
  unsigned unsure = refers_to_nothing;  ///< kinds of names whose section was not understood
  std::vector<NameUse> names;           ///< to be looked up when all is read
};

/// Reads the keys of one table into `entry`, which the section has opened. `subject` is "[parts.wheel]", or "" above
/// all sections.
void read_entry(const Section& section, const Node& table, void* entry, const std::string& subject, Reading& reading);

/// True for a child of the whole file that is meant as a section, known or not, rather than as a key above all
/// sections.
bool is_section(const Node& node);

}  // namespace railwave::case_file
