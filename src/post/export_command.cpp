#include "post/export_command.hpp"

#include <algorithm>
#include <filesystem>
#include <ostream>
#include <sstream>

#include <fmt/format.h>

#include "case/error.hpp"
#include "case/suggest.hpp"
#include "post/vtkhdf_file.hpp"

namespace railwave {
namespace {

std::string export_path(const ExportRequest& request) {
  return request.out.value_or(std::filesystem::path(request.results).replace_extension(".vtkhdf").string());
}

void check(const ExportRequest& request) {
  if (!request.vtkhdf) throw InputError("railwave export: say which format is to be written: --vtkhdf");
  if (!(request.from <= request.to))
    throw InputError(fmt::format("--from {} is after --to {}", request.from, request.to));
  const std::optional<std::string> path = export_path(request);
  check_wanted_files({request.results}, {{"--out", path, vtkhdf_kind()}}, request.overwrite);
}

/// Which of the sets `show` names.
std::vector<bool> named_sets(const std::vector<FieldSet>& all, const std::string& show) {
  std::vector<std::string> names;
  for (const FieldSet& set : all) names.push_back(set.name);
  std::vector<bool> wanted(all.size(), false);
  std::stringstream list(show);
  for (std::string name; std::getline(list, name, ',');) {
    const auto place = std::find(names.begin(), names.end(), name);
    if (place == names.end())
      throw InputError(
          fmt::format("--show {}: the results have no fields of '{}'; {}", show, name, suggestion(name, names)));
    wanted[static_cast<std::size_t>(place - names.begin())] = true;
  }
  return wanted;
}

/// A set that has all elements of this one, so that in one grid they would be drawn twice; of sets alike the first
/// counts. Null: there is none.
const FieldSet* set_around(const std::vector<FieldSet>& all, std::size_t one) {
  for (std::size_t other = 0; other < all.size(); ++other) {
    if (other == one || !is_within(all[one], all[other]) || all[one].corner_count > all[other].corner_count) continue;
    const bool alike = all[one].corner_count == all[other].corner_count && is_within(all[other], all[one]);
    if (!alike || other < one) return &all[other];
  }
  return nullptr;
}

std::vector<bool> outer_sets(const std::vector<FieldSet>& all, std::ostream& out) {
  std::vector<bool> wanted;
  for (std::size_t one = 0; one < all.size(); ++one) {
    const FieldSet* around = set_around(all, one);
    if (around)
      out << fmt::format("note: {} is within {} and left out; --show {} takes it\n", all[one].name, around->name,
                         all[one].name);
    wanted.push_back(around == nullptr);
  }
  return wanted;
}

std::vector<FieldSet> wanted_sets(std::vector<FieldSet> all, const std::string& show, std::ostream& out) {
  const std::vector<bool> wanted = show.empty() ? outer_sets(all, out) : named_sets(all, show);
  std::vector<FieldSet> sets;
  for (std::size_t i = 0; i < all.size(); ++i)
    if (wanted[i]) sets.push_back(std::move(all[i]));
  return sets;
}

std::string about(const std::vector<ExportedTime>& times) {
  if (times.size() == 1)
    return fmt::format("the output at {:.6g} s, VTKHDF 1.0: ParaView 5.10 or later opens it", times[0].time);
  return fmt::format("{} output times from {:.6g} to {:.6g} s, VTKHDF 2.0: ParaView 5.12 or later opens it",
                     times.size(), times.front().time, times.back().time);
}

}  // namespace

int export_command(const ExportRequest& request, std::ostream& out) {
  check(request);
  const ResultsReader results(request.results);
  if (!results.completed()) out << "note: this run did not complete: " << results.reason() << '\n';
  std::vector<FieldSet> all = read_field_sets(results);
  if (all.empty())
    throw InputError(fmt::format(
        "results file {} holds no fields: output.field_sets names none, or the run ended before its first output",
        request.results));
  const std::vector<FieldSet> sets = wanted_sets(std::move(all), request.show, out);
  const std::vector<ExportedTime> times = times_of(sets, request.from, request.to);
  if (times.empty())
    throw InputError(fmt::format("results file {} has no output of these fields from {} to {} s", request.results,
                                 request.from, request.to));
  const std::string path = export_path(request);
  results.report_damage([&] {
    write_vtkhdf_file(path, results, sets, times);
    return 0;
  });
  for (std::size_t i = 0; i < sets.size(); ++i)
    out << fmt::format("set {}: {}, {} cells, {} nodes\n", i, sets[i].name, sets[i].cell_count(), sets[i].node_count());
  out << fmt::format("{}: {}\n", path, about(times));
  return 0;
}

}  // namespace railwave
