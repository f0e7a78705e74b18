#include "sweep/overrides_of_members.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <set>

#include <fmt/format.h>

#include "case/error.hpp"
#include "case/suggest.hpp"

namespace railwave::sweep {
namespace {

using case_file::Complaints;
using case_file::Node;
using case_file::printable;
using Type = Node::Type;

constexpr double most_points = 1e5;

bool is_range(const Node& node) {
  return node.type == Type::table && node.find("from") && node.find("to") && node.find("count");
}

void add_keys(const Node& table, const std::string& before, Overrides& keys) {
  for (const Node& child : table.children) {
    const std::string key = before + (before.empty() ? "" : ".") + child.name;
    if (child.type == Type::table && !is_range(child))
      add_keys(child, key, keys);
    else
      keys.emplace_back(key, child);
  }
}

/// {from = 0.1, to = 0.5, count = 5, spacing = "logarithmic"}
std::vector<Node> points_of_range(const std::string& subject, const Node& range, Complaints& complaints) {
  const auto refuse = [&](const std::string& why) {
    complaints.add(range.where, subject + ": " + why);
    return std::vector<Node>{};
  };
  for (const Node& child : range.children)
    if (child.name != "from" && child.name != "to" && child.name != "count" && child.name != "spacing")
      return refuse("a range has no '" + printable(child.name) + "'; " +
                    suggestion(child.name, {"from", "to", "count", "spacing"}));
  const Node &from = *range.find("from"), &to = *range.find("to"), &count = *range.find("count");
  const Node* spacing = range.find("spacing");
  if (!from.is_number() || !to.is_number()) return refuse("from and to must be numbers");
  if (count.type != Type::integer || count.integer < 2 || count.number > most_points)
    return refuse("count must be a whole number from 2 on");
  const bool logarithmic = spacing && spacing->text == "logarithmic";
  if (spacing && !logarithmic && spacing->text != "even") return refuse("spacing must be \"even\" or \"logarithmic\"");
  if (logarithmic && !(from.number > 0 && to.number > 0)) return refuse("logarithmic spacing needs ends above 0");
  std::vector<Node> points;
  for (std::int64_t i = 0; i < count.integer; ++i) {
    const double share = static_cast<double>(i) / static_cast<double>(count.integer - 1);
    const double value = logarithmic ? from.number * std::pow(to.number / from.number, share)
                                     : from.number + share * (to.number - from.number);
    Node point;
    point.type = Type::number;
    point.where = range.where;
    const std::string text = fmt::format("{:.12g}", value);  // 0.3, not 0.30000000000000004
    std::from_chars(text.data(), text.data() + text.size(), point.number);
    points.push_back(point);
  }
  return points;
}

void read_grid(const Node& grid, MemberSources& sources, Complaints& complaints) {
  if (grid.type != Type::table)
    return complaints.add(grid.where,
                          "[grid]: is " + grid.described() + ", must be a section with a list for each key");
  for (const auto& [key, value] : keys_of(grid)) {
    const std::string subject = "[grid] " + printable(key);
    std::vector<Node> points;
    if (is_range(value)) {
      points = points_of_range(subject, value, complaints);
    } else if (value.type != Type::list || value.children.empty()) {
      complaints.add(value.where, subject +
                                      ": must be a list of values, such as [0.1, 0.3], or {from = 0.1, to = 0.5, "
                                      "count = 5}; what all members have stands in [common]");
    } else {
      points = value.children;
    }
    sources.grid.emplace_back(key, points);
  }
}

void read_list(const Node& list, MemberSources& sources, Complaints& complaints) {
  if (list.type != Type::list)
    return complaints.add(list.where, "list: must be written [[list]] in double brackets, once for each member");
  for (const Node& entry : list.children) {
    if (entry.type != Type::table) {
      complaints.add(entry.where, "list: must be written [[list]] in double brackets, with keys and values below");
      continue;
    }
    sources.list.push_back(keys_of(entry));
    for (const auto& [key, value] : sources.list.back())
      if (is_range(value)) complaints.add(value.where, "[[list]] " + printable(key) + ": a range belongs into [grid]");
  }
}

/// A unit as the program's own tables have it, "key [m]", is no part of the key; an index, "key[1]", is.
std::string without_unit(const std::string& name) {
  const auto unit = name.find(" [");
  return name.substr(0, unit);
}

void read_table(const Node& table, const std::string& folder, MemberSources& sources, Complaints& complaints) {
  if (table.type != Type::text || table.text.empty())
    return complaints.add(table.where, "table: must be the name of a CSV file, such as \"members.csv\"");
  try {
    const CsvRows rows = read_csv((std::filesystem::path(folder) / table.text).string());
    for (const CsvRow& row : rows) {
      if (&row == &rows.front()) continue;
      Overrides overrides;
      for (std::size_t c = 0; c < row.cells.size(); ++c) {
        if (row.cells[c].empty()) continue;  // as the case has it
        const std::string key = without_unit(rows.front().cells[c]);
        Node value;
        if (case_file::parse_override_value(row.cells[c], fmt::format("{} of line {}", key, row.line), value,
                                            complaints))
          overrides.emplace_back(key, value);
      }
      sources.rows.push_back(overrides);
    }
    if (rows.size() == 1) complaints.add(table.where, "table: " + table.text + " has a heading and no row");
  } catch (const InputError& error) {
    complaints.add(table.where, std::string("table: ") + error.what());
  }
}

void add_each_once(const std::vector<std::string>& keys, std::vector<std::string>& all) {
  for (const std::string& key : keys)
    if (std::find(all.begin(), all.end(), key) == all.end()) all.push_back(key);
}

std::vector<std::string> keys_of_entries(const std::vector<Overrides>& entries) {
  std::vector<std::string> keys;
  for (const Overrides& entry : entries)
    for (const auto& one : entry) add_each_once({one.first}, keys);
  return keys;
}

std::vector<std::string> grid_keys(const MemberSources& sources) {
  std::vector<std::string> keys;
  for (const auto& one : sources.grid) keys.push_back(one.first);
  return keys;
}

void refuse_keys_of_two(const MemberSources& sources, const Node& study, Complaints& complaints) {
  const std::pair<const char*, std::vector<std::string>> all[] = {{"[[list]]", keys_of_entries(sources.list)},
                                                                  {"table", keys_of_entries(sources.rows)},
                                                                  {"[grid]", grid_keys(sources)}};
  for (std::size_t a = 0; a < 3; ++a)
    for (std::size_t b = a + 1; b < 3; ++b)
      for (const std::string& key : all[a].second)
        if (std::find(all[b].second.begin(), all[b].second.end(), key) != all[b].second.end())
          complaints.add(study.where, fmt::format("{}: stands both in {} and in {}; keep one of them", printable(key),
                                                  all[a].first, all[b].first));
}

}  // namespace

Overrides keys_of(const Node& table) {
  Overrides keys;
  add_keys(table, "", keys);
  return keys;
}

MemberSources read_member_sources(const Node& study, const std::string& folder, Complaints& complaints) {
  MemberSources sources;
  if (const Node* list = study.find("list")) read_list(*list, sources, complaints);
  if (const Node* table = study.find("table")) read_table(*table, folder, sources, complaints);
  if (const Node* grid = study.find("grid")) read_grid(*grid, sources, complaints);
  refuse_keys_of_two(sources, study, complaints);
  return sources;
}

std::vector<std::string> keys_of(const MemberSources& sources) {
  std::vector<std::string> keys;
  add_each_once(keys_of_entries(sources.list), keys);
  add_each_once(keys_of_entries(sources.rows), keys);
  add_each_once(grid_keys(sources), keys);
  return keys;
}

std::vector<Overrides> combinations(const MemberSources& sources, double most) {
  const auto times = [](std::size_t count) { return std::max<std::size_t>(count, 1); };
  auto count = static_cast<double>(times(sources.list.size()) * times(sources.rows.size()));
  for (const auto& one : sources.grid) count *= static_cast<double>(times(one.second.size()));
  if (count > most)
    throw InputError(
        fmt::format("the study makes {:.0f} members, more than {:.0f}; make lists or grid shorter", count, most));
  std::vector<Overrides> members{{}};
  const auto combine = [&](std::size_t choices, const auto& add) {
    if (choices == 0) return;
    std::vector<Overrides> next;
    for (const Overrides& before : members)
      for (std::size_t choice = 0; choice < choices; ++choice) {
        next.push_back(before);
        add(choice, next.back());
      }
    members = std::move(next);
  };
  const auto add_all = [](const Overrides& more, Overrides& to) { to.insert(to.end(), more.begin(), more.end()); };
  combine(sources.list.size(), [&](std::size_t i, Overrides& to) { add_all(sources.list[i], to); });
  combine(sources.rows.size(), [&](std::size_t i, Overrides& to) { add_all(sources.rows[i], to); });
  for (const auto& [key, points] : sources.grid)
    combine(points.size(),
            [&key = key, &points = points](std::size_t i, Overrides& to) { to.emplace_back(key, points[i]); });
  return members;
}

}  // namespace railwave::sweep
