#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "deck/deck_reader.hpp"

namespace railwave::deck {
namespace {

using Kind = DynaScope::Kind;

void read_title(Call& call) {
  call.reader.deck.title = call.cards.title();
  call.reader.report.add(Fate::taken, call.cards.source(), "title of the case");
}

void read_keyword(Call& call) {
  call.reader.report.add(Fate::taken, call.cards.source(), "where the deck begins, and its format");
}

void read_termination(Call& call) {
  const DynaCard card = call.cards.take();
  Control& control = call.reader.deck.control;
  control.end = card.real(0, "ENDTIM");
  control.end_source = call.cards.source(card);
  for (const auto& [field, name] :
       {std::pair<int, const char*>{1, "ENDCYC"}, {2, "DTMIN"}, {3, "ENDENG"}, {4, "ENDMAS"}})
    if (card.real(field, name) != 0 && std::fabs(card.real(field, name)) < 1e7)
      call.reader.report.add(Fate::dropped, control.end_source, fmt::format("{}: the run ends at ENDTIM", name));
}

void read_timestep(Call& call) {
  const DynaCard card = call.cards.take();
  const Source source = call.cards.source(card);
  call.reader.deck.control.step_scale = card.real(1, "TSSFAC");
  call.reader.report.add(Fate::taken, source, "TSSFAC: time.step_scale");
  if (card.real(4, "DT2MS") != 0)
    call.reader.report.add(Fate::dropped, source,
                           "DT2MS: no mass is added, and steps are as short as the elements need: results are those "
                           "without mass scaling");
  if (card.whole(5, "LCTM") != 0)
    call.reader.report.add(Fate::dropped, source, "LCTM: the step is as long as is stable");
}

void read_hourglass_control(Call& call) {
  const DynaCard card = call.cards.take();
  call.reader.deck.control.hourglass_type = card.whole(0, "IHQ");
  call.reader.deck.control.hourglass_coefficient = card.real(1, "QH");
  call.reader.report.add(Fate::taken, call.cards.source(card), "of parts without a *HOURGLASS of their own");
}

void read_bulk_viscosity(Call& call) {
  const DynaCard card = call.cards.take();
  call.reader.deck.control.quadratic_viscosity = card.real(0, "Q1");
  call.reader.deck.control.linear_viscosity = card.real(1, "Q2");
  call.reader.report.add(Fate::taken, call.cards.source(card), "of parts without a *HOURGLASS of their own");
}

void read_implicit(Call& call) {
  const DynaCard card = call.cards.take();
  const Source source = call.cards.source(card);
  if (card.whole(0, "IMFLAG") != 0)
    call.reader.report.refuse(source, call.name,
                              "the deck is solved implicitly, and Railwave explicitly: take IMFLAG 0 "
                              "and an end time of a few milliseconds; for static loads before a run "
                              "add [settle] to the case");
  else
    call.reader.report.add(Fate::dropped, source, "IMFLAG is 0: it has no effect");
}

void read_solution(Call& call) {
  if (!call.cards.more()) return;
  const DynaCard card = call.cards.take();
  if (card.whole(0, "SOLN") != 0)
    call.reader.report.refuse(call.cards.source(card), call.name, "there is no heat here: only SOLN 0 is read");
  else
    call.reader.report.add(Fate::dropped, call.cards.source(card), "SOLN is 0: it has no effect");
}

void read_relaxation(Call& call) {
  if (!call.cards.more()) return;
  const DynaCard card = call.cards.take();
  if (card.whole(6, "IDRFLG") > 0)
    call.reader.report.refuse(call.cards.source(card), call.name,
                              "dynamic relaxation isn't read; leave it out and add [settle] to the case, where the "
                              "scene is to come to rest first");
  else
    call.reader.report.add(Fate::dropped, call.cards.source(card), "IDRFLG is 0: it has no effect");
}

void read_field_output(Call& call) {
  if (!call.cards.more()) return;
  const DynaCard card = call.cards.take();
  call.reader.deck.control.field_interval = card.real(0, "DT");
  call.reader.report.add(Fate::taken, call.cards.source(card), "output.field_interval");
}

void read_history_output(Call& call) {
  if (!call.cards.more()) return;
  const DynaCard card = call.cards.take();
  const double interval = card.real(0, "DT");
  double& all = call.reader.deck.control.history_interval;
  if (interval > 0) all = all > 0 ? std::fmin(all, interval) : interval;
  call.reader.report.add(Fate::replaced, call.cards.source(card),
                         "output.history_interval, the shortest of all: forces, energies and histories are in the "
                         "results file");
}

template <std::vector<std::pair<Source, Number>> Deck::*list, Kind kind>
void read_history_of(Call& call) {
  while (call.cards.more()) {
    const DynaCard card = call.titled ? call.cards.take({{10, 10}, {70, 70}}) : call.cards.take();
    for (int i = 0; i < (call.titled ? 1 : 8); ++i)
      if (const Number number = call.number(card, i, "ID", kind); number > 0)
        (call.reader.deck.*list).emplace_back(call.cards.source(card), number);
  }
}

}  // namespace

const std::vector<HandlerEntry>& control_handlers() {
  static const std::vector<HandlerEntry> all = {
      {"TITLE", read_title},
      {"KEYWORD", read_keyword},
      {"CONTROL_TERMINATION", read_termination},
      {"CONTROL_TIMESTEP", read_timestep},
      {"CONTROL_HOURGLASS", read_hourglass_control},
      {"CONTROL_BULK_VISCOSITY", read_bulk_viscosity},
      {"CONTROL_IMPLICIT_GENERAL", read_implicit},
      {"CONTROL_SOLUTION", read_solution},
      {"CONTROL_DYNAMIC_RELAXATION", read_relaxation},
      {"DATABASE_BINARY_D3PLOT", read_field_output},
      {"DATABASE_GLSTAT", read_history_output},
      {"DATABASE_MATSUM", read_history_output},
      {"DATABASE_RCFORC", read_history_output},
      {"DATABASE_NODOUT", read_history_output},
      {"DATABASE_ELOUT", read_history_output},
      {"DATABASE_DEFORC", read_history_output},
      {"DATABASE_HISTORY_NODE", read_history_of<&Deck::history_nodes, Kind::node>},
      {"DATABASE_HISTORY_NODE_SET", read_history_of<&Deck::history_node_sets, Kind::set>},
      {"DATABASE_HISTORY_SOLID", read_history_of<&Deck::history_solids, Kind::element>}};
  return all;
}

bool is_harmless(const std::string& name, std::string& why) {
  struct Row {
    const char* beginning;
    const char* why;
  };
  static const Row rows[] = {
      {"COMMENT", "a remark"},
      {"CONTACT_FORCE_TRANSDUCER", "it only measures: forces of each contact are in the results"},
      {"DATABASE_", "what is written is as [output] of the case has it"},
      {"CONTROL_ENERGY", "all energies are always accounted for"},
      {"CONTROL_OUTPUT", "it concerns LS-DYNA's own files"},
      {"CONTROL_ACCURACY", "it concerns how LS-DYNA computes"},
      {"CONTROL_CPU", "it concerns LS-DYNA's own run"},
      {"CONTROL_MPP", "it concerns LS-DYNA's own run"},
      {"CONTROL_PARALLEL", "it concerns LS-DYNA's own run"},
      {"CONTROL_SOLID", "it concerns how LS-DYNA computes solids"},
      {"CONTROL_SHELL", "there are no shells"},
      {"CONTROL_CONTACT", "defaults of contacts by penalty: these have their own settings here"},
      {"CONTROL_IMPLICIT_", "without IMFLAG of *CONTROL_IMPLICIT_GENERAL it has no effect"},
      {"CONTROL_THERMAL_", "without SOLN of *CONTROL_SOLUTION it has no effect"},
      {"CONTROL_ALE", "there are no fluids"},
      {"CONTROL_SPH", "there are no particles"},
      {"CONTROL_RIGID", "there are no rigid bodies"},
      {"CONTROL_STRUCTURED", "it concerns LS-DYNA's own files"},
      {"CONTROL_SUBCYCLE", "see solver.subcycling"},
      {"PARAMETER_DUPLICATION", "the first definition of a parameter holds"},
      {"PARAMETER_TYPE", "it concerns other programs"},
      {"DEFINE_CURVE_", "used by nothing that is taken"},
      {"DEFINE_FUNCTION", "used by nothing that is taken"},
      {"DEFINE_TABLE", "used by nothing that is taken"},
      {"DEFINE_BOX_", "used by nothing that is taken"},
      {"DEFINE_COORDINATE", "used by nothing that is taken"},
      {"DEFINE_FRICTION", "used by nothing that is taken"},
      {"SET_", "used by nothing that is taken"},
      {"EOS_", "used by nothing that is taken"},
      {"MAT_ADD_THERMAL", "there is no heat"},
      {"MAT_THERMAL", "there is no heat"},
      {"KEYWORD_ID", "a remark"},
      {"VERSION", "a remark"}};
  // These add to a set that is taken.
  if (name.find("_COLLECT") != std::string::npos) return false;
  for (const Row& row : rows)
    if (name.rfind(row.beginning, 0) == 0) {
      why = row.why;
      return true;
    }
  return false;
}

}  // namespace railwave::deck
