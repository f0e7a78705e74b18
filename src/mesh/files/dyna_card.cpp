#include "mesh/files/dyna_card.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "case/error.hpp"
#include "mesh/files/text_file.hpp"

namespace railwave {
namespace {

constexpr int long_width = 20;
constexpr int usual_width = 10;

void split_at_commas(std::string_view line, std::vector<std::string_view>& fields) {
  while (true) {
    const auto comma = line.find(',');
    fields.push_back(trim(line.substr(0, comma)));
    if (comma == std::string_view::npos) return;
    line.remove_prefix(comma + 1);
  }
}

bool is_free(std::string_view line) { return line.find(',') != std::string_view::npos; }

}  // namespace

DynaCard::DynaCard(const DynaReading& reading, const DynaLine& line, const DynaKeyword& keyword)
    : reading_(reading), line_(line) {
  const auto width = static_cast<std::size_t>(keyword.format == DynaFormat::twenty ? long_width : usual_width);
  if (is_free(line.text)) {
    split_at_commas(line.text, fields_);
    return;
  }
  std::vector<std::size_t> widths((line.text.size() + width - 1) / width, width);
  take_columns(widths);
}

DynaCard::DynaCard(const DynaReading& reading, const DynaLine& line, const DynaKeyword& keyword,
                   std::initializer_list<Width> widths)
    : reading_(reading), line_(line) {
  if (is_free(line.text)) {
    split_at_commas(line.text, fields_);
    return;
  }
  std::vector<std::size_t> columns;
  for (const Width& of : widths)
    columns.push_back(static_cast<std::size_t>(keyword.format == DynaFormat::twenty ? long_width
                                               : keyword.format == DynaFormat::ten  ? of.ten
                                                                                    : of.standard));
  take_columns(columns);
}

void DynaCard::take_columns(const std::vector<std::size_t>& widths) {
  std::string_view rest = line_.text;
  std::string_view before;
  for (const std::size_t width : widths) {
    const std::string_view whole = rest.substr(0, width);
    // "    0.0001" one column too far right is 0.000 and 1. Fields that fill their columns may stand side by side.
    const bool goes_on = !before.empty() && !whole.empty() && before.front() == ' ' && before.back() != ' ' &&
                         std::string_view("0123456789.eE+-").find(whole.front()) != std::string_view::npos &&
                         (whole.size() < width || whole.back() == ' ') && width <= long_width;
    if (goes_on) cut_.back() = 1;
    fields_.push_back(trim(whole));
    cut_.push_back(0);
    before = whole;
    rest.remove_prefix(whole.size());
  }
}

bool DynaCard::blank() const {
  return std::all_of(fields_.begin(), fields_.end(), [](std::string_view field) { return field.empty(); });
}

int DynaCard::count() const {
  int count = static_cast<int>(fields_.size());
  while (count > 0 && fields_[count - 1].empty()) --count;
  return count;
}

std::string_view DynaCard::text(int field) const {
  return field < static_cast<int>(fields_.size()) ? fields_[field] : std::string_view();
}

double DynaCard::number(int field, const char* name) const {
  const std::string_view text = this->text(field);
  if (text.empty()) return 0;
  if (field < static_cast<int>(cut_.size()) && cut_[field] != 0)
    throw InputError(
        fmt::format("{} field {} ({}): '{}' goes on beyond the columns of its field; move it, or put commas "
                    "between fields",
                    reading_.lines.where(line_.place), field + 1, name, for_message(text)));
  if (DynaParameters::is_use(text)) return reading_.parameters.value(text, line_.place);
  const auto value = parse_dyna_real(text);
  if (value) return *value;
  const bool tab = line_.text.find('\t') != std::string_view::npos;
  throw InputError(fmt::format(
      "{} field {} ({}): '{}' is no number; {}", reading_.lines.where(line_.place), field + 1, name, for_message(text),
      tab ? "there are tabs in this line: put blanks in their place, or commas between fields"
          : "mend it, see whether each field is in its columns, or put commas between fields"));
}

std::int64_t DynaCard::whole(int field, const char* name) const {
  const std::string_view text = this->text(field);
  const double value = number(field, name);
  if (std::floor(value) != value || std::fabs(value) > static_cast<double>(largest_dyna_number))
    throw InputError(
        fmt::format("{} field {} ({}): '{}' is no whole number up to {}; mend it, see whether each field "
                    "is in its columns",
                    reading_.lines.where(line_.place), field + 1, name, for_message(text), largest_dyna_number));
  return static_cast<std::int64_t>(value);
}

double DynaCard::real(int field, const char* name) const { return number(field, name); }

double DynaCard::real(int field, const char* name, double if_blank_or_zero) const {
  const double value = number(field, name);
  return value == 0 ? if_blank_or_zero : value;
}

}  // namespace railwave
