#include "solve/statics/static_start.hpp"

namespace railwave {

SettleReport come_to_rest(Model& model, SettledStates* states, const std::function<bool(const SettleReport&)>& go_on) {
  SettleReport report;
  std::vector<std::string> remarks;
  std::string begun_from;
  if (states != nullptr) {
    const SettledStates::Found found = states->find(model);
    if (!found.trouble.empty()) remarks.push_back(found.file + ": " + found.trouble + "; the scene settles anew");
    if (found.state && !lay_static_state(model, *found.state))
      remarks.push_back(found.file + ": is of another model; the scene settles anew");
    else if (found.state)
      begun_from = found.file;
    if (!begun_from.empty() && found.state->settled) {
      report.settled = true;
      report.unbalance = found.state->unbalance;
      report.taken_from = begun_from;
      return report;
    }
  }
  report = settle(model, go_on);
  if (states != nullptr) {
    StaticState state = take_static_state(model);
    state.settled = report.settled;
    state.unbalance = report.unbalance;
    state.steps = report.steps;
    state.iterations = report.iterations;
    const std::string trouble = states->keep(model, state);
    if (!trouble.empty()) remarks.push_back("the settled state could not be kept: " + trouble);
  }
  report.remarks.insert(report.remarks.end(), remarks.begin(), remarks.end());
  report.begun_from = begun_from;
  return report;
}

}  // namespace railwave
