#include "case/keys.hpp"

#include <algorithm>

namespace railwave::case_file {

const std::vector<Section>& sections() {
  static const std::vector<Section> all = {
      title_keys(),
      material_section(),
      mesh_section(),
      seam_section(),
      part_section(),
      point_section(),
      node_set_section(),
      element_set_section(),
      sleeper_section(),
      track_section(),
      beam_section(),
      connector_section(),
      constraint_section(),
      contact_section(),
      curve_section(),
      load_section(),
      hammer_section(),
      probe_section(),
      gravity_section(),
      motion_section(),
      prescribed_section(),
      non_reflecting_section(),
      absorbing_layer_section(),
      tie_section(),
      settle_section(),
      time_section(),
      checkpoint_section(),
      solver_section(),
      monitor_section(),
      output_section(),
      output_window_section(),
  };
  return all;
}

const Section* find_section(const std::string& name) {
  for (const auto& section : sections()) {
    if (section.name == name) return &section;
  }
  return nullptr;
}

const Section* find_renamed_section(const std::string& former_name) {
  if (former_name.empty()) return nullptr;
  for (const auto& section : sections()) {
    if (section.former_name == former_name) return &section;
  }
  return nullptr;
}

std::string renamed_text(const Section& section) {
  return "[" + section.former_name + "]: is called [" + section.name + "] now; the old name is still accepted";
}

std::vector<std::string> section_names() {
  std::vector<std::string> names;
  for (const auto& section : sections()) {
    if (!section.name.empty()) names.push_back(section.name);
  }
  return names;
}

std::vector<std::string> key_names(const Section& section, const std::string& type) {
  std::vector<std::string> names;
  for (const auto& key : section.keys) {
    const bool new_name = std::find(names.begin(), names.end(), key.name) == names.end();
    if (new_name && (type.empty() || key.belongs_to(type))) names.push_back(key.name);
  }
  return names;
}

}  // namespace railwave::case_file
