#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "deck/deck_reader.hpp"
#include "mesh/vectors.hpp"

// A rigid wall becomes one hexahedron, all of whose nodes are held, with a face in the wall's plane: the master of a
// contact, which is as rigid as the wall.
namespace railwave::deck {
namespace {

constexpr double reach = 2;     // edge of the face, over the diagonal of all that may come
constexpr double depth = 0.25;  // of the hexahedron, over that edge

template <class Things>
Number next_number(const Things& things) {
  return things.empty() ? 1 : things.rbegin()->first + 1;
}

Number next_number(const std::vector<std::int64_t>& numbers) {
  return numbers.empty() ? 1 : *std::max_element(numbers.begin(), numbers.end()) + 1;
}

/// Middle and diagonal of the box around all nodes.
void bounds_of(const Deck& deck, Vec3& middle, double& diagonal) {
  Vec3 low = deck.mesh.nodes().front(), high = low;
  for (const Vec3& x : deck.mesh.nodes())
    for (int i = 0; i < 3; ++i) {
      low[i] = std::fmin(low[i], x[i]);
      high[i] = std::fmax(high[i], x[i]);
    }
  for (int i = 0; i < 3; ++i) middle[i] = 0.5 * low[i] + 0.5 * high[i];
  diagonal = length(difference(high, low));
}

/// The hexahedron's corners: the first four below the plane, the others in it.
std::array<Vec3, 8> corners_of_wall(const Wall& wall, const Vec3& normal, const Vec3& middle, double diagonal) {
  int least = 0;
  for (int i = 1; i < 3; ++i)
    if (std::fabs(normal[i]) < std::fabs(normal[least])) least = i;
  Vec3 other{0, 0, 0};
  other[least] = 1;
  Vec3 u = cross(other, normal);
  u = scaled(1 / length(u), u);
  const Vec3 v = cross(normal, u);
  const double off = dot(difference(middle, wall.tail), normal), edge = reach * diagonal;
  constexpr double side[4][2] = {{-0.5, -0.5}, {0.5, -0.5}, {0.5, 0.5}, {-0.5, 0.5}};
  std::array<Vec3, 8> corners{};
  for (int k = 0; k < 8; ++k)
    for (int i = 0; i < 3; ++i)
      corners[k][i] = middle[i] - off * normal[i] + edge * (side[k % 4][0] * u[i] + side[k % 4][1] * v[i]) -
                      (k < 4 ? depth * edge * normal[i] : 0);
  return corners;
}

void make_wall(const Wall& wall, Number count, const Vec3& middle, double diagonal, const std::vector<Range>& parts,
               Deck& deck, Report& report) {
  Vec3 normal = difference(wall.head, wall.tail);
  if (!(length(normal) > 0) || !(diagonal > 0))
    return report.refuse_always(wall.source, "the wall's plane has no normal: its tail and head are one point");
  normal = scaled(1 / length(normal), normal);
  Segment face{};
  std::array<Number, 8> nodes{};
  const Number first = next_number(deck.mesh.node_numbers());
  const auto corners = corners_of_wall(wall, normal, middle, diagonal);
  for (int k = 0; k < 8; ++k) {
    nodes[k] = first + k;
    deck.mesh.add_node(nodes[k], corners[k], wall.source.place);
    deck.node_scopes.push_back(0);
    if (k >= 4) face[k - 4] = nodes[k];
    deck.constraints.push_back({wall.source, {nodes[k], false}, 0, {true, true, true, false, false, false}});
  }
  const Number part = next_number(deck.parts);
  deck.mesh.add_element(next_number(deck.mesh.element_numbers()), nodes, wall.source.place);
  Part body = deck.parts.at(deck.element_parts.front());
  deck.element_parts.push_back(part);
  body.source = wall.source;
  body.title = fmt::format("rigid wall {}", count);
  deck.parts[part] = body;
  const Number segments = next_number(deck.segment_sets);
  deck.segment_sets[segments] = {wall.source, body.title, {face}, {}};
  Contact contact;
  contact.source = wall.source;
  contact.title = body.title + " contact";
  contact.kind = Contact::Kind::nodes;
  contact.friction = wall.friction;
  contact.master = {segments, 0};
  contact.slave = {wall.set, 4};
  if (wall.set == 0) {
    const Number all = next_number(deck.part_sets);
    deck.part_sets[all] = {wall.source, "all parts", parts, {}, false, {}};
    contact.slave = {all, 2};
  }
  deck.contacts.push_back(contact);
  report.add(Fate::replaced, wall.source,
             fmt::format("the wall is a hexahedron, [parts.rigid_wall_{}], with all nodes held", count));
}

}  // namespace

void make_walls(Deck& deck, Report& report) {
  deck.own_nodes = deck.mesh.node_count();
  deck.own_elements = deck.mesh.element_count();
  if (deck.walls.empty() || deck.element_parts.empty() || deck.parts.count(deck.element_parts.front()) == 0) return;
  std::set<Number> with_elements(deck.element_parts.begin(), deck.element_parts.end());
  std::vector<Range> parts;
  for (const Number part : with_elements) parts.push_back({part, part, 1});
  Vec3 middle{0, 0, 0};
  double diagonal = 0;
  bounds_of(deck, middle, diagonal);
  Number count = 0;
  for (const Wall& wall : deck.walls) make_wall(wall, ++count, middle, diagonal, parts, deck, report);
}

}  // namespace railwave::deck
