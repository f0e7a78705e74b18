#include "case/read_case.hpp"

#include <filesystem>
#include <set>

#include "case/document.hpp"
#include "case/expand.hpp"
#include "case/keys.hpp"
#include "case/plausible.hpp"
#include "case/read_entry.hpp"
#include "case/suggest.hpp"

namespace railwave {
namespace {

using namespace case_file;

/// Names are parts of other names (`part.set`) and of paths in the results file.
std::string name_mistake(const Section& section, const std::string& name) {
  if (name.empty()) return "the name is empty";
  const auto allowed = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-";
  if (name.find('.') != std::string::npos)
    return "the name '" + printable(name) + "' has a dot, which separates part and set in 'part.set'; use '_'";
  if (name.find_first_not_of(allowed) != std::string::npos)
    return "the name '" + printable(name) + "' may only have letters a-z, digits, '_' and '-'";
  const bool body = section.name == "parts" || section.name == "points";
  if (body && name == "ground") return "'ground' is what connectors are held by; choose another name";
  return "";
}

void read_named(const Section& section, const Node& entries, scene::Scene& scene, Reading& reading) {
  auto& complaints = reading.complaints;
  const auto not_understood = [&] { reading.unsure |= references_to(section.name); };
  if (entries.type != Node::Type::table) {
    const auto mend =
        entries.type == Node::Type::list
            ? "is a list; write [" + section.name + ".NAME] with single brackets for each " + section.singular
            : "is " + entries.described() + ", must be a section " + section.title() + " for each " + section.singular;
    not_understood();
    complaints.add(entries.where, "[" + section.name + "]: " + mend);
    return;
  }
  for (const auto& node : entries.children) {
    const auto subject = "[" + section.name + "." + printable(node.name) + "]";
    if (node.type == Node::Type::table) {
      const auto mistake = name_mistake(section, node.name);
      if (!mistake.empty()) complaints.add(node.where, subject + ": " + mistake);
      read_entry(section, node, section.open(scene, {node.name, node.where.line}), subject, reading);
    } else if (node.type == Node::Type::list && !node.children.empty() && node.children[0].type == Node::Type::table) {
      not_understood();
      complaints.add(node.where,
                     subject + ": is written in double brackets; write " + subject + " once, with single brackets");
    } else {
      not_understood();
      complaints.add(node.where, "[" + section.name + "] " + printable(node.name) +
                                     ": stands outside a named section; write " + section.title() +
                                     " above it, with a name of your choice for the " + section.singular);
    }
  }
}

void read_single(const Section& section, const Node& node, scene::Scene& scene, Reading& reading) {
  const auto subject = "[" + section.name + "]";
  if (node.type == Node::Type::table) {
    read_entry(section, node, section.open(scene, {section.name, node.where.line}), subject, reading);
  } else if (node.type == Node::Type::list && !node.children.empty() && node.children[0].type == Node::Type::table) {
    reading.complaints.add(node.where,
                           subject + ": is written in double brackets; write it once, with single brackets");
  } else {
    reading.complaints.add(node.where,
                           subject + ": is " + node.described() + ", must be a section " + subject + " with keys");
  }
}

/// Complains about a section that doesn't exist; returns the name of the one that was probably meant, or "".
std::string unknown_section(const Node& node, Reading& reading) {
  const auto near = nearest_name(node.name, section_names());
  const auto mend =
      near.empty() ? suggestion(node.name, section_names()) : "did you mean " + find_section(near)->title() + "?";
  reading.complaints.add(node.where, "[" + printable(node.name) + "]: unknown section; " + mend);
  reading.unsure |= references_to(near);
  return near;
}

/// Gives sections under names of earlier versions their present ones.
void rename_sections(Node& root, Complaints& complaints, Complaints& remarks) {
  for (auto& node : root.children) {
    const auto* section = find_renamed_section(node.name);
    if (!section) continue;
    if (root.find(section->name))
      complaints.add(node.where, "[" + section->former_name + "]: is the former name of [" + section->name +
                                     "], which the file has too; put the keys of both there");
    else
      remarks.add(node.where, renamed_text(*section));
    node.name = section->name;
  }
}

void read_sections(const Node& root, scene::Scene& scene, Reading& reading) {
  std::set<std::string> meant;
  const auto& top = *find_section("");
  read_entry(top, root, &scene, "", reading);
  for (const auto& node : root.children) {
    const auto* section = node.name.empty() ? nullptr : find_section(node.name);
    if (!section) {
      if (is_section(node)) meant.insert(unknown_section(node, reading));
      continue;
    }
    section->named() ? read_named(*section, node, scene, reading) : read_single(*section, node, scene, reading);
  }
  for (const auto& section : sections()) {
    if (!section.required || !reading.complete || meant.count(section.name) != 0) continue;
    const auto* node = root.find(section.name);
    if (section.name == "parts" && !scene.tracks.empty()) continue;
    if (node && (!section.named() || !node->children.empty())) continue;
    std::string needed;
    for (const auto& key : section.keys) {
      if (key.required) needed += (needed.empty() ? "" : " and ") + key.name;
    }
    reading.complaints.add({}, section.title() + " is missing; add it, with " + needed);
  }
}

std::string name_of(const std::string& case_path) {
  const std::string name = std::filesystem::path(case_path).stem().string();
  return name.empty() || name == "." || name == ".." ? "case" : name;
}

}  // namespace

std::string default_results_folder(const std::string& case_path) { return "results/" + name_of(case_path); }

std::string default_results_file(const std::string& case_path) {
  return default_results_folder(case_path) + '/' + name_of(case_path) + ".h5";
}

scene::Scene read_case(const std::string& path, const std::vector<std::string>& overrides,
                       std::vector<std::string>* warnings, const std::vector<std::string>& origins) {
  const auto text = load_text(path);
  Complaints complaints(path, origins);
  auto document = parse_document(text, complaints);
  if (!document.usable) complaints.throw_if_any();

  scene::Scene scene;
  scene.path = path;
  Complaints remarks(path, origins);
  rename_sections(document.root, complaints, remarks);
  apply_overrides(overrides, document.root, complaints, remarks);
  scene.static_text = static_text(document.root);
  Reading reading{complaints,        remarks,           std::filesystem::path(path).parent_path().string(),
                  document.complete, refers_to_nothing, {}};
  scene.output.file = default_results_file(path);
  read_sections(document.root, scene, reading);
  // Tracks with mistakes of their own would make more; what their parts are named isn't known then.
  if (complaints.empty())
    expand_tracks(scene, complaints);
  else if (!scene.tracks.empty())
    reading.unsure |= references_to("tracks");
  fit_to_rails(scene, complaints);
  if (complaints.empty()) read_curves(scene, complaints);
  if (complaints.empty()) expand_hammers(scene, complaints);
  if (document.complete) {
    check_references(reading.names, scene, reading.unsure, complaints);
    check_scene(scene, complaints);
  }
  complaints.throw_if_any();
  remark_on_scene(scene, remarks);
  if (warnings) *warnings = remarks.lines();
  return scene;
}

}  // namespace railwave
