#include <algorithm>

#include <fmt/format.h>

#include "case/error.hpp"
#include "post/contact_command.hpp"
#include "post/contact_reader.hpp"
#include "post/contact_tables.hpp"
#include "post/patch_ways.hpp"
#include "post/results_reader.hpp"

namespace railwave {
namespace {

/// Output times are multiples of the step, rounded.
constexpr double interval_rounding = 1e-6;

/// Reads the states of the contacts of a solution, as that of one.
class StatesTogether {
 public:
  StatesTogether(const ResultsReader& results, const std::vector<std::string>& contacts) {
    for (const std::string& contact : contacts) {
      readers_.emplace_back(results, contact);
      const std::vector<double>& own = readers_.back().times();
      if (contact == contacts.front()) times_ = own;
      const std::size_t both = std::min(own.size(), times_.size());  // a killed run may have written one more of one
      if (!std::equal(own.begin(), own.begin() + static_cast<long>(both), times_.begin()))
        throw InputError(
            fmt::format("contacts {} and {} have outputs at different times: those that are together want "
                        "the same windows of output",
                        contacts.front(), contact));
      times_.resize(both);
    }
  }
  const std::vector<double>& times() const { return times_; }
  ContactState state(std::size_t index) const {
    if (readers_.size() == 1) return readers_.front().state(index);
    std::vector<ContactState> states;
    for (const ContactReader& reader : readers_) states.push_back(reader.state(index));
    return contacts_together(states);
  }

 private:
  std::vector<ContactReader> readers_;
  std::vector<double> times_;
};

/// Which of the output times a request asks for.
std::vector<std::size_t> wanted_outputs(const std::vector<double>& times, const ContactRequest& request) {
  std::vector<std::size_t> outputs;
  for (std::size_t i = 0; i < times.size(); ++i) {
    if (times[i] < request.from || times[i] > request.to) continue;
    if (!outputs.empty() && times[i] < times[outputs.back()] + (1 - interval_rounding) * request.interval) continue;
    outputs.push_back(i);
  }
  return outputs;
}

}  // namespace

std::vector<std::size_t> evenly_chosen(std::size_t count, std::size_t most) {
  std::vector<std::size_t> chosen;
  const std::size_t taken = std::min(count, most);
  for (std::size_t n = 0; n < taken; ++n)
    chosen.push_back(taken == 1 ? count - 1 : (n * (count - 1) + (taken - 1) / 2) / (taken - 1));
  return chosen;
}

ContactTables contact_tables(const ResultsReader& results, const std::string& name,
                             const std::vector<std::string>& contacts, const ContactRequest& request) {
  ContactTables tables;
  PatchOptions options;
  options.rolling = Vector(request.rolling_direction.data());
  options.ring = {request.ring[0], request.ring[1]};

  PatchWays ways(options.rolling);
  const StatesTogether reader(results, contacts);
  const std::vector<double>& times = reader.times();
  const std::vector<std::size_t> outputs = wanted_outputs(times, request);
  const std::vector<std::size_t> detailed = evenly_chosen(outputs.size(), request.most_detailed);
  std::vector<double> chosen;
  for (std::size_t n = 0; n < outputs.size(); ++n) {
    const double time = times[outputs[n]];
    const bool in_detail = std::binary_search(detailed.begin(), detailed.end(), n);
    tables.with_nodes = in_detail && request.nodes.has_value();
    tables.with_facets = in_detail && request.hdf5.has_value();
    tables.with_cuts = in_detail && (request.cuts || request.hdf5);
    const ContactState state = reader.state(outputs[n]);
    const ContactSolution solution = contact_solution(state, options);
    tables.add(time, state, solution, ways.add(time, solution));
    chosen.push_back(time);
  }
  if (chosen.empty() && !times.empty())
    throw InputError(fmt::format("contact {} has no output time from {} s to {} s: they go from {} s to {} s", name,
                                 request.from, request.to, times.front(), times.back()));
  if (request.rolling_velocity) {
    tables.set_rolling_velocity(*request.rolling_velocity);
  } else if (request.axle) {
    tables.set_patch_velocity(results.set_velocity(*request.axle, chosen));
  } else {
    tables.set_velocity_of_rows(ways.velocity_of_rows());
  }
  return tables;
}

}  // namespace railwave
