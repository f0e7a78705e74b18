#include <fmt/format.h>

#include <cmath>

#include "deck/deck_reader.hpp"

namespace railwave::deck {
namespace {

using Kind = DynaScope::Kind;

/// The target of a keyword ..._NODE or ..._SET.
Nodes nodes_of(const Call& call, const DynaCard& card, int field) {
  const bool set = call.name.find("_SET") != std::string::npos;
  return {call.number(card, field, set ? "NSID" : "NID", set ? Kind::set : Kind::node), set};
}

void read_spc(Call& call) {
  while (call.more()) {
    if (call.titled) call.cards.title();
    const DynaCard card = call.cards.take();
    Constraint constraint;
    constraint.source = call.cards.source(card);
    constraint.nodes = nodes_of(call, card, 0);
    constraint.axes = call.number(card, 1, "CID", Kind::define);
    for (int i = 0; i < 6; ++i) constraint.fixed[i] = card.whole(2 + i, "DOF") != 0;
    call.reader.deck.constraints.push_back(constraint);
  }
}

/// Whether a birth or death time lies within any run: 0 and 1e20 or so are none.
void refuse_times(Call& call, const Source& source, double birth, double death) {
  constexpr double never = 1e15;
  if (birth > 0 && birth < never)
    call.reader.report.refuse(source, source.keyword + ".BIRTH",
                              "a birth time isn't read: it would act from the start");
  if (death > 0 && death < never)
    call.reader.report.refuse(source, source.keyword + ".DEATH", "a death time isn't read: it would act to the end");
}

void read_motion(Call& call) {
  while (call.more()) {
    if (call.titled) call.cards.title();
    const DynaCard card = call.cards.take();
    Motion motion;
    motion.source = call.cards.source(card);
    motion.nodes = nodes_of(call, card, 0);
    motion.direction = card.whole(1, "DOF");
    motion.kind = card.whole(2, "VAD");
    motion.curve = call.number(card, 3, "LCID", Kind::curve);
    motion.scale = card.real(4, "SF", 1);
    motion.vector = call.number(card, 5, "VID", Kind::define);
    refuse_times(call, motion.source, card.real(7, "BIRTH"), card.real(6, "DEATH"));
    if (std::abs(motion.direction) >= 9 && std::abs(motion.direction) <= 11 && call.cards.left()) call.cards.take();
    call.reader.deck.motions.push_back(motion);
  }
}

void read_non_reflecting(Call& call) {
  while (call.cards.more()) {
    const DynaCard card = call.cards.take();
    call.reader.deck.non_reflecting.push_back({call.cards.source(card), call.number(card, 0, "SSID", Kind::set)});
    if (card.real(1, "AD") != 0 || card.real(2, "AS") != 0)
      call.reader.report.add(Fate::replaced, call.cards.source(card), "AD and AS: waves of both kinds leave");
  }
}

void read_wall(Call& call) {
  while (call.cards.any()) {
    if (call.titled) call.cards.title();
    const DynaCard card = call.cards.take(), plane = call.cards.take();
    Wall wall;
    wall.source = call.cards.source(card);
    wall.set = call.number(card, 0, "NSID", Kind::set);
    if (card.whole(1, "NSIDEX") != 0 || card.whole(2, "BOXID") != 0)
      call.reader.report.refuse(wall.source, "RIGIDWALL_PLANAR.NSIDEX",
                                "exempted nodes (NSIDEX) and boxes (BOXID) aren't read; name the nodes by NSID");
    refuse_times(call, wall.source, card.real(4, "BIRTH"), card.real(5, "DEATH"));
    wall.tail = {plane.real(0, "XT"), plane.real(1, "YT"), plane.real(2, "ZT")};
    wall.head = {plane.real(3, "XH"), plane.real(4, "YH"), plane.real(5, "ZH")};
    wall.friction = plane.real(6, "FRIC");
    if (wall.friction >= 1 || wall.friction < 0)
      call.reader.report.refuse_always(
          wall.source, "FRIC is read as a coefficient from 0 to below 1; nodes here aren't welded to walls");
    call.reader.deck.walls.push_back(wall);
  }
}

Vec3 vector_of(const DynaCard& card, int first) {
  return {card.real(first, "VX"), card.real(first + 1, "VY"), card.real(first + 2, "VZ")};
}

void refuse_rotations(Call& call, const DynaCard& card, int first) {
  bool turns = false;
  for (int i = 0; i < 3; ++i) turns = turns || card.real(first + i, "rotation") != 0;
  if (turns)
    call.reader.report.refuse(call.cards.source(card), call.name + ".VXR",
                              "rotations of nodes at the start aren't read, for those of hexahedra have none");
}

void read_initial_velocity(Call& call) {
  const DynaCard card = call.cards.take(), second = call.cards.take();
  InitialVelocity initial;
  initial.source = call.cards.source(card);
  initial.number = call.number(card, 0, "NSID", Kind::set);
  initial.of = initial.number == 0 ? InitialVelocity::Of::all : InitialVelocity::Of::node_set;
  initial.velocity = vector_of(second, 0);
  refuse_rotations(call, second, 3);
  if (card.whole(1, "NSIDEX") != 0)
    call.reader.report.refuse(initial.source, "INITIAL_VELOCITY.NSIDEX", "exempted nodes (NSIDEX) aren't read");
  if (card.whole(2, "BOXID") != 0)
    call.reader.report.refuse(initial.source, "INITIAL_VELOCITY.BOXID", "velocities of a box aren't read; name nodes");
  initial.axes = call.number(card, 4, "ICID", Kind::define);
  call.reader.deck.velocities.push_back(initial);
}

void read_node_velocity(Call& call) {
  while (call.cards.more()) {
    const DynaCard card = call.cards.take();
    InitialVelocity initial;
    initial.source = call.cards.source(card);
    initial.of = InitialVelocity::Of::node;
    initial.number = call.number(card, 0, "NID", Kind::node);
    initial.velocity = vector_of(card, 1);
    refuse_rotations(call, card, 4);
    if (card.whole(7, "ICID") != 0)
      call.reader.report.refuse(initial.source, "INITIAL_VELOCITY_NODE.ICID", "velocities in other axes aren't read");
    call.reader.deck.velocities.push_back(initial);
  }
}

void read_generated_velocity(Call& call) {
  while (call.cards.more()) {
    const DynaCard card = call.cards.take(), second = call.cards.take();
    InitialVelocity initial;
    initial.source = call.cards.source(card);
    const Number type = card.whole(1, "STYP");
    const bool part = type == 2;
    initial.number = call.number(card, 0, "ID", part ? Kind::part : Kind::set);
    using Of = InitialVelocity::Of;
    initial.of = initial.number == 0 ? Of::all : type == 1 ? Of::part_set : part ? Of::part : Of::node_set;
    if (type < 1 || type > 3)
      call.reader.fail(card.place(), fmt::format("STYP is {}, must be 1, 2 or 3; mend it", type));
    initial.turning = card.real(2, "OMEGA");
    initial.velocity = vector_of(card, 3);
    initial.centre = vector_of(second, 0);
    initial.axis = vector_of(second, 3);
    if (second.real(3, "NX") == -999)
      call.reader.report.refuse(initial.source, call.name + ".NX", "an axis through two nodes (NX -999) isn't read");
    if (second.whole(6, "PHASE") != 0)
      call.reader.report.refuse(initial.source, call.name + ".PHASE",
                                "velocities after dynamic relaxation aren't read");
    initial.axes = call.number(card, 7, "ICID", Kind::define);
    if (initial.axes != 0 && initial.turning != 0)
      call.reader.report.refuse(initial.source, call.name + ".ICID", "a rotation in other axes (ICID) isn't read");
    call.reader.deck.velocities.push_back(initial);
  }
}

void read_global_damping(Call& call) {
  const DynaCard card = call.cards.take();
  Damping damping;
  damping.source = call.cards.source(card);
  damping.curve = call.number(card, 0, "LCID", Kind::curve);
  // A curve stands in place of VALDMP.
  damping.value = damping.curve != 0 ? 1 : card.real(1, "VALDMP");
  // All zero: in all directions.
  bool some = false, all = true;
  for (int i = 2; i < 8; ++i) {
    const double factor = card.real(i, "STX to SRZ");
    some = some || factor != 0;
    all = all && (factor == 1 || i > 4);
  }
  if (some && !all)
    call.reader.report.refuse(damping.source, "DAMPING_GLOBAL.STX", "damping here acts in all directions alike");
  call.reader.deck.dampings.push_back(damping);
}

void read_part_damping(Call& call) {
  const bool set = call.name.find("_SET") != std::string::npos;
  const bool by_mass = call.name.find("MASS") != std::string::npos;
  while (call.cards.more()) {
    const DynaCard card = call.cards.take();
    Damping damping;
    damping.source = call.cards.source(card);
    damping.by_mass = by_mass;
    damping.is_set = set;
    damping.part = call.number(card, 0, set ? "PSID" : "PID", set ? Kind::set : Kind::part);
    if (by_mass) {
      damping.curve = call.number(card, 1, "LCID", Kind::curve);
      damping.value = card.real(2, "SF", 1);
      if (card.whole(3, "FLAG") == 1) {
        call.cards.take();
        call.reader.report.refuse(damping.source, call.name + ".FLAG", "damping here acts in all directions alike");
      }
    } else {
      damping.value = card.real(1, "COEF");
    }
    call.reader.deck.dampings.push_back(damping);
  }
}

}  // namespace

const std::vector<HandlerEntry>& action_handlers() {
  static const std::vector<HandlerEntry> all = {{"BOUNDARY_SPC_NODE", read_spc},
                                                {"BOUNDARY_SPC_SET", read_spc},
                                                {"BOUNDARY_PRESCRIBED_MOTION_NODE", read_motion},
                                                {"BOUNDARY_PRESCRIBED_MOTION_SET", read_motion},
                                                {"BOUNDARY_NON_REFLECTING", read_non_reflecting},
                                                {"RIGIDWALL_PLANAR", read_wall},
                                                {"INITIAL_VELOCITY", read_initial_velocity},
                                                {"INITIAL_VELOCITY_NODE", read_node_velocity},
                                                {"INITIAL_VELOCITY_GENERATION", read_generated_velocity},
                                                {"DAMPING_GLOBAL", read_global_damping},
                                                {"DAMPING_PART_MASS", read_part_damping},
                                                {"DAMPING_PART_MASS_SET", read_part_damping},
                                                {"DAMPING_PART_STIFFNESS", read_part_damping},
                                                {"DAMPING_PART_STIFFNESS_SET", read_part_damping}};
  return all;
}

}  // namespace railwave::deck
