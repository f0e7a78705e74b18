#include "mesh/files/abaqus_sets.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "case/error.hpp"
#include "mesh/files/numbered_mesh.hpp"
#include "mesh/files/text_file.hpp"

namespace railwave {
namespace {
constexpr int deepest_nesting = 100;
}

AbaqusSets::AbaqusSets(Of kind, const NumberedMesh& mesh)
    : of_nodes_(kind == Of::nodes), kind_(of_nodes_ ? "node" : "element"), mesh_(mesh) {}

const std::vector<std::int64_t>& AbaqusSets::defined_numbers() const {
  return of_nodes_ ? mesh_.node_numbers() : mesh_.element_numbers();
}

std::optional<int> AbaqusSets::find(std::int64_t number) const {
  return of_nodes_ ? mesh_.find_node(number) : mesh_.find_element(number);
}

void AbaqusSets::open(const std::string& name, bool in_assembly, bool internal, const FilePlace& place) {
  const auto [entry, is_new] = sets_.try_emplace(name);
  Definition& set = entry->second;
  if (is_new) {
    set.in_assembly = in_assembly;
    set.internal = internal;
    set.place = place;
  } else if (set.in_assembly != in_assembly) {
    throw InputError(
        fmt::format("{} {} set '{}' is defined in the part and in the assembly (at {}), so a case file can't "
                    "tell them apart; rename one",
                    mesh_.where(place), kind_, for_message(name), mesh_.where(set.place)));
  }
  set.positions.reset();
}

void AbaqusSets::add_number(const std::string& name, std::int64_t number, const FilePlace& place) {
  sets_[name].numbers.push_back({number, place});
}

void AbaqusSets::add_range(const std::string& name, std::int64_t first, std::int64_t last, std::int64_t step,
                           const FilePlace& place) {
  sets_[name].ranges.push_back({first, last, step, place});
}

void AbaqusSets::add_set(const std::string& name, const std::string& other, const FilePlace& place) {
  sets_[name].sets.push_back({other, place});
}

const std::vector<int>& AbaqusSets::positions(const std::string& name, const FilePlace& place) {
  const auto entry = sets_.find(name);
  if (entry == sets_.end())
    throw InputError(fmt::format("{} there is no {} set '{}'; define it with *{}, or mend the name", mesh_.where(place),
                                 kind_, for_message(name), of_nodes_ ? "NSET" : "ELSET"));
  resolve(name, entry->second, 0);
  return *entry->second.positions;
}

std::map<std::string, std::vector<int>> AbaqusSets::all(bool with_internal) {
  std::map<std::string, std::vector<int>> result;
  for (auto& [name, set] : sets_) {
    if (set.internal && !with_internal) continue;
    resolve(name, set, 0);
    result[name] = *set.positions;
  }
  return result;
}

void AbaqusSets::resolve(const std::string& name, Definition& set, int depth) {
  if (set.positions) return;
  if (depth > deepest_nesting)
    throw InputError(fmt::format("{} {} set '{}' lies more than {} sets deep; name its members directly",
                                 mesh_.where(set.place), kind_, for_message(name), deepest_nesting));
  set.being_resolved = true;
  std::vector<int> positions;
  for (const Number& entry : set.numbers) {
    const auto position = find(entry.number);
    if (!position)
      throw InputError(
          fmt::format("{} {} set '{}' names {} {}, which the file doesn't define; take it out or define it",
                      mesh_.where(entry.place), kind_, for_message(name), kind_, entry.number));
    positions.push_back(*position);
  }
  // Many lines that name the same again and again must not take more room than all that there is.
  const auto merge = [&, all = defined_numbers().size()] {
    if (positions.size() > 2 * all) sort_unique(positions);
  };
  for (const Range& range : set.ranges) {
    add_range_positions(name, range, positions);
    merge();
  }
  for (const Reference& reference : set.sets) {
    const auto entry = sets_.find(reference.name);
    if (entry == sets_.end())
      throw InputError(
          fmt::format("{} {} set '{}' names '{}', which is neither a number nor a {} set of this file; mend "
                      "the name",
                      mesh_.where(reference.place), kind_, for_message(name), for_message(reference.name), kind_));
    if (entry->second.being_resolved)
      throw InputError(fmt::format("{} {} set '{}' contains itself by way of '{}'; take one of the two out",
                                   mesh_.where(reference.place), kind_, for_message(name),
                                   for_message(reference.name)));
    resolve(reference.name, entry->second, depth + 1);
    positions.insert(positions.end(), entry->second.positions->begin(), entry->second.positions->end());
    merge();
  }
  sort_unique(positions);
  set.positions = std::move(positions);
  set.being_resolved = false;
}

void AbaqusSets::add_range_positions(const std::string& name, const Range& range, std::vector<int>& positions) const {
  const auto size_before = positions.size();
  const auto& numbers = defined_numbers();
  // A range may be far longer than the mesh ("all up to 999999999"): go through whichever is shorter.
  if ((range.last - range.first) / range.step >= static_cast<std::int64_t>(numbers.size())) {
    for (std::size_t i = 0; i < numbers.size(); ++i)
      if (numbers[i] >= range.first && numbers[i] <= range.last && (numbers[i] - range.first) % range.step == 0)
        positions.push_back(static_cast<int>(i));
  } else {
    for (std::int64_t number = range.first; number <= range.last; number += range.step)
      if (const auto position = find(number)) positions.push_back(*position);
  }
  if (positions.size() == size_before)
    throw InputError(
        fmt::format("{} {} set '{}' has the range {} to {} by {}, but the file defines no {} in it; mend the "
                    "range",
                    mesh_.where(range.place), kind_, for_message(name), range.first, range.last, range.step, kind_));
}

}  // namespace railwave
