#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "deck/deck_reader.hpp"

namespace railwave::deck {
namespace {

using Kind = DynaScope::Kind;

Number positive(const Call& call, const DynaCard& card, int field, const char* what, Kind kind) {
  const Number number = call.number(card, field, what, kind);
  if (number < 1 || number > largest_dyna_number)
    call.reader.fail(card.place(), fmt::format("field {} ({}) is {}; numbers run from 1 to {}", field + 1, what, number,
                                               largest_dyna_number));
  return number;
}

/// Directions of a code TC or RC: 1 x, 2 y, 3 z, 4 x and y, 5 y and z, 6 z and x, 7 all.
std::array<bool, 3> directions_of(Number code) {
  constexpr bool table[8][3] = {{false, false, false}, {true, false, false}, {false, true, false}, {false, false, true},
                                {true, true, false},   {false, true, true},  {true, false, true},  {true, true, true}};
  const auto& row = table[code];
  return {row[0], row[1], row[2]};
}

void read_nodes(Call& call) {
  Deck& deck = call.reader.deck;
  std::size_t count = 0;
  while (call.cards.more()) {
    const DynaCard card =
        call.cards.take({dyna_number, dyna_coordinate, dyna_coordinate, dyna_coordinate, dyna_code, dyna_code});
    const Number number = positive(call, card, 0, "NID", Kind::node);
    deck.mesh.add_node(number, {card.real(1, "X"), card.real(2, "Y"), card.real(3, "Z")}, card.place());
    deck.node_scopes.push_back(call.cards.keyword().scope);
    ++count;
    const Number held = card.whole(4, "TC"), turned = card.whole(5, "RC");
    if (held < 0 || held > 7 || turned < 0 || turned > 7)
      call.reader.fail(card.place(), "TC and RC are 0 to 7; mend them, see whether each field is in its columns");
    if (held == 0 && turned == 0) continue;
    if (call.reader.is_transformed(call.cards.keyword().scope))
      call.reader.report.refuse(call.cards.source(card), "INCLUDE_TRANSFORM.NODE",
                                "TC and RC of nodes that *INCLUDE_TRANSFORM moves aren't turned with them");
    Constraint constraint{call.cards.source(card), {number, false}, 0, {}};
    const auto along = directions_of(held), about = directions_of(turned);
    for (int i = 0; i < 3; ++i) {
      constraint.fixed[i] = along[i];
      constraint.fixed[3 + i] = about[i];
    }
    deck.constraints.push_back(constraint);
  }
  call.reader.report.add(Fate::taken, call.cards.source(), fmt::format("{} nodes", count));
}

const char* kind_of(const std::array<Number, 8>& nodes) {
  auto sorted = nodes;
  std::sort(sorted.begin(), sorted.end());
  const bool zero = sorted[0] == 0;
  const auto different = std::unique(sorted.begin(), sorted.end()) - sorted.begin() - (zero ? 1 : 0);
  if (different == 8) return nullptr;
  return different == 4   ? "tetrahedra"
         : different == 5 ? "pyramids"
         : different == 6 ? "wedges"
                          : "collapsed hexahedra";
}

constexpr DynaCard::Width solid_width = dyna_number;

void read_solids(Call& call) {
  DeckReader& reader = call.reader;
  std::size_t count = 0;
  while (call.cards.more()) {
    const DynaCard card = call.cards.take({solid_width, solid_width, solid_width, solid_width, solid_width, solid_width,
                                           solid_width, solid_width, solid_width, solid_width});
    const Number number = positive(call, card, 0, "EID", Kind::element);
    const Number part = positive(call, card, 1, "PID", Kind::part);
    std::array<Number, 8> nodes{};
    bool tetrahedron = false;
    if (card.count() <= 2) {
      // Two cards an element: numbers, then up to ten nodes.
      const DynaCard second = call.cards.take({solid_width, solid_width, solid_width, solid_width, solid_width,
                                               solid_width, solid_width, solid_width, solid_width, solid_width});
      for (int i = 0; i < 8; ++i) nodes[i] = call.number(second, i, "node", Kind::node);
      tetrahedron = second.whole(8, "N9") != 0 || second.whole(9, "N10") != 0;
    } else {
      for (int i = 0; i < 8; ++i) nodes[i] = call.number(card, 2 + i, "node", Kind::node);
    }
    const char* kind = tetrahedron ? "quadratic tetrahedra" : kind_of(nodes);
    ++count;
    if (kind != nullptr) {
      auto& [first, times] = reader.degenerate[kind];
      if (times++ == 0) first = call.cards.source(card);
      continue;
    }
    for (const Number node : nodes)
      if (node < 1) reader.fail(card.place(), fmt::format("element {} has a node {}; mend it", number, node));
    reader.deck.mesh.add_element(number, nodes, card.place());
    reader.deck.element_parts.push_back(part);
  }
  reader.report.add(Fate::taken, call.cards.source(), fmt::format("{} solids", count));
}

void read_beams(Call& call) {
  std::size_t count = 0;
  while (call.cards.more()) {
    const DynaCard card = call.cards.take({dyna_number, dyna_number, dyna_number, dyna_number, dyna_number, dyna_number,
                                           dyna_number, dyna_number, dyna_number, dyna_number});
    Beam beam;
    beam.source = call.cards.source(card);
    beam.number = positive(call, card, 0, "EID", Kind::element);
    beam.part = positive(call, card, 1, "PID", Kind::part);
    for (int i = 0; i < 3; ++i) beam.nodes[i] = call.number(card, 2 + i, "node", Kind::node);
    for (int i = 5; i < 9; ++i)
      if (card.whole(i, "release") != 0)
        call.reader.report.refuse(beam.source, "ELEMENT_BEAM.RELEASE", "beams here have no releases at their ends");
    call.reader.deck.beams.push_back(beam);
    ++count;
  }
  call.reader.report.add(Fate::taken, call.cards.source(), fmt::format("{} beams", count));
}

void read_discretes(Call& call) {
  std::size_t count = 0;
  while (call.cards.more()) {
    const DynaCard card = call.cards.take({dyna_number, dyna_number, dyna_number, dyna_number, dyna_number,
                                           dyna_coordinate, dyna_number, dyna_coordinate});
    Discrete one;
    one.source = call.cards.source(card);
    one.number = positive(call, card, 0, "EID", Kind::element);
    one.part = positive(call, card, 1, "PID", Kind::part);
    one.nodes = {positive(call, card, 2, "N1", Kind::node), call.number(card, 3, "N2", Kind::node)};
    one.orientation = call.number(card, 4, "VID", Kind::define);
    one.scale = card.real(5, "S", 1);
    one.offset = card.real(7, "OFFSET");
    call.reader.deck.discretes.push_back(one);
    ++count;
  }
  call.reader.report.add(Fate::taken, call.cards.source(), fmt::format("{} discrete elements", count));
}

void read_masses(Call& call) {
  std::size_t count = 0;
  while (call.cards.more()) {
    const DynaCard card = call.cards.take({dyna_number, dyna_number, dyna_coordinate, dyna_number});
    call.reader.deck.masses.push_back({call.cards.source(card), positive(call, card, 0, "EID", Kind::element),
                                       positive(call, card, 1, "NID", Kind::node), card.real(2, "MASS")});
    ++count;
  }
  call.reader.report.add(Fate::taken, call.cards.source(), fmt::format("{} point masses", count));
}

}  // namespace

const std::vector<HandlerEntry>& mesh_handlers() {
  static const std::vector<HandlerEntry> all = {{"NODE", read_nodes},
                                                {"ELEMENT_SOLID", read_solids},
                                                {"ELEMENT_BEAM", read_beams},
                                                {"ELEMENT_DISCRETE", read_discretes},
                                                {"ELEMENT_MASS", read_masses}};
  return all;
}

}  // namespace railwave::deck
