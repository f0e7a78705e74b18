#include <fmt/format.h>

#include <algorithm>

#include "deck/deck_reader.hpp"

namespace railwave::deck {
namespace {

using Kind = DynaScope::Kind;

void read_nodal(Call& call) {
  const bool set = call.name == "LOAD_NODE_SET";
  while (call.cards.more()) {
    const DynaCard card = call.cards.take();
    NodalLoad load;
    load.source = call.cards.source(card);
    load.nodes = {call.number(card, 0, "NODE or NSID", set ? Kind::set : Kind::node), set};
    load.direction = card.whole(1, "DOF");
    load.curve = call.number(card, 2, "LCID", Kind::curve);
    load.scale = card.real(3, "SF", 1);
    load.axes = call.number(card, 4, "CID", Kind::define);
    call.reader.deck.nodal_loads.push_back(load);
  }
}

void read_pressure(Call& call) {
  while (call.more()) {
    if (call.titled) call.cards.title();
    const DynaCard card = call.cards.take();
    Pressure pressure;
    pressure.source = call.cards.source(card);
    const int first = call.name == "LOAD_SEGMENT_SET" ? 1 : 0;
    if (first == 1) {
      pressure.set = call.number(card, 0, "SSID", Kind::set);
    } else {
      Segment segment{};
      for (int i = 0; i < 4; ++i) segment[i] = call.number(card, 3 + i, "node", Kind::node);
      pressure.segments.push_back(segment);
      if (card.whole(7, "N5") != 0)
        call.reader.report.refuse(pressure.source, "LOAD_SEGMENT.N5", "segments of more than four nodes aren't read");
    }
    pressure.curve = call.number(card, first, "LCID", Kind::curve);
    pressure.scale = card.real(first + 1, "SF", 1);
    if (card.real(first + 2, "AT") != 0)
      call.reader.report.refuse(pressure.source, call.name + ".AT",
                                "an arrival time (AT) isn't read; begin the curve with zeros up to then");
    call.reader.deck.pressures.push_back(pressure);
  }
}

void read_body_load(Call& call) {
  if (!call.cards.more()) return;
  const DynaCard card = call.cards.take();
  BodyLoad load;
  load.source = call.cards.source(card);
  load.direction = call.name.back() - 'X';
  load.curve = call.number(card, 0, "LCID", Kind::curve);
  load.scale = card.real(1, "SF", 1);
  if (card.whole(6, "CID") != 0)
    call.reader.report.refuse(load.source, call.name + ".CID", "body loads in other axes (CID) aren't read");
  call.reader.deck.body_loads.push_back(load);
}

}  // namespace

const std::vector<HandlerEntry>& load_handlers() {
  static const std::vector<HandlerEntry> all = {{"LOAD_NODE_POINT", read_nodal},     {"LOAD_NODE_SET", read_nodal},
                                                {"LOAD_NODE", read_nodal},           {"LOAD_SEGMENT", read_pressure},
                                                {"LOAD_SEGMENT_SET", read_pressure}, {"LOAD_BODY_X", read_body_load},
                                                {"LOAD_BODY_Y", read_body_load},     {"LOAD_BODY_Z", read_body_load}};
  return all;
}

void read_contact(Call& call) {
  Contact contact;
  contact.source = call.cards.source();
  std::string type = call.name.substr(std::string("CONTACT_").size());
  const auto strip = [&](const std::string& word) {
    const auto at = type.find(word);
    if (at == std::string::npos) return false;
    type.erase(at, word.size());
    return true;
  };
  const bool mpp = strip("_MPP");
  if (call.titled || strip("_ID") || strip("_TITLE")) {
    const DynaCard head = call.cards.take({{10, 10}, {70, 70}});
    contact.number = head.whole(0, "CID");
    contact.title = std::string(head.text(1));
  }
  if (mpp) {
    call.cards.take();
    if (call.cards.next_begins_with('&')) call.cards.take();
  }
  using Type = Contact::Kind;
  static const std::map<std::string, Type> known = {{"SURFACE_TO_SURFACE", Type::surfaces},
                                                    {"AUTOMATIC_SURFACE_TO_SURFACE", Type::surfaces},
                                                    {"ONE_WAY_SURFACE_TO_SURFACE", Type::surfaces},
                                                    {"AUTOMATIC_ONE_WAY_SURFACE_TO_SURFACE", Type::surfaces},
                                                    {"NODES_TO_SURFACE", Type::nodes},
                                                    {"AUTOMATIC_NODES_TO_SURFACE", Type::nodes},
                                                    {"TIED_SURFACE_TO_SURFACE", Type::tied},
                                                    {"TIED_NODES_TO_SURFACE", Type::tied},
                                                    {"TIED_SURFACE_TO_SURFACE_OFFSET", Type::tied},
                                                    {"TIED_NODES_TO_SURFACE_OFFSET", Type::tied},
                                                    {"AUTOMATIC_SINGLE_SURFACE", Type::single},
                                                    {"AUTOMATIC_GENERAL", Type::single},
                                                    {"SINGLE_SURFACE", Type::single}};
  const auto found = known.find(type);
  if (found == known.end()) {
    call.reader.report.refuse(contact.source, call.name,
                              "contacts of this kind aren't read; take AUTOMATIC_SURFACE_TO_SURFACE, "
                              "AUTOMATIC_NODES_TO_SURFACE or TIED_SURFACE_TO_SURFACE");
    return;
  }
  contact.kind = found->second;
  const DynaCard sides = call.cards.take(), friction = call.cards.take();
  contact.slave = {sides.whole(0, "SSID"), sides.whole(2, "SSTYP")};
  contact.master = {sides.whole(1, "MSID"), sides.whole(3, "MSTYP")};
  for (Side* side : {&contact.slave, &contact.master})
    side->number = call.reader.offset(side->number, side->type == 3 ? Kind::part : Kind::set, call.cards.keyword());
  if (sides.whole(4, "SBOXID") != 0 || sides.whole(5, "MBOXID") != 0)
    call.reader.report.refuse(contact.source, "CONTACT.SBOXID", "contacts within a box aren't read; name segments");
  contact.friction = friction.real(0, "FS");
  contact.dynamic_friction = friction.real(1, "FD");
  contact.decay = friction.real(2, "DC");
  contact.damping = friction.real(4, "VDC");
  if (friction.real(3, "VC") != 0)
    call.reader.report.refuse(contact.source, "CONTACT.VC", "a limit of the friction stress (VC) isn't read");
  constexpr double never = 1e15;
  const double birth = friction.real(6, "BT"), death = friction.real(7, "DT");
  if (birth > 0) call.reader.report.refuse(contact.source, "CONTACT.BT", "a birth time (BT) isn't read");
  if (death > 0 && death < never)
    call.reader.report.refuse(contact.source, "CONTACT.DT", "a death time (DT) isn't read");
  if (call.cards.left()) {
    const DynaCard scales = call.cards.take();
    contact.penalty_scale = scales.real(0, "SFS", 1);
    for (const int field : {2, 3})
      if (scales.real(field, "SST or MST") != 0)
        call.reader.report.refuse(contact.source, "CONTACT.SST",
                                  "a thickness of contact (SST, MST) isn't read: solids "
                                  "touch where their faces do");
  }
  // Optional cards A and B: of them the thickness of solids alone is more than how LS-DYNA computes.
  if (call.cards.left()) call.cards.take();
  if (call.cards.left() && call.cards.take().real(6, "SLDTHK") > 0)
    call.reader.report.refuse(contact.source, "CONTACT.SLDTHK",
                              "a thickness of solids (SLDTHK) isn't read: they touch where their faces do");
  call.reader.deck.contacts.push_back(contact);
}

}  // namespace railwave::deck
