#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <limits>
#include <optional>
#include <thread>

#include <fmt/format.h>

#include "case/error.hpp"
#include "output/atomic_file.hpp"
#include "output/hdf5/hdf5.hpp"
#include "post/table.hpp"
#include "sweep/member_row.hpp"

namespace railwave::sweep {
namespace {

namespace fs = std::filesystem;
using case_file::Node;
using Type = Node::Type;

constexpr double no_number = std::numeric_limits<double>::quiet_NaN();
constexpr const char* csv_mark = "sweep member";

FileKind csv_kind() { return {FileKind::Form::text, "the table of a sweep", csv_mark, ""}; }
FileKind hdf5_kind() { return {FileKind::Form::hdf5, "the table of a sweep", "Railwave sweep", ""}; }

std::string number_text(double value) { return std::isnan(value) ? "" : fmt::format("{:.10g}", value); }

/// With as many digits as tell it from others.
std::string parameter_text(double value) { return std::isnan(value) ? "" : fmt::format("{}", value); }

/// A column of parameters: numbers, or texts where a member has another value than a number.
struct ParameterColumn {
  std::string name, unit;
  std::vector<std::string> texts;  ///< by member, as they stand in the CSV file
  std::vector<double> numbers;     ///< of numbers; of texts: which of `choices`
  std::vector<std::string> choices;
};

bool is_list_of_numbers(const Node& node, std::size_t length) {
  return node.type == Type::list && node.children.size() == length &&
         std::all_of(node.children.begin(), node.children.end(), [](const Node& one) { return one.is_number(); });
}

bool said_nowhere(const Node& node) { return node.type == Type::text && node.text.empty(); }

ParameterColumn column_of(const std::string& name, const std::string& unit, const std::vector<const Node*>& values) {
  ParameterColumn column{name, unit, {}, {}, {}};
  const bool numbers =
      std::all_of(values.begin(), values.end(), [](const Node* one) { return one->is_number() || said_nowhere(*one); });
  for (const Node* value : values) {
    if (numbers) {
      column.numbers.push_back(value->is_number() ? value->number : no_number);
      column.texts.push_back(parameter_text(column.numbers.back()));
      continue;
    }
    const std::string text = value->type == Type::text ? value->text : case_file::toml_text(*value);
    auto found = std::find(column.choices.begin(), column.choices.end(), text);
    if (found == column.choices.end()) found = column.choices.insert(column.choices.end(), text);
    column.numbers.push_back(static_cast<double>(found - column.choices.begin()));
    column.texts.push_back(text);
  }
  if (!numbers) column.unit = "1";
  return column;
}

/// Of several keys one may be an entry of another, which says the same.
void add_once(ParameterColumn column, std::vector<ParameterColumn>& columns) {
  const bool known =
      std::any_of(columns.begin(), columns.end(), [&](const ParameterColumn& one) { return one.name == column.name; });
  if (!known) columns.push_back(std::move(column));
}

/// A list of numbers, such as a velocity, makes a column of each entry that differs.
void add_columns(const Study& study, std::size_t p, std::vector<ParameterColumn>& columns) {
  std::vector<const Node*> values;
  for (const Member& member : study.members) values.push_back(&member.values[p]);
  const Parameter& parameter = study.parameters[p];
  const std::size_t length = values.front()->children.size();
  if (length == 0 ||
      !std::all_of(values.begin(), values.end(), [&](const Node* one) { return is_list_of_numbers(*one, length); })) {
    add_once(column_of(parameter.key, parameter.unit, values), columns);
    return;
  }
  for (std::size_t i = 0; i < length; ++i) {
    std::vector<const Node*> entries;
    for (const Node* value : values) entries.push_back(&value->children[i]);
    const bool differs = std::any_of(entries.begin(), entries.end(),
                                     [&](const Node* one) { return one->number != entries.front()->number; });
    if (differs) add_once(column_of(fmt::format("{}[{}]", parameter.key, i), parameter.unit, entries), columns);
  }
}

struct FigureColumn {
  std::string name, unit;
  std::vector<double> values;
};

struct Contents {
  std::vector<ParameterColumn> parameters;
  std::vector<MemberRow> rows;
  std::vector<FigureColumn> figures;
};

/// Of a member without a row: what its last attempt came to.
MemberRow unfinished(const Member& member) {
  MemberRow row;
  const std::string last = last_attempt(member);
  const auto says = [&](const char* text) { return last.find(text) != std::string::npos; };
  if (last.empty()) return row;
  row.reason = last;
  row.status = says("killed by") || says("interrupted") || says("stopped with") ? Status::killed
               : says("failed") || says("could not be collected")               ? Status::failed
                                                                                : Status::not_run;
  if (row.status == Status::not_run) row.reason = "begun, not ended";
  return row;
}

Contents contents_of(const Study& study) {
  Contents contents;
  for (std::size_t p = 0; p < study.parameters.size(); ++p) add_columns(study, p, contents.parameters);
  const std::string key = study.figures.key();
  for (const Member& member : study.members) {
    contents.rows.push_back(read_row(member).value_or(unfinished(member)));
    MemberRow& row = contents.rows.back();
    if (row.status == Status::completed && row.figures_key != key) {
      row = unfinished(member);
      if (row.status == Status::not_run) row.reason = "other figures were asked for when it ran: sweep again";
    }
  }
  for (const Figure& figure : study.figures.figures) {
    FigureColumn column{figure.name, "", {}};
    for (const MemberRow& row : contents.rows) {
      const auto found = std::find_if(row.figures.begin(), row.figures.end(),
                                      [&](const FigureValue& one) { return one.name == figure.name; });
      column.values.push_back(found == row.figures.end() ? no_number : found->value);
      if (found != row.figures.end()) column.unit = found->unit;
    }
    if (column.unit.empty()) column.unit = "1";
    contents.figures.push_back(column);
  }
  return contents;
}

std::string heading(const std::string& name, const std::string& unit) {
  return csv_text(unit == "1" ? name : name + " [" + unit + ']');
}

std::string csv_of(const Study& study, const Contents& contents) {
  std::string text = csv_mark;
  for (const auto& column : contents.parameters) text += ',' + heading(column.name, column.unit);
  text += ",status,reason";
  for (const auto& column : contents.figures) text += ',' + heading(column.name, column.unit);
  text += '\n';
  for (std::size_t m = 0; m < study.members.size(); ++m) {
    text += fmt::format("{}", study.members[m].number);
    for (const auto& column : contents.parameters) text += ',' + csv_text(column.texts[m]);
    const MemberRow& row = contents.rows[m];
    text += fmt::format(",{},{}", status_names[static_cast<int>(row.status)], csv_text(row.reason));
    for (const auto& column : contents.figures) text += ',' + number_text(column.values[m]);
    text += '\n';
  }
  return text;
}

void write_column(const hdf5::Group& group, const std::string& name, const std::string& unit,
                  const std::vector<double>& values) {
  group.write(name, values, {values.size()}, unit);
}

void write_hdf5(const Study& study, const Contents& contents) {
  hdf5::File file = hdf5::File::create(study.table_hdf5(), hdf5_kind());
  const hdf5::Group root = file.root();
  root.set_attribute("format_version", 1L);
  root.set_attribute("title", study.title);
  root.set_attribute("study", study.path);
  root.set_attribute("case", study.case_file);
  root.set_attribute("status_names", std::vector<std::string>(std::begin(status_names), std::end(status_names)));
  std::vector<std::string> folders, reasons;
  std::vector<double> numbers, status;
  for (std::size_t m = 0; m < study.members.size(); ++m) {
    numbers.push_back(study.members[m].number);
    folders.push_back(std::filesystem::path(study.members[m].folder).filename().string());
    status.push_back(static_cast<double>(contents.rows[m].status));
    reasons.push_back(contents.rows[m].reason);
  }
  root.set_attribute("folders", folders);
  root.set_attribute("reasons", reasons);
  write_column(root, "member", "1", numbers);
  write_column(root, "status", "1", status);
  const hdf5::Group parameters = root.create_group("parameters"), figures = root.create_group("figures");
  for (const auto& column : contents.parameters) {
    write_column(parameters, column.name, column.unit, column.numbers);
    if (!column.choices.empty()) parameters.set_attribute(column.name, column.choices);
  }
  for (const auto& column : contents.figures) write_column(figures, column.name, column.unit, column.values);
  file.close();
}

MemberLock wait_for_lock(const std::string& path) {
  for (;;) {
    if (auto lock = MemberLock::take(path)) return std::move(*lock);
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
}

/// Throws InputError where something else has a table's name.
void expect_no_other(const std::string& path, const FileKind& kind) {
  std::error_code failed;
  if (fs::exists(path, failed) && !is_of_kind(path, kind))
    throw InputError(fmt::format("{} is {}, not the table of a sweep: move it away, or give the study another folder",
                                 path, seems_to_be(path)));
}

}  // namespace

void check_tables(const Study& study) {
  expect_no_other(study.table_csv(), csv_kind());
  expect_no_other(study.table_hdf5(), hdf5_kind());
  if (!is_of_kind(study.table_hdf5(), hdf5_kind())) return;
  const auto root = hdf5::read_root_attributes(study.table_hdf5());
  const std::string other = root ? root->text("study") : "";
  std::error_code failed;
  if (other.empty() || !fs::exists(other, failed) || fs::equivalent(other, study.path, failed) || failed) return;
  throw InputError(
      fmt::format("{} is the table of another study, {}: give this one another folder by 'folder = ...', or move the "
                  "tables of that one away",
                  study.table_hdf5(), other));
}

void write_tables(const Study& study) {
  check_tables(study);
  fs::create_directories(study.folder);
  const MemberLock lock = wait_for_lock(study.folder + "/sweep.lock");
  // One sweep at a time; what a killed one left has no name yet.
  for (const auto& entry : fs::directory_iterator(study.folder))
    if (const std::string name = entry.path().filename().string();
        name.rfind("sweep.csv.new", 0) == 0 || name.rfind("sweep.h5.new", 0) == 0)
      fs::remove(entry.path());
  const Contents contents = contents_of(study);
  write_whole_file(study.table_csv(), csv_of(study, contents), csv_kind());
  write_hdf5(study, contents);
}

}  // namespace railwave::sweep
