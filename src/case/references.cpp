#include "case/references.hpp"

#include <algorithm>

#include "case/suggest.hpp"

namespace railwave::case_file {
namespace {

template <class Entry>
std::vector<std::string> names_of(const std::vector<Entry>& entries) {
  std::vector<std::string> names;
  for (const auto& entry : entries) names.push_back(entry.name);
  return names;
}

bool has(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

void append(std::vector<std::string>& names, const std::vector<std::string>& more) {
  names.insert(names.end(), more.begin(), more.end());
}

std::string set_kind(unsigned refers_to) {
  std::vector<std::string> kinds;
  if (refers_to & node_set) kinds.push_back("node set");
  if (refers_to & element_set) kinds.push_back("element set");
  if (refers_to & surface) kinds.push_back("surface");
  return joined(kinds, " or ");
}

/// Entries of one section: what they are called, and how one is added.
struct Family {
  unsigned bit;
  std::string what, section;
  std::vector<std::string> names;
};

std::string missing(const std::string& what, const std::string& section, const std::string& name,
                    const std::vector<std::string>& candidates) {
  const auto said = "there is no " + what + " '" + printable(name) + "'";
  if (candidates.empty())
    return said + "; none is defined: add a section [" + section + "." + (name.empty() ? "NAME" : printable(name)) +
           "]";
  return said + "; " + suggestion(name, candidates);
}

/// Those of the case, and those that are there without a section.
std::vector<std::string> sleeper_names(const scene::Scene& scene) {
  auto names = names_of(scene.sleepers);
  for (const char* name : {"concrete", "timber"})
    if (!has(names, name)) names.emplace_back(name);
  return names;
}

class Names {
 public:
  explicit Names(const scene::Scene& scene)
      : families_{{material, "material", "materials", names_of(scene.materials)},
                  {mesh, "mesh", "meshes", names_of(scene.meshes)},
                  {curve, "curve", "curves", names_of(scene.curves)},
                  {whole_part, "part", "parts", names_of(scene.parts)},
                  {point, "point mass", "points", names_of(scene.points)},
                  {sleeper, "kind of sleeper", "sleepers", sleeper_names(scene)}},
        parts_(names_of(scene.parts)),
        points_(names_of(scene.points)) {}

  /// What is wrong with the name; empty when nothing is.
  std::string mistake(unsigned refers_to, const std::string& name) const {
    const auto dot = name.find('.');
    const bool may_be_set = (refers_to & any_set) != 0;
    if (dot != std::string::npos && may_be_set)
      return set_mistake(refers_to, name.substr(0, dot), name.substr(dot + 1));
    if ((refers_to & ground) && name == "ground") return "";
    std::vector<std::string> candidates;
    const Family* first = nullptr;
    for (const auto& family : families_) {
      if (!(refers_to & family.bit)) continue;
      if (has(family.names, name)) return "";
      append(candidates, family.names);
      if (!first) first = &family;
    }
    if (may_be_set) return bare_name_mistake(refers_to, name, candidates);
    if (name == "ground") return "'ground' can only be an end of a connector";
    if (dot != std::string::npos && (refers_to & whole_part))
      return "'" + printable(name) + "' has a dot; name the whole part, '" + printable(name.substr(0, dot)) + "'";
    const auto what = (refers_to & whole_part) && (refers_to & point) ? "part or point mass" : first->what;
    return missing(what, first->section, name, candidates);
  }

 private:
  std::string set_mistake(unsigned refers_to, const std::string& part, const std::string& set) const {
    if (!has(parts_, part)) {
      if (has(points_, part)) {
        return "'" + part + "' is a point mass, which has no sets" +
               (refers_to & point ? "; write '" + part + "'" : "; name a part's " + set_kind(refers_to));
      }
      const auto near = nearest_name(part, parts_);
      if (!near.empty())
        return "there is no part '" + printable(part) + "'; did you mean '" + near + "." + printable(set) + "'?";
      return missing("part", "parts", part, parts_);
    }
    if (set.empty()) return "the name of the " + set_kind(refers_to) + " after '" + part + ".' is missing";
    return "";
  }

  std::string bare_name_mistake(unsigned refers_to, const std::string& name,
                                std::vector<std::string> candidates) const {
    if (has(parts_, name)) {
      return "'" + name + "' is a whole part; name a " + set_kind(refers_to) + " of it: '" + name + ".SET'";
    }
    if (has(points_, name)) return "'" + name + "' is a point mass; must be " + reference_text(refers_to);
    if (name == "ground") return "'ground' can only be an end of a connector; must be " + reference_text(refers_to);
    if (refers_to & ground) candidates.push_back("ground");
    for (const auto& part : parts_) {
      if (!(refers_to & whole_part)) candidates.push_back(part + ".SET");
    }
    const auto near = nearest_name(name, candidates);
    return "'" + printable(name) + "' refers to nothing; must be " + reference_text(refers_to) +
           (near.empty() ? "" : "; did you mean '" + near + "'?");
  }

  std::vector<Family> families_;
  std::vector<std::string> parts_, points_;
};

}  // namespace

std::string reference_text(unsigned refers_to) {
  std::vector<std::string> kinds;
  if (refers_to & material) kinds.push_back("a material");
  if (refers_to & mesh) kinds.push_back("a mesh");
  if (refers_to & curve) kinds.push_back("a curve");
  if (refers_to & whole_part) kinds.push_back("a part");
  if (refers_to & sleeper) kinds.push_back("a kind of sleeper");
  if (refers_to & any_set)
    kinds.push_back(((refers_to & element_set) != 0 && (refers_to & node_set) == 0 ? "an " : "a ") +
                    set_kind(refers_to) + " 'part.set'");
  if (refers_to & point) kinds.push_back("a point mass");
  if (refers_to & ground) kinds.push_back("'ground'");
  if (kinds.size() < 2) return joined(kinds);
  const auto last = kinds.back();
  kinds.pop_back();
  return joined(kinds) + " or " + last;
}

unsigned references_to(const std::string& section) {
  if (section == "materials") return material;
  if (section == "meshes") return mesh;
  if (section == "curves") return curve;
  if (section == "parts") return whole_part | any_set;
  if (section == "points") return point;
  if (section == "sleepers") return sleeper;
  // Parts and their sets come from tracks too.
  if (section == "tracks" || section == "node_sets" || section == "element_sets") return whole_part | any_set;
  return refers_to_nothing;
}

void check_references(const std::vector<NameUse>& uses, const scene::Scene& scene, unsigned unsure,
                      Complaints& complaints) {
  const Names names(scene);
  for (const auto& use : uses) {
    if ((use.refers_to & unsure) != 0) continue;
    const auto mistake = names.mistake(use.refers_to, use.name);
    if (!mistake.empty()) complaints.add(use.where, use.subject + ": " + mistake);
  }
}

}  // namespace railwave::case_file
