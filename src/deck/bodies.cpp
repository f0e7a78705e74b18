#include "deck/bodies.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <numeric>

#include "case/error.hpp"
#include "mesh/files/text_file.hpp"
#include "mesh/hexahedron.hpp"

namespace railwave::deck {
namespace {

int root_of(std::vector<int>& parent, int i) {
  while (parent[i] != i) i = parent[i] = parent[parent[i]];
  return i;
}

}  // namespace

std::string fit_name(const std::string& title) {
  constexpr std::size_t longest = 40;
  std::string name;
  for (const char c : title) {
    const bool good = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-';
    if (good)
      name += c;
    else if (!name.empty() && name.back() != '_')
      name += '_';
  }
  name = name.substr(0, longest);
  while (!name.empty() && name.back() == '_') name.pop_back();
  const bool has_letter = std::any_of(name.begin(), name.end(), [](char c) { return c > '9'; });
  return has_letter ? name : "";
}

Bodies::Bodies(const Deck& deck, const std::map<Number, Settings>& settings, Report& report)
    : mesh_(deck.mesh.connect()) {
  {
    // Elements that are flat, mirrored, or lie on one another are refused here.
    Mesh checked = mesh_;
    std::vector<std::string> notes;
    deck.mesh.complete(checked, notes);
  }
  faces_ = std::make_unique<FaceTable>(mesh_);
  exterior_ = faces_->exterior();
  group(deck, settings, report);
  find_joints(report, deck);
  refuse_corners(report, deck);
}

std::string Bodies::new_name(const std::string& title, const std::string& otherwise) {
  std::string name = fit_name(title);
  if (name.empty()) name = otherwise;
  if (!names_.insert(name).second) {
    const std::string base = name == otherwise ? name : fmt::format("{}_{}", name, otherwise);
    name = base;
    for (int n = 2; !names_.insert(name).second; ++n) name = fmt::format("{}_{}", base, n);
  }
  return name;
}

void Bodies::group(const Deck& deck, const std::map<Number, Settings>& settings, Report& report) {
  std::vector<Number> numbers;  // of parts that have elements
  for (const auto& [number, of_part] : settings) numbers.push_back(number);
  const auto position = [&](Number number) {
    return static_cast<int>(std::lower_bound(numbers.begin(), numbers.end(), number) - numbers.begin());
  };
  std::vector<int> parent(numbers.size());
  std::iota(parent.begin(), parent.end(), 0);
  std::vector<std::vector<int>> at_node(mesh_.nodes.size());
  for (std::size_t e = 0; e < mesh_.elements.size(); ++e) {
    const int part = position(deck.element_parts[e]);
    for (const int node : mesh_.elements[e]) {
      auto& here = at_node[node];
      if (std::find(here.begin(), here.end(), part) != here.end()) continue;
      for (const int other : here)
        if (settings.at(numbers[other]) == settings.at(numbers[part]))
          parent[root_of(parent, part)] = root_of(parent, other);
      here.push_back(part);
    }
  }
  std::map<int, int> body_of_root;
  std::vector<int> body_of_part(numbers.size());
  for (std::size_t p = 0; p < numbers.size(); ++p) {
    const auto [entry, is_new] = body_of_root.emplace(root_of(parent, static_cast<int>(p)), bodies_.size());
    body_of_part[p] = entry->second;
    const Part& part = deck.parts.at(numbers[p]);
    if (is_new) {
      Body body;
      body.name = new_name(part.title, fmt::format("part_{}", numbers[p]));
      body.settings = settings.at(numbers[p]);
      bodies_.push_back(body);
    }
    bodies_[entry->second].parts.push_back(numbers[p]);
  }
  of_element_.resize(mesh_.elements.size());
  of_node_.assign(mesh_.nodes.size(), -1);
  shared_.assign(mesh_.nodes.size(), 0);
  for (std::size_t e = 0; e < mesh_.elements.size(); ++e) {
    const int body = of_element_[e] = body_of_part[position(deck.element_parts[e])];
    bodies_[body].elements.push_back(static_cast<int>(e));
    for (const int node : mesh_.elements[e]) {
      int& of = of_node_[node];
      if (of >= 0 && of != body) shared_[node] = 1;
      if (of < 0 || body < of) of = body;
    }
  }
  for (Body& body : bodies_) {
    body.element_set = fmt::format("{}_{}", body.parts.size() == 1 ? "part" : "parts", fmt::join(body.parts, "_"));
    if (deck.of_abaqus) body.element_set = lower_case(body.name);
    if (body.element_set.size() > 80) body.element_set = fmt::format("parts_{}_and_more", body.parts.front());
    for (const Number number : body.parts) {
      const Source& source = deck.parts.at(number).source;
      if (body.parts.size() == 1)
        report.add(Fate::taken, source, fmt::format("[parts.{}]", body.name));
      else
        report.add(
            Fate::replaced, source,
            fmt::format("part {} is within [parts.{}], with which it shares nodes and material", number, body.name));
    }
  }
}

void Bodies::find_joints(Report&, const Deck&) {
  std::map<std::pair<int, int>, Joint> joints;
  for (std::size_t e = 0; e < mesh_.elements.size(); ++e)
    for (int side = 0; side < 6; ++side) {
      const Face face{static_cast<int>(e), side};
      const auto nodes = mesh_.face_nodes(face);
      if (std::any_of(nodes.begin(), nodes.end(), [&](int n) { return shared_[n] == 0; })) continue;
      for (const Face& other : faces_->find(nodes)) {
        const int a = of_element_[other.element], b = of_element_[face.element];
        if (a >= b) continue;
        Joint& joint = joints[{a, b}];
        joint.owner = a;
        joint.tied = b;
        joint.owner_faces.push_back(other);
        joint.tied_faces.push_back(face);
      }
    }
  for (auto& [pair, joint] : joints) joints_.push_back(std::move(joint));
}

void Bodies::refuse_corners(Report& report, const Deck& deck) {
  // Every body's own copy of a shared node must be tied once, and to a node that is not tied itself.
  std::map<std::pair<int, int>, std::vector<int>> tied_to;  // by body and node: owners
  for (const Joint& joint : joints_)
    for (const Face& face : joint.tied_faces)
      for (const int node : mesh_.face_nodes(face)) {
        auto& owners = tied_to[{joint.tied, node}];
        if (std::find(owners.begin(), owners.end(), joint.owner) == owners.end()) owners.push_back(joint.owner);
      }
  std::set<std::pair<int, int>> told;
  for (std::size_t e = 0; e < mesh_.elements.size(); ++e) {
    const int body = of_element_[e];
    for (const int node : mesh_.elements[e]) {
      if (shared_[node] == 0 || of_node_[node] == body) continue;
      const auto found = tied_to.find({body, node});
      const bool good = found != tied_to.end() && found->second.size() == 1 && found->second[0] == of_node_[node];
      if (good || !told.insert({of_node_[node], body}).second) continue;
      const Body &one = bodies_[of_node_[node]], &other = bodies_[body];
      report.refuse_always(
          {deck.mesh.place_of_element(static_cast<int>(e)), "ELEMENT_SOLID"},
          fmt::format(
              "node {} of this element joins parts {} and {} of different materials at an edge or corner alone, "
              "or where a third part meets them, which ties cannot; give them one material, or nodes of their "
              "own and a *CONTACT_TIED",
              deck.mesh.node_numbers()[node], one.parts.front(), other.parts.front()));
    }
  }
}

bool Bodies::joined(int a, int b) const {
  return std::any_of(joints_.begin(), joints_.end(), [&](const Joint& joint) {
    return (joint.owner == a && joint.tied == b) || (joint.owner == b && joint.tied == a);
  });
}

}  // namespace railwave::deck
