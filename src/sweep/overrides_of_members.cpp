#include "sweep/overrides_of_members.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <set>

#include <fmt/format.h>

#include "case/error.hpp"
#include "case/keys.hpp"
#include "case/suggest.hpp"

namespace railwave::sweep {
namespace {

using case_file::Complaints;
using case_file::Node;
using case_file::printable;
using case_file::Where;
using Type = Node::Type;

constexpr double most_points = 1e5;

bool is_range(const Node& node) {
  return node.type == Type::table && node.find("from") && node.find("to") && node.find("count");
}

std::string place(const std::string& path, int line) { return path + ':' + std::to_string(line); }

void add_keys(const Node& table, const std::string& before, const std::string& path, Overrides& keys) {
  for (const Node& child : table.children) {
    const std::string key = before + (before.empty() ? "" : ".") + child.name;
    if (child.type == Type::table && !is_range(child))
      add_keys(child, key, path, keys);
    else
      keys.push_back({key, child, place(path, child.where.line)});
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

void read_grid(const Node& grid, const std::string& path, MemberSources& sources, Complaints& complaints) {
  if (grid.type != Type::table)
    return complaints.add(grid.where,
                          "[grid]: is " + grid.described() + ", must be a section with a list for each key");
  for (const auto& [key, value, origin] : keys_of(grid, path)) {
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
    sources.grid.emplace_back();
    for (const Node& point : points) sources.grid.back().push_back({key, point, origin});
  }
}

void read_list(const Node& list, const std::string& path, MemberSources& sources, Complaints& complaints) {
  if (list.type != Type::list)
    return complaints.add(list.where, "list: must be written [[list]] in double brackets, once for each member");
  for (const Node& entry : list.children) {
    if (entry.type != Type::table) {
      complaints.add(entry.where, "list: must be written [[list]] in double brackets, with keys and values below");
      continue;
    }
    sources.list.push_back(keys_of(entry, path));
    for (const Override& one : sources.list.back())
      if (is_range(one.value))
        complaints.add(one.value.where, "[[list]] " + printable(one.key) + ": a range belongs into [grid]");
  }
}

/// A unit as the program's own tables have it, "key [m]", is no part of the key; an index, "key[1]", is.
std::string without_unit(const std::string& name) { return name.substr(0, name.find(" [")); }

/// Complains about columns that would be left out, counted twice or taken in another unit than is written.
void check_heading(const CsvRows& rows, const std::string& file, Where where, Complaints& complaints) {
  const std::vector<std::string>& heading = rows.front().cells;
  const auto refuse = [&](const std::string& why) {
    complaints.add(where, fmt::format("table: {}: {}", place(file, rows.front().line), why));
  };
  for (std::size_t c = 0; c < heading.size(); ++c) {
    const std::string key = without_unit(heading[c]), shown = printable(key), unit = unit_of_key(key);
    const auto same = [&](const std::string& other) { return without_unit(other) == key; };
    const auto before = heading.begin() + static_cast<std::ptrdiff_t>(c);
    if (key.empty())
      refuse(fmt::format("column {} has no heading; write the key of the case that it is of", c + 1));
    else if (std::any_of(heading.begin(), before, same))
      refuse(shown + ": has two columns; keep one of them");
    else if (rows.size() > 1 &&
             std::all_of(rows.begin() + 1, rows.end(), [&](const CsvRow& row) { return row.cells[c].empty(); }))
      refuse(shown + ": no line has a value in this column; fill it in or leave it out");
    if (key.size() < heading[c].size() && heading[c] != key + " [" + unit + ']')
      refuse(fmt::format("{}: is in {}, not in{}; the program converts no units", shown, unit == "1" ? "no unit" : unit,
                         printable(heading[c].substr(key.size()))));
  }
}

void read_table(const Node& table, const std::string& path, MemberSources& sources, Complaints& complaints) {
  if (table.type != Type::text || table.text.empty())
    return complaints.add(table.where, "table: must be the name of a CSV file, such as \"members.csv\"");
  try {
    const std::string file = (std::filesystem::path(path).parent_path() / table.text).string();
    const CsvRows rows = read_csv(file);
    check_heading(rows, file, table.where, complaints);
    for (const CsvRow& row : rows) {
      if (&row == &rows.front()) continue;
      Overrides overrides;
      for (std::size_t c = 0; c < row.cells.size(); ++c) {
        if (row.cells[c].empty()) continue;  // as the case has it
        const std::string key = without_unit(rows.front().cells[c]);
        Node value;
        const std::string origin = place(file, row.line);
        if (case_file::parse_override_value(row.cells[c], fmt::format("table: {}: {}", origin, key), table.where, value,
                                            complaints))
          overrides.push_back({key, value, origin});
      }
      if (overrides.empty())
        complaints.add(table.where, fmt::format("table: {}: the line has no value; leave it out, or write one that the "
                                                "case has",
                                                place(file, row.line)));
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
    for (const Override& one : entry) add_each_once({one.key}, keys);
  return keys;
}

void refuse_keys_of_two(const MemberSources& sources, const Node& study, Complaints& complaints) {
  const std::pair<const char*, std::vector<std::string>> all[] = {{"[[list]]", keys_of_entries(sources.list)},
                                                                  {"table", keys_of_entries(sources.rows)},
                                                                  {"[grid]", keys_of_entries(sources.grid)}};
  for (std::size_t a = 0; a < 3; ++a)
    for (std::size_t b = a + 1; b < 3; ++b)
      for (const std::string& key : all[a].second)
        if (std::find(all[b].second.begin(), all[b].second.end(), key) != all[b].second.end())
          complaints.add(study.where, fmt::format("{}: stands both in {} and in {}; keep one of them", printable(key),
                                                  all[a].first, all[b].first));
}

}  // namespace

std::string unit_of_key(const std::string& key) {
  const auto first = key.find('.'), last = key.rfind('.');
  const std::string section_name = first == std::string::npos ? "" : key.substr(0, first);
  std::string name = last == std::string::npos ? key : key.substr(last + 1);
  name = name.substr(0, name.find('['));
  const auto* section = case_file::find_section(section_name);
  if (section)
    for (const case_file::Key& one : section->keys)
      if (one.name == name && !one.unit.empty()) return one.unit;
  return "1";
}

Overrides keys_of(const Node& table, const std::string& path) {
  Overrides keys;
  add_keys(table, "", path, keys);
  return keys;
}

MemberSources read_member_sources(const Node& study, const std::string& path, Complaints& complaints) {
  MemberSources sources;
  if (const Node* list = study.find("list")) read_list(*list, path, sources, complaints);
  if (const Node* table = study.find("table")) read_table(*table, path, sources, complaints);
  if (const Node* grid = study.find("grid")) read_grid(*grid, path, sources, complaints);
  refuse_keys_of_two(sources, study, complaints);
  return sources;
}

std::vector<std::string> keys_of(const MemberSources& sources) {
  std::vector<std::string> keys;
  add_each_once(keys_of_entries(sources.list), keys);
  add_each_once(keys_of_entries(sources.rows), keys);
  add_each_once(keys_of_entries(sources.grid), keys);
  return keys;
}

std::vector<Overrides> combinations(const MemberSources& sources, double most) {
  const auto times = [](std::size_t count) { return std::max<std::size_t>(count, 1); };
  auto count = static_cast<double>(times(sources.list.size()) * times(sources.rows.size()));
  for (const Overrides& points : sources.grid) count *= static_cast<double>(times(points.size()));
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
  for (const Overrides& points : sources.grid)
    combine(points.size(), [&](std::size_t i, Overrides& to) { to.push_back(points[i]); });
  return members;
}

}  // namespace railwave::sweep
