#include <algorithm>
#include <cmath>

#include "report/page.hpp"

namespace railwave::page {
namespace {

using Members = std::vector<std::pair<std::string, std::string>>;

std::string texts(const hdf5::Group& root, const char* name) {
  std::vector<std::string> items;
  if (root.has_attribute(name))
    for (const std::string& text : root.texts_attribute(name)) items.push_back(json_text(text));
  return json_list(items);
}

/// Samples of an energy, J; none where the run did not write it.
const std::vector<double>* energy(const HistoryTable& history, const char* name) {
  for (const SampledChannel& one : history.channels)
    if (one.group == "energy" && one.quantity == name) return &one.channel.values;
  return nullptr;
}

/// The largest error of the balance beside the largest elastic energy, as the summary of a run has it, to which plastic
/// work is added where there is some: a body that yields holds little.
std::string energy_balance(const HistoryTable& history) {
  const auto *error = energy(history, "balance_error"), *internal = energy(history, "internal"),
             *contact = energy(history, "contact"), *plastic = energy(history, "plastic");
  if (!error || !internal || !contact || history.times.empty()) return "null";
  std::size_t worst = 0;
  double held = 0;
  bool finite = true, yields = false;
  for (std::size_t i = 0; i < history.times.size(); ++i) {
    const double work = plastic ? (*plastic)[i] : 0;
    finite = finite && std::isfinite((*error)[i]);
    yields = yields || work > 0;
    if (std::fabs((*error)[i]) > std::fabs((*error)[worst])) worst = i;
    held = std::max(held, (*internal)[i] + (*contact)[i] + work);
  }
  return json_object({{"error", json_number(finite ? std::fabs((*error)[worst]) : NAN)},
                      {"time", json_number(history.times[worst])},
                      {"held", json_number(held)},
                      {"yields", yields ? "true" : "false"}});
}

}  // namespace

std::string json_list(const std::vector<std::string>& items) {
  std::string text;
  for (const std::string& item : items) text += (text.empty() ? "" : ",") + item;
  return '[' + text + ']';
}

std::string json_object(const Members& members) {
  std::string text;
  for (const auto& [name, value] : members) text += (text.empty() ? "" : ",") + json_text(name) + ':' + value;
  return '{' + text + '}';
}

Section summary_section(const ResultsReader& results, const HistoryTable& history) {
  const hdf5::Group root = results.root();
  Members members;
  for (const char* name : {"title", "program", "case_file", "case_text", "start_time", "reason"})
    members.emplace_back(name, json_text(root.has_attribute(name) ? root.text_attribute(name) : ""));
  for (const char* name : {"completed", "node_count", "element_count", "step_size", "steps", "end_time", "time_reached",
                           "wall_seconds", "element_steps_per_second", "settled_unbalance", "restarts"})
    members.emplace_back(name, root.has_attribute(name) ? json_number(root.number_attribute(name)) : "null");
  members.emplace_back("warnings", texts(root, "warnings"));
  members.emplace_back("left_out", texts(root, "left_out"));
  members.emplace_back("energy", energy_balance(history));
  return {json_object(members)};
}

}  // namespace railwave::page
