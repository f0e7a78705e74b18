#include "deck/written_mesh.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "mesh/files/text_file.hpp"

namespace railwave::deck {
namespace {

void append_numbers(std::string& text, const std::vector<std::int64_t>& numbers) {
  constexpr std::size_t per_line = 12;
  for (std::size_t i = 0; i < numbers.size(); ++i)
    fmt::format_to(std::back_inserter(text), "{}{}", numbers[i],
                   i + 1 == numbers.size() || (i + 1) % per_line == 0 ? "\n" : ", ");
}

bool same(const std::vector<int>& a, const std::vector<int>& b) { return a == b; }

bool same(const std::vector<Face>& a, const std::vector<Face>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const Face& one, const Face& other) {
    return one.element == other.element && one.side == other.side;
  });
}

}  // namespace

template <class Set>
std::string WrittenMesh::keep(std::map<std::string, Set>& sets, int body, Set set, const std::string& name) {
  sort_unique(set);
  // Names of mesh files are in lower case. Each body has sets of its own: a name may be another's already.
  const std::string base = lower_case(bodies_.all().size() == 1 ? name : bodies_.all()[body].name + "_" + name);
  std::string own = base;
  const auto taken = [&](const std::string& candidate) {
    const auto other_kind = [&](const auto& others) {
      return static_cast<const void*>(&others) != static_cast<const void*>(&sets) && others.count(candidate) != 0;
    };
    const auto& all = bodies_.all();
    const bool of_body =
        std::any_of(all.begin(), all.end(), [&](const Body& one) { return one.element_set == candidate; });
    return of_body || other_kind(node_sets_) || other_kind(element_sets_) || other_kind(surfaces_);
  };
  for (int n = 2;; ++n) {
    const auto known = sets.find(own);
    if (!taken(own) && (known == sets.end() || same(known->second, set))) break;
    own = fmt::format("{}_{}", base, n);
  }
  sets[own] = std::move(set);
  return bodies_.all()[body].name + "." + own;
}

std::string WrittenMesh::node_set(int body, std::vector<int> nodes, const std::string& name) {
  return keep(node_sets_, body, std::move(nodes), name);
}

std::string WrittenMesh::element_set(int body, std::vector<int> elements, const std::string& name) {
  return keep(element_sets_, body, std::move(elements), name);
}

std::string WrittenMesh::surface(int body, std::vector<Face> faces, const std::string& name) {
  return keep(surfaces_, body, std::move(faces), name);
}

std::string WrittenMesh::text(const std::string& first_line) const {
  const Mesh& mesh = bodies_.mesh();
  const auto& nodes = deck_.mesh.node_numbers();
  const auto& elements = deck_.mesh.element_numbers();
  std::string text = "** " + first_line + "\n*NODE\n";
  auto out = std::back_inserter(text);
  for (std::size_t n = 0; n < mesh.nodes.size(); ++n) {
    const Vec3& x = deck_.mesh.nodes()[n];
    if (bodies_.of_node(static_cast<int>(n)) >= 0) fmt::format_to(out, "{}, {}, {}, {}\n", nodes[n], x[0], x[1], x[2]);
  }
  const auto numbers_of = [](const std::vector<int>& positions, const std::vector<std::int64_t>& numbers) {
    std::vector<std::int64_t> result;
    for (const int position : positions) result.push_back(numbers[position]);
    return result;
  };
  for (const Body& body : bodies_.all()) {
    fmt::format_to(out, "*ELEMENT, TYPE=C3D8, ELSET={}\n", body.element_set);
    for (const int e : body.elements) {
      fmt::format_to(out, "{}", elements[e]);
      for (const int n : mesh.elements[e]) fmt::format_to(out, ", {}", nodes[n]);
      text += '\n';
    }
  }
  for (const auto& [name, set] : element_sets_) {
    fmt::format_to(out, "*ELSET, ELSET={}\n", name);
    append_numbers(text, numbers_of(set, elements));
  }
  for (const auto& [name, set] : node_sets_) {
    fmt::format_to(out, "*NSET, NSET={}\n", name);
    append_numbers(text, numbers_of(set, nodes));
  }
  for (const auto& [name, faces] : surfaces_) {
    fmt::format_to(out, "*SURFACE, NAME={}\n", name);
    for (const Face& face : faces) fmt::format_to(out, "{}, S{}\n", elements[face.element], face.side + 1);
  }
  return text;
}

}  // namespace railwave::deck
