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

}  // namespace

ContactTables contact_tables(const ResultsReader& results, const std::string& name,
                             const std::vector<std::string>& contacts, const ContactRequest& request) {
  ContactTables tables;
  tables.with_nodes = request.nodes.has_value();
  tables.with_facets = request.hdf5.has_value();
  tables.with_cuts = request.cuts || request.hdf5;
  PatchOptions options;
  options.rolling = Vector(request.rolling_direction.data());
  options.ring = {request.ring[0], request.ring[1]};

  PatchWays ways(options.rolling);
  std::vector<double> chosen;
  const StatesTogether reader(results, contacts);
  const std::vector<double>& times = reader.times();
  for (std::size_t i = 0; i < times.size(); ++i) {
    if (times[i] < request.from || times[i] > request.to) continue;
    if (!chosen.empty() && times[i] < chosen.back() + (1 - interval_rounding) * request.interval) continue;
    const ContactState state = reader.state(i);
    const ContactSolution solution = contact_solution(state, options);
    tables.add(times[i], state, solution, ways.add(times[i], solution));
    chosen.push_back(times[i]);
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
