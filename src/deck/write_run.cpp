#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "deck/conversion.hpp"

namespace railwave::deck {

void write_run(Conversion& conversion) {
  const Deck& deck = conversion.deck;
  const double second = conversion.units.time;
  CaseText& text = conversion.text;
  text.section("time");
  text.key("end", *deck.control.end * second);
  conversion.report.add(Fate::taken, deck.control.end_source, "time.end");
  if (deck.control.step_scale > 0) text.key("step_scale", std::fmin(deck.control.step_scale, 1));
  std::vector<std::string> histories;
  const auto add = [&](const std::string& name) {
    if (std::find(histories.begin(), histories.end(), name) == histories.end()) histories.push_back(name);
  };
  const auto add_nodes = [&](const Nodes& nodes, const Source& source) {
    const Target target = conversion.target(conversion.members(nodes, source));
    for (const auto& [body, of_body] : target.of_body)
      add(conversion.mesh.node_set(body, of_body, conversion.name_of(nodes)));
    for (const int n : target.points)
      if (!conversion.points.at(n).ground) add(conversion.points.at(n).name);
    conversion.report.add(Fate::taken, source,
                          nodes.is_set ? "output.history_sets: the mean of the set" : "output.history_sets");
  };
  for (const auto& [source, number] : deck.history_nodes) add_nodes({number, false}, source);
  for (const auto& [source, number] : deck.history_node_sets) add_nodes({number, true}, source);
  for (const auto& [source, number] : deck.history_solids) {
    const auto element = deck.mesh.find_element(number);
    if (!element) conversion.fail(source, fmt::format("there is no solid {}; mend the number", number));
    add(conversion.mesh.element_set(conversion.bodies.of_element(*element), {*element},
                                    fmt::format("solid_{}", number)));
    conversion.report.add(Fate::taken, source, "output.history_sets");
  }
  std::vector<std::string> bodies, fields{"displacement", "velocity", "stress", "mises"};
  for (const Body& body : conversion.bodies.all()) bodies.push_back(body.name);
  if (!conversion.plastic.empty()) fields.push_back("plastic_strain");
  text.section("output");
  text.key("field_sets", toml(bodies));
  text.key("fields", toml(fields));
  if (deck.control.field_interval > 0) text.key("field_interval", deck.control.field_interval * second);
  if (deck.control.history_interval > 0) text.key("history_interval", deck.control.history_interval * second);
  if (!histories.empty()) text.key("history_sets", toml(histories));
}

}  // namespace railwave::deck
