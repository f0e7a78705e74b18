#include <algorithm>
#include <cmath>

#include "report/page.hpp"

namespace railwave::page {
namespace {

Json texts(const hdf5::Group& root, const char* name) {
  return root.has_attribute(name) ? Json(root.texts_attribute(name)) : Json::array();
}

/// Samples of an energy, J; none where the run did not write it.
const std::vector<double>* energy(const HistoryTable& history, const char* name) {
  for (const SampledChannel& one : history.channels)
    if (one.group == "energy" && one.quantity == name) return &one.channel.values;
  return nullptr;
}

/// The largest error of the balance beside the largest elastic energy, as the summary of a run has it, to which plastic
/// work is added where there is some: a body that yields holds little.
Json energy_balance(const HistoryTable& history) {
  const auto *error = energy(history, "balance_error"), *internal = energy(history, "internal"),
             *contact = energy(history, "contact"), *plastic = energy(history, "plastic");
  if (!error || !internal || !contact || history.times.empty()) return nullptr;
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
  return {{"error", finite ? std::fabs((*error)[worst]) : NAN},
          {"time", history.times[worst]},
          {"held", held},
          {"yields", yields}};
}

}  // namespace

Section summary_section(const ResultsReader& results, const HistoryTable& history) {
  const hdf5::Group root = results.root();
  Json members = Json::object();
  for (const char* name : {"title", "program", "case_file", "case_text", "start_time", "reason"})
    members[name] = root.has_attribute(name) ? root.text_attribute(name) : "";
  for (const char* name : {"completed", "node_count", "element_count", "step_size", "steps", "end_time", "time_reached",
                           "wall_seconds", "element_steps_per_second", "settled_unbalance", "restarts"})
    members[name] = root.has_attribute(name) ? Json(root.number_attribute(name)) : Json();
  members["warnings"] = texts(root, "warnings");
  members["left_out"] = texts(root, "left_out");
  members["energy"] = energy_balance(history);
  return {members};
}

}  // namespace railwave::page
