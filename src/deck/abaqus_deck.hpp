#pragma once

#include <map>
#include <string>
#include <vector>

#include "deck/deck.hpp"
#include "deck/report.hpp"
#include "mesh/files/abaqus_lines.hpp"
#include "mesh/files/mesh_file.hpp"

namespace railwave::deck {

/// Reads an Abaqus input file of an explicit calculation: its mesh (see read_abaqus_file), and of the model materials,
/// sections, amplitudes, boundary conditions, loads, contact pairs, ties and the step. One flat model or one part with
/// one instance. Names become numbers of the deck. Throws InputError "file:line: what, how to mend"; what must not be
/// left out goes into the report as a refusal.
void read_abaqus_deck(const std::string& path, Deck& deck, Report& report);

/// What readers of Abaqus' keywords share.
class AbaqusDeckReader {
 public:
  AbaqusDeckReader(const std::string& path, Deck& deck, Report& report);
  void read();

  Deck& deck;
  Report& report;
  AbaqusNumbers file;
  AbaqusLines lines;
  bool in_step = false;

  [[noreturn]] void fail(const FilePlace& place, const std::string& text) const;
  double real(std::string_view field, const char* what) const;
  Number whole(std::string_view field, const char* what) const;
  Source source(const AbaqusKeyword& keyword) const { return {keyword.place, keyword.name}; }
  Source here(const AbaqusKeyword& keyword) const { return {lines.place(), keyword.name}; }

  /// The number of a thing that is known by a name; a new one for a new name.
  Number number_of(const std::string& kind, const std::string& name);

  /// A set of nodes or one node, by name or number.
  Nodes nodes(std::string_view field);
  /// The segment set of a surface. Throws InputError where there is none of that name.
  Number surface(const std::string& name, const FilePlace& place);
  /// The elements of a set, or one; all where the field is empty.
  std::vector<int> elements(std::string_view field);
  /// A curve, also of an amplitude that comes later; without a name that which is 1 always.
  Number curve(const AbaqusKeyword& keyword);

 private:
  void take(const AbaqusKeyword& keyword);
  void take_mesh();
  void read_material(const AbaqusKeyword& keyword);
  void read_material_data(const AbaqusKeyword& keyword);
  void read_plastic(const AbaqusKeyword& keyword);
  void read_section(const AbaqusKeyword& keyword);
  void read_amplitude(const AbaqusKeyword& keyword);
  void read_friction(const AbaqusKeyword& keyword);
  void read_pair(const AbaqusKeyword& keyword);
  void read_inclusions(const AbaqusKeyword& keyword);
  void read_properties(const AbaqusKeyword& keyword);
  void read_tie(const AbaqusKeyword& keyword);
  void read_dynamic(const AbaqusKeyword& keyword);
  void read_viscosity(const AbaqusKeyword& keyword);
  void read_output(const AbaqusKeyword& keyword);
  void read_node_output(const AbaqusKeyword& keyword);
  void begin_step(const AbaqusKeyword& keyword);
  void finish();
  void skip() {
    while (lines.has_data()) lines.take_fields();
  }

  std::map<std::pair<std::string, std::string>, Number> numbers_;
  std::map<std::string, double> friction_;                         // by interaction
  std::vector<std::pair<std::size_t, std::string>> interactions_;  // of contacts
  std::map<Number, double> mass_damping_, stiffness_damping_;      // by material
  std::string interaction_;
  Number material_ = 0;
  bool amplitude_wanted_ = false, history_ = false;
};

// What moves and loads, in abaqus_actions.cpp.
void read_abaqus_boundary(AbaqusDeckReader& reader, const AbaqusKeyword& keyword);
void read_abaqus_velocity(AbaqusDeckReader& reader, const AbaqusKeyword& keyword);
void read_abaqus_nodal_load(AbaqusDeckReader& reader, const AbaqusKeyword& keyword);
void read_abaqus_distributed_load(AbaqusDeckReader& reader, const AbaqusKeyword& keyword);
void read_abaqus_surface_load(AbaqusDeckReader& reader, const AbaqusKeyword& keyword);

}  // namespace railwave::deck
