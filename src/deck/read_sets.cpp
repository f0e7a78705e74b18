#include <fmt/format.h>

#include "deck/deck_reader.hpp"
#include "mesh/files/text_file.hpp"

namespace railwave::deck {
namespace {

using Kind = DynaScope::Kind;
constexpr int numbers_of_card = 8;

struct SetKind {
  Kind members;
  std::map<Number, NumberSet> Deck::*sets;
  const char* called;
};

SetKind kind_of(const std::string& name) {
  if (name.rfind("SET_NODE", 0) == 0) return {Kind::node, &Deck::node_sets, "node set"};
  if (name.rfind("SET_PART", 0) == 0) return {Kind::part, &Deck::part_sets, "part set"};
  return {Kind::element, &Deck::solid_sets, "set of solids"};
}

template <class Set>
Set begin_set(Call& call, Number& number, const char* what) {
  Set set;
  set.title = call.titled ? call.cards.title() : "";
  const DynaCard card = call.cards.take();
  set.source = call.cards.source(card);
  number = call.number(card, 0, "SID", Kind::set);
  if (number < 1)
    call.reader.fail(card.place(), fmt::format("the {} has the number {}; numbers begin with 1", what, number));
  return set;
}

template <class Set>
void keep_set(Call& call, std::map<Number, Set>& sets, Number number, const Set& set, const char* what) {
  const auto [entry, is_new] = sets.emplace(number, set);
  if (!is_new)
    call.reader.fail(set.source.place, fmt::format("{} {} is defined again (first at {}); give each its own number",
                                                   what, number, call.reader.lines.where(entry->second.source.place)));
}

/// Members, eight a line, or one where the set is a column.
void read_list(Call& call) {
  const SetKind kind = kind_of(call.name);
  const int each = call.name.find("_COLUMN") != std::string::npos ? 1 : numbers_of_card;
  Number number = 0;
  auto set = begin_set<NumberSet>(call, number, kind.called);
  while (call.cards.more()) {
    const DynaCard card = call.cards.take();
    for (int i = 0; i < each && i < card.count(); ++i)
      if (const Number member = call.number(card, i, "member", kind.members); member > 0)
        set.ranges.push_back({member, member, 1});
  }
  keep_set(call, call.reader.deck.*kind.sets, number, set, kind.called);
}

void read_generated(Call& call) {
  const SetKind kind = kind_of(call.name);
  const bool stepped = call.name.find("INCREMENT") != std::string::npos;
  Number number = 0;
  auto set = begin_set<NumberSet>(call, number, kind.called);
  while (call.cards.more()) {
    const DynaCard card = call.cards.take();
    const int width = stepped ? 3 : 2;
    for (int i = 0; i + 1 < (stepped ? 3 : numbers_of_card); i += width) {
      const Number first = call.number(card, i, "first", kind.members),
                   last = call.number(card, i + 1, "last", kind.members);
      if (first == 0 && last == 0) continue;
      const Number step = stepped ? card.whole(2, "INCR") : 1;
      if (first < 1 || last < first || step < 1)
        call.reader.fail(card.place(),
                         fmt::format("a range {} to {} by {}; write the lower number first", first, last, step));
      set.ranges.push_back({first, last, step});
    }
  }
  keep_set(call, call.reader.deck.*kind.sets, number, set, kind.called);
}

/// Lines of an option and up to seven numbers.
void read_general_nodes(Call& call) {
  Number number = 0;
  auto set = begin_set<NumberSet>(call, number, "node set");
  while (call.cards.more()) {
    const DynaCard card = call.cards.take();
    const std::string option = lower_case(card.text(0));
    if (option == "all")
      set.all = true;
    else if (option != "node" && option != "part" && option != "box")
      call.reader.report.refuse(
          call.cards.source(card), "SET_NODE_GENERAL",
          fmt::format("option {} isn't read, only ALL, NODE, PART and BOX", for_message(card.text(0))));
    for (int i = 1; i < numbers_of_card; ++i) {
      if (option == "node") {
        const Number node = call.number(card, i, "node", Kind::node);
        if (node > 0) set.ranges.push_back({node, node, 1});
      } else if (option == "part") {
        const Number part = call.number(card, i, "part", Kind::part);
        if (part > 0) set.parts.push_back(part);
      } else if (option == "box") {
        const Number box = call.number(card, i, "box", Kind::define);
        if (box > 0) set.boxes.push_back(box);
      }
    }
  }
  keep_set(call, call.reader.deck.node_sets, number, set, "node set");
}

Segment segment_of(const Call& call, const DynaCard& card, int first) {
  Segment segment{};
  for (int i = 0; i < 4; ++i) segment[i] = call.number(card, first + i, "node", Kind::node);
  return segment;
}

void read_segments(Call& call) {
  Number number = 0;
  auto set = begin_set<SegmentSet>(call, number, "segment set");
  while (call.cards.more()) set.segments.push_back(segment_of(call, call.cards.take(), 0));
  keep_set(call, call.reader.deck.segment_sets, number, set, "segment set");
}

void read_general_segments(Call& call) {
  Number number = 0;
  auto set = begin_set<SegmentSet>(call, number, "segment set");
  while (call.cards.more()) {
    const DynaCard card = call.cards.take();
    const std::string option = lower_case(card.text(0));
    if (option == "seg") {
      set.segments.push_back(segment_of(call, card, 1));
    } else if (option == "part") {
      for (int i = 1; i < 5; ++i)
        if (const Number part = call.number(card, i, "part", Kind::part); part > 0) set.parts.push_back(part);
    } else {
      call.reader.report.refuse(call.cards.source(card), "SET_SEGMENT_GENERAL",
                                fmt::format("option {} isn't read, only SEG and PART", for_message(card.text(0))));
    }
  }
  keep_set(call, call.reader.deck.segment_sets, number, set, "segment set");
}

}  // namespace

const std::vector<HandlerEntry>& set_handlers() {
  static const std::vector<HandlerEntry> all = {{"SET_NODE", read_list},
                                                {"SET_NODE_LIST", read_list},
                                                {"SET_NODE_COLUMN", read_list},
                                                {"SET_NODE_LIST_GENERATE", read_generated},
                                                {"SET_NODE_LIST_GENERATE_INCREMENT", read_generated},
                                                {"SET_NODE_GENERAL", read_general_nodes},
                                                {"SET_PART", read_list},
                                                {"SET_PART_LIST", read_list},
                                                {"SET_PART_COLUMN", read_list},
                                                {"SET_PART_LIST_GENERATE", read_generated},
                                                {"SET_SOLID", read_list},
                                                {"SET_SOLID_GENERATE", read_generated},
                                                {"SET_SEGMENT", read_segments},
                                                {"SET_SEGMENT_GENERAL", read_general_segments}};
  return all;
}

}  // namespace railwave::deck
