#pragma once

#include <string>
#include <vector>

namespace railwave::deck {

struct ImportOptions {
  std::string units;                   ///< "mm,t,s"; empty: as the deck's materials have it
  std::vector<std::string> drop;       ///< see Report
  std::string mesh_file = "deck.inp";  ///< how the case is to name its mesh file
};

/// What an LS-DYNA deck became. Texts of files, all or none of which are to be written.
struct Import {
  std::string mesh;                ///< Abaqus input of the hexahedra and sets, in the deck's unit of length
  std::string text;                ///< case file
  std::string report;              ///< line by line, what was taken, replaced, dropped
  std::vector<std::string> files;  ///< that were read
  std::vector<std::string> notes;  ///< for people
  std::size_t nodes = 0, elements = 0, parts = 0, taken = 0, replaced = 0, dropped = 0;
};

/// First lines of the files that are made.
inline constexpr const char* imported_mesh_mark = "mesh of a deck, made by railwave import";
inline constexpr const char* imported_report_mark = "Railwave import, line by line";

/// Reads a deck and makes a mesh and a case of it, in SI units.
/// @throws InputError "file:line: what, how to mend", one line for each reason
Import import_deck(const std::string& path, const ImportOptions& options);

}  // namespace railwave::deck
