#include "post/hammer_test.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string_view>

#include "case/error.hpp"
#include "case/number_text.hpp"
#include "case/suggest.hpp"
#include "post/channel_name.hpp"
#include "post/history_series.hpp"

namespace railwave {
namespace {

/// Share of the largest response that may be left at the end of the record.
constexpr double died_away = 0.02;

/// Samples of a blow: with n of them in half a sine wave the trapezoidal rule is off by 0.82/n^2.
constexpr double fewest_struck = 12;

double struck_samples(const std::vector<double>& force) {
  double most = 0;
  for (const double one : force) most = std::max(most, std::fabs(one));
  return static_cast<double>(
      std::count_if(force.begin(), force.end(), [&](double one) { return std::fabs(one) > 1e-3 * most; }));
}

std::string vector_text(const Eigen::Vector3d& v) { return fmt::format("{:.17g},{:.17g},{:.17g}", v[0], v[1], v[2]); }

std::string behind_dot(const std::string& set) {
  return set.substr(set.find('.') == std::string::npos ? 0 : set.find('.') + 1);
}

double largest(const std::vector<double>& values, std::size_t from) {
  double result = 0;
  for (std::size_t i = from; i < values.size(); ++i) result = std::max(result, std::fabs(values[i]));
  return result;
}

void note(std::vector<std::string>& notes, const std::string& text) {
  if (std::find(notes.begin(), notes.end(), text) == notes.end()) notes.push_back(text);
}

}  // namespace

ResponseSettings ResponseSettings::of(double resolution, const std::string& window, double window_end) {
  if (window != "none" && window != "exponential")
    throw InputError(fmt::format("--window {}: must be none or exponential", window));
  if (!(window_end > 0 && window_end < 1))
    throw InputError(fmt::format("--window-end {}: must be above 0 and below 1", window_end));
  if (!(resolution > 0)) throw InputError(fmt::format("--resolution {}: must be above 0 Hz", resolution));
  return {resolution, window == "exponential" ? window_end : 1};
}

std::vector<std::string> SignalNotes::summary() const {
  std::vector<std::string> all = texts;
  if (left_share > 0)
    all.push_back(
        fmt::format("up to {:.2g} % of the largest acceleration is left at the end (at {}), which smears sharp peaks: "
                    "lengthen time.end, or take --window exponential",
                    100 * left_share, left_at));
  return all;
}

HammerTest::HammerTest(const std::vector<std::string>& files, const std::string& load) {
  if (files.empty()) throw InputError("no results file was named");
  for (const std::string& file : files) results_.emplace_back(file);
  results_.front().report_damage([&] {
    const hdf5::Group history = results_.front().history();
    if (!history.has("set")) return;
    for (const std::string& set : history.group("set").names()) {
      const hdf5::Group group = history.group("set").group(set);
      if (group.has("displacement") && group.has("velocity") && group.has("acceleration")) sets_.push_back(set);
    }
  });
  std::sort(sets_.begin(), sets_.end(), in_number_order);
  if (sets_.empty())
    throw InputError(
        fmt::format("{} has the displacement, velocity and acceleration of no set; add a section [probes.NAME] to the "
                    "case, or name sets of nodes in output.history_sets",
                    files.front()));
  results_.front().report_damage([&] { choose_input(load), check_texts(); });
  for (const ResultsReader& results : results_) {
    const HistorySeries series =
        read_history(results, {{fmt::format("load.{}.force.{}", input_.load, vector_text(input_.direction))}});
    if (interval_ == 0) interval_ = series.interval, duration_ = series.interval * static_cast<double>(series.length());
    if (std::fabs(series.interval - interval_) > 1e-6 * interval_)
      throw InputError(
          fmt::format("{} has samples every {:.9g} s, {} every {:.9g} s: blows that are to be averaged must have the "
                      "same time.step, or step estimate, and history_interval",
                      results.path(), series.interval, results_.front().path(), interval_));
    duration_ = std::min(duration_, series.interval * static_cast<double>(series.length()));
    if (largest(series.channels[0].values, 0) == 0)
      throw InputError(fmt::format("{}: the force of '{}' is 0 all the time", results.path(), input_.load));
  }
}

void HammerTest::choose_input(const std::string& load) {
  const hdf5::Group history = results_.front().history();
  const std::string& path = results_.front().path();
  std::vector<std::string> forces, hammers;
  if (history.has("load"))
    for (const std::string& name : history.group("load").names()) {
      const hdf5::Group group = history.group("load").group(name);
      if (!group.has("force") || !group.has("direction")) continue;
      forces.push_back(name);
      if (group.number_attribute("hammer") != 0) hammers.push_back(name);
    }
  if (forces.empty())
    throw InputError(fmt::format(
        "{} has no force of fixed direction that could be the input; add a section [hammers.NAME] to the case", path));
  const auto& candidates = hammers.empty() ? forces : hammers;
  if (load.empty() && candidates.size() > 1)
    throw InputError(
        fmt::format("{} has several {}: {}; name the one that is the input by --input (and strike with one at a time: "
                    "responses to blows that overlap cannot be told apart)",
                    path, hammers.empty() ? "loads" : "hammers", joined(candidates)));
  input_.load = load.empty() ? candidates.front() : load;
  if (std::find(forces.begin(), forces.end(), input_.load) == forces.end())
    throw InputError(fmt::format("--input {}: {} has no such load with a force of fixed direction; {}", load, path,
                                 suggestion(load, forces)));
  const hdf5::Group group = history.group("load").group(input_.load);
  input_.set = group.text_attribute("target");
  input_.direction = read_vector(group, "direction");
}

/// Texts have no checksums in the file: a hammer is to hit a set that was made for one, and whatever made a set gave it
/// its name.
void HammerTest::check_texts() const {
  const hdf5::Group group = results_.front().history().group("load").group(input_.load);
  const bool hammer = group.number_attribute("hammer") != 0;
  if (hammer && std::find(sets_.begin(), sets_.end(), input_.set) == sets_.end())
    throw std::runtime_error(
        fmt::format("load '{}' has the target '{}', of which there is no history", input_.load, input_.set));
  for (const std::string& set : sets_) {
    const std::string by = asker(set), name = by.substr(std::min(by.size(), by.find(' ') + 1)), own = behind_dot(set);
    if (by.empty()) continue;
    const bool of_hammer = by == "hammer " + name,
               named = own == name || own.compare(0, name.size() + 1, name + "_") == 0;
    if (!named || (!of_hammer && by != "probe " + name) || (hammer && set == input_.set && !of_hammer))
      throw std::runtime_error(fmt::format("set '{}' was made by '{}', which cannot be", set, by));
  }
}

std::string HammerTest::asker(const std::string& set) const {
  return results_.front().report_damage([&] {
    const hdf5::Group group = results_.front().history().group("set").group(set);
    return group.has_attribute("asked_by") ? group.text_attribute("asked_by") : std::string();
  });
}

std::optional<Eigen::Vector3d> HammerTest::place(const std::string& set) const {
  return results_.front().report_damage([&]() -> std::optional<Eigen::Vector3d> {
    const hdf5::Group group = results_.front().history().group("set").group(set);
    if (!group.has("position")) return std::nullopt;
    return read_vector(group, "position");
  });
}

Eigen::Vector3d HammerTest::direction_of(const std::string& text, const std::string& asked) const {
  if (text.empty()) return input_.direction;
  const char* words[] = {"longitudinal", "lateral", "vertical"};
  for (int axis = 0; axis < 3; ++axis) {
    const Eigen::Vector3d along = Eigen::Vector3d::Unit(axis);
    if (text == words[axis]) return input_.direction[axis] < -1e-6 ? Eigen::Vector3d(-along) : along;
    const std::string letter(1, static_cast<char>('x' + axis));
    if (text == letter || text == "+" + letter) return along;
    if (text == "-" + letter) return -along;
  }
  Eigen::Vector3d direction;
  std::string_view rest = text;
  for (int i = 0; i < 3; ++i) {
    const auto comma = i < 2 ? rest.find(',') : rest.size();
    const auto read = comma == std::string_view::npos ? std::nullopt : parse_real(rest.substr(0, comma));
    if (!read)
      throw InputError(
          fmt::format("--response {}: '{}' is no direction; it may be vertical, lateral, longitudinal, x, y, z, -x, "
                      "-y, -z or a vector such as 1,0,0.05",
                      asked, text));
    direction[i] = *read;
    if (i < 2) rest.remove_prefix(comma + 1);
  }
  if (!(direction.norm() > 0)) throw InputError(fmt::format("--response {}: the direction has no length", asked));
  return direction.normalized();
}

std::vector<std::string> HammerTest::sets_named(const std::string& name) const {
  std::vector<std::string> found;
  const auto take = [&](auto&& is_meant) {
    if (!found.empty()) return;
    for (const std::string& set : sets_)
      if (is_meant(set)) found.push_back(set);
  };
  take([&](const std::string& set) { return set == name; });
  take([&](const std::string& set) { return behind_dot(set) == name; });
  take([&](const std::string& set) { return asker(set) == "probe " + name; });
  take([&](const std::string& set) { return matches_pattern(name, set) || matches_pattern(name, behind_dot(set)); });
  return found;
}

HammerResponse HammerTest::response(const std::string& set, const Eigen::Vector3d& direction,
                                    const std::string& text) const {
  const double cosine = std::fabs(direction.dot(input_.direction));
  const char* kind = cosine < 0.999 ? "cross" : set == input_.set ? "direct" : "transfer";
  return {set, direction, text.empty() ? set : set + ":" + text, kind};
}

std::vector<HammerResponse> HammerTest::find(const std::string& text) const {
  const auto colon = text.rfind(':');
  const std::string name = text.substr(0, colon), along = colon == std::string::npos ? "" : text.substr(colon + 1);
  const auto sets = sets_named(name);
  if (sets.empty())
    throw InputError(
        fmt::format("--response {}: there is no history of a set '{}'; {}", text, name, suggestion(name, sets_)));
  const Eigen::Vector3d direction = direction_of(along, text);
  std::vector<HammerResponse> found;
  for (const std::string& set : sets) found.push_back(response(set, direction, along));
  return found;
}

std::vector<HammerResponse> HammerTest::all() const {
  std::vector<HammerResponse> found;
  const bool any = std::any_of(sets_.begin(), sets_.end(), [&](const std::string& set) { return !asker(set).empty(); });
  for (const bool struck : {true, false})
    for (const std::string& set : sets_)
      if ((set == input_.set) == struck && (!any || struck || !asker(set).empty()))
        found.push_back(response(set, input_.direction, ""));
  return found;
}

double HammerTest::decay(const ResponseSettings& settings) const { return -std::log(settings.window_end) / duration_; }

FrequencyResponse HammerTest::accelerance(const HammerResponse& response, const ResponseSettings& settings,
                                          SignalNotes& notes) const {
  const auto samples = static_cast<std::size_t>(std::lround(duration_ / interval_));
  std::vector<Blow> blows;
  for (const ResultsReader& results : results_) {
    const std::string along = vector_text(response.direction);
    HistorySeries series = read_history(
        results,
        {{fmt::format("load.{}.force.{}", input_.load, vector_text(input_.direction)),
          fmt::format("{}.displacement.{}", response.set, along), fmt::format("{}.velocity.{}", response.set, along),
          fmt::format("{}.acceleration.{}", response.set, along)}});
    for (const std::string& text : series.notes) note(notes.texts, text);
    for (HistoryChannel& channel : series.channels) channel.values.resize(samples);
    auto &force = series.channels[0].values, &displacement = series.channels[1].values;
    const auto &velocity = series.channels[2].values, &acceleration = series.channels[3].values;
    const double left = largest(acceleration, samples - samples / 20) / largest(acceleration, 0) * settings.window_end;
    if (left > died_away && left > notes.left_share) notes.left_share = left, notes.left_at = response.set;
    if (const auto few = struck_samples(force); few < fewest_struck)
      note(notes.texts, fmt::format("the blow has {} samples, fewer than {}: its spectrum is not certain by {:.1g} %; "
                                    "shorten output.history_interval",
                                    few, fewest_struck, 82.0 / (few * few)));
    blows.push_back({std::move(force), std::move(displacement), velocity.front(), velocity.back()});
  }
  const auto wanted = static_cast<std::size_t>(std::ceil(1 / (settings.resolution * interval_)));
  return frequency_response(blows, interval_, quick_length(std::max(samples, wanted)), decay(settings));
}

}  // namespace railwave
