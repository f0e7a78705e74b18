#pragma once

#include <string>
#include <vector>

#include "case/key.hpp"

/// The one table of everything that a case file may say. Reading, checking, help text, docs/case-file.md and
/// docs/case.schema.json all come from it: a new key is one line in keys_*.cpp.
namespace railwave::case_file {

/// All sections in the order of the documentation; the first, without a name, holds the keys above all sections.
const std::vector<Section>& sections();

/// The section of that name, or null.
const Section* find_section(const std::string& name);

/// The section that had that name in earlier versions, or null.
const Section* find_renamed_section(const std::string& former_name);

/// The warning about a section under its former name.
std::string renamed_text(const Section& section);

/// Names of all sections that have one.
std::vector<std::string> section_names();

/// Names of the keys that an entry of that type may have, each once; an empty type means every type.
std::vector<std::string> key_names(const Section& section, const std::string& type = "");

Section title_keys();  // keys_run.cpp
Section settle_section();
Section time_section();
Section checkpoint_section();
Section solver_section();
Section output_section();
Section output_window_section();

Section monitor_section();  // keys_monitor.cpp

/// What the sets of a type of mesh are called, for the reference page.
struct MeshSets {
  std::string type, node_sets, surfaces, element_sets;
};

Section mesh_section();  // keys_meshes.cpp
std::vector<MeshSets> mesh_sets();
Section seam_section();

Section material_section();  // keys_bodies.cpp
Section part_section();
Section point_section();

Section node_set_section();     // keys_track.cpp
Section element_set_section();  // keys_hammers.cpp
Section sleeper_section();
Section track_section();

Section beam_section();  // keys_beams.cpp

Section hammer_section();  // keys_hammers.cpp
Section probe_section();

Section curve_section();  // keys_actions.cpp
Section load_section();
Section connector_section();
Section constraint_section();
Section contact_section();
Section motion_section();
Section prescribed_section();
Section non_reflecting_section();
Section absorbing_layer_section();
Section tie_section();
Section gravity_section();

}  // namespace railwave::case_file
