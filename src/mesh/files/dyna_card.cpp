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

}  // namespace

DynaCard::DynaCard(const DynaReading& reading, const DynaLine& line, const DynaKeyword& keyword)
    : reading_(reading), line_(line) {
  if (line.text.find(',') != std::string_view::npos) {
    split_at_commas(line.text, fields_);
    return;
  }
  const auto width = static_cast<std::size_t>(keyword.format == DynaFormat::twenty ? long_width : usual_width);
  for (std::string_view rest = line.text; !rest.empty(); rest.remove_prefix(std::min(width, rest.size())))
    fields_.push_back(trim(rest.substr(0, width)));
}

DynaCard::DynaCard(const DynaReading& reading, const DynaLine& line, const DynaKeyword& keyword,
                   std::initializer_list<Width> widths)
    : reading_(reading), line_(line) {
  if (line.text.find(',') != std::string_view::npos) {
    split_at_commas(line.text, fields_);
    return;
  }
  std::string_view rest = line.text;
  for (const Width& of : widths) {
    const int columns = keyword.format == DynaFormat::twenty ? long_width
                        : keyword.format == DynaFormat::ten  ? of.ten
                                                             : of.standard;
    const auto width = std::min(static_cast<std::size_t>(columns), rest.size());
    fields_.push_back(trim(rest.substr(0, width)));
    rest.remove_prefix(width);
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
  if (text[0] == '&' || text.substr(0, 2) == "-&") return reading_.parameters.value(text, line_.place);
  const auto value = parse_dyna_real(text);
  if (value) return *value;
  const bool tab = line_.text.find('\t') != std::string_view::npos;
  throw InputError(fmt::format("{} field {} ({}): '{}' is no number; {}", reading_.lines.where(line_.place), field + 1,
                               name, for_message(text),
                               tab ? "there are tabs in this line: put blanks in their place, or commas between fields"
                                   : "mend it, see whether each field is in its columns, or put commas between fields"));
}

std::int64_t DynaCard::whole(int field, const char* name) const {
  const std::string_view text = this->text(field);
  const auto plain = parse_integer(text);
  const double value = plain ? static_cast<double>(*plain) : number(field, name);
  if (std::floor(value) != value || std::fabs(value) > static_cast<double>(largest_dyna_number))
    throw InputError(fmt::format("{} field {} ({}): '{}' is no whole number up to {}; mend it, see whether each field "
                                 "is in its columns",
                                 reading_.lines.where(line_.place), field + 1, name, for_message(text),
                                 largest_dyna_number));
  return static_cast<std::int64_t>(value);
}

double DynaCard::real(int field, const char* name) const { return number(field, name); }

double DynaCard::real(int field, const char* name, double if_blank_or_zero) const {
  const double value = number(field, name);
  return value == 0 ? if_blank_or_zero : value;
}

}  // namespace railwave
