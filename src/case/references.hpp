#pragma once

#include <string>
#include <vector>

#include "case/complaints.hpp"
#include "case/key.hpp"

namespace railwave::case_file {

/// A name somewhere in the file that must refer to something.
struct NameUse {
  Where where;
  std::string subject;  ///< "[parts.wheel] material", for the message
  unsigned refers_to = refers_to_nothing;
  std::string name;
};

/// Complains about each name that refers to nothing in the scene, with the nearest that exists. Sets inside a mesh are
/// not looked up: only that their part exists. Names that may refer to `unsure` kinds are not checked: their section
/// has mistakes of its own.
void check_references(const std::vector<NameUse>& uses, const scene::Scene& scene, unsigned unsure,
                      Complaints& complaints);

/// What names of a section's entries are, as a Reference: `material` for "materials"; refers_to_nothing when nothing
/// refers to them.
unsigned references_to(const std::string& section);

/// "a node set 'part.set', a point mass or 'ground'".
std::string reference_text(unsigned refers_to);

/// Rules that bind several entries (rules_scene.cpp): names that would be ambiguous, pairs of surfaces given twice or
/// tied and in contact, parts and sets that are given two motions.
void check_scene(const scene::Scene& scene, Complaints& complaints);

}  // namespace railwave::case_file
