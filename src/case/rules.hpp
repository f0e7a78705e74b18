#pragma once

#include <initializer_list>
#include <string>

#include "case/scene.hpp"

namespace railwave::case_file {

/// What a rule sees of the entry that was just read, besides its values.
class EntryCheck {
 public:
  virtual ~EntryCheck() = default;
  virtual bool given(const std::string& key) const = 0;
  /// None of these keys has been complained about yet, so that their values may be compared.
  virtual bool sound(std::initializer_list<std::string> keys) const = 0;
  /// Adds a mistake at the key's line, or the entry's if the key is absent.
  virtual void complain(const std::string& key, const std::string& text) = 0;
  /// Warns at the same place: the value is odd, but may be meant.
  virtual void remark(const std::string& key, const std::string& text) = 0;
};

// Rules that bind several keys of one entry; each gets the section's entry. They also set defaults that depend on
// another key.
void check_mesh(void* entry, EntryCheck& check);
void check_part(void* entry, EntryCheck& check);
void check_sleeper(void* entry, EntryCheck& check);  // rules_track.cpp
void check_track(void* entry, EntryCheck& check);
void check_node_set(void* entry, EntryCheck& check);  // rules_hammers.cpp
void check_element_set(void* entry, EntryCheck& check);
void check_hammer(void* entry, EntryCheck& check);
void check_probe(void* entry, EntryCheck& check);
void check_beam(void* entry, EntryCheck& check);
void check_constraint(void* entry, EntryCheck& check);
void check_connector(void* entry, EntryCheck& check);
void check_contact(void* entry, EntryCheck& check);
void check_curve(void* entry, EntryCheck& check);
void check_motion(void* entry, EntryCheck& check);
void check_prescribed(void* entry, EntryCheck& check);
void check_tie(void* entry, EntryCheck& check);
void check_time(void* entry, EntryCheck& check);
void check_output(void* entry, EntryCheck& check);
void check_output_window(void* entry, EntryCheck& check);

/// Rules that bind a rail mesh's keys, in each section that has them.
void check_rail(const scene::RailMesh& rail, EntryCheck& check);

}  // namespace railwave::case_file
