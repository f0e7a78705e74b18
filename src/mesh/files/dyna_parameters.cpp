#include "mesh/files/dyna_parameters.hpp"

#include <fmt/format.h>

#include <cmath>
#include <functional>

#include "case/error.hpp"
#include "mesh/files/text_file.hpp"

namespace railwave {
namespace {

constexpr int everywhere = -1;
constexpr int deepest_expression = 50;

bool is_name_letter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
}

/// Arithmetic of *PARAMETER_EXPRESSION: + - * / ** ( ), functions and names. Throws std::string, what is wrong.
class Expression {
 public:
  using Lookup = std::function<double(const std::string&)>;
  Expression(std::string_view text, Lookup lookup) : rest_(text), lookup_(std::move(lookup)) {}

  double value() {
    const double result = sum();
    skip();
    if (!rest_.empty()) throw fmt::format("'{}' is left over", for_message(rest_));
    return result;
  }

 private:
  void skip() {
    while (!rest_.empty() && (rest_.front() == ' ' || rest_.front() == '\t')) rest_.remove_prefix(1);
  }
  bool take(std::string_view sign) {
    skip();
    if (rest_.substr(0, sign.size()) != sign) return false;
    rest_.remove_prefix(sign.size());
    return true;
  }
  bool next_is_power() const { return rest_.substr(0, 2) == "**"; }

  double sum() {
    if (++depth_ > deepest_expression) throw std::string("it is nested too deeply");
    double result = product();
    while (true) {
      if (take("+"))
        result += product();
      else if (take("-"))
        result -= product();
      else
        break;
    }
    --depth_;
    return result;
  }
  double product() {
    double result = power();
    while (true) {
      skip();
      if (!next_is_power() && take("*"))
        result *= power();
      else if (take("/"))
        result /= power();
      else
        return result;
    }
  }
  double power() {
    if (++depth_ > deepest_expression) throw std::string("it is nested too deeply");
    const bool negative = take("-");
    if (!negative) take("+");
    double result = operand();
    if (take("**")) result = std::pow(result, power());
    --depth_;
    return negative ? -result : result;
  }
  double operand() {
    if (take("(")) {
      const double result = sum();
      if (!take(")")) throw std::string("a ')' is missing");
      return result;
    }
    skip();
    if (rest_.empty()) throw std::string("it ends where a number is expected");
    const char first = rest_.front();
    if ((first >= '0' && first <= '9') || first == '.') return number();
    take("&");
    std::size_t length = 0;
    while (length < rest_.size() && is_name_letter(rest_[length])) ++length;
    if (length == 0) throw fmt::format("'{}' is no number, name or '('", for_message(rest_));
    const std::string name = lower_case(rest_.substr(0, length));
    rest_.remove_prefix(length);
    return take("(") ? function(name) : lookup_(name);
  }
  double number() {
    std::size_t length = 0;
    const auto digits = [&] {
      while (length < rest_.size() && rest_[length] >= '0' && rest_[length] <= '9') ++length;
    };
    digits();
    if (length < rest_.size() && rest_[length] == '.') ++length;
    digits();
    if (length < rest_.size() && std::string_view("eEdD").find(rest_[length]) != std::string_view::npos) {
      ++length;
      if (length < rest_.size() && (rest_[length] == '+' || rest_[length] == '-')) ++length;
      digits();
    }
    const auto value = parse_real(rest_.substr(0, length));
    if (!value) throw fmt::format("'{}' is no number", for_message(rest_.substr(0, length)));
    rest_.remove_prefix(length);
    return *value;
  }
  double function(const std::string& name) {
    const double a = sum();
    const bool two = take(",");
    const double b = two ? sum() : 0;
    if (!take(")")) throw std::string("a ')' is missing");
    if (two) {
      if (name == "min") return std::fmin(a, b);
      if (name == "max") return std::fmax(a, b);
      if (name == "mod") return std::fmod(a, b);
      if (name == "atan2") return std::atan2(a, b);
    } else {
      static const std::map<std::string, double (*)(double)> all = {{"sqrt", std::sqrt},
                                                                    {"abs", std::fabs},
                                                                    {"exp", std::exp},
                                                                    {"log", std::log},
                                                                    {"log10", std::log10},
                                                                    {"sin", std::sin},
                                                                    {"cos", std::cos},
                                                                    {"tan", std::tan},
                                                                    {"asin", std::asin},
                                                                    {"acos", std::acos},
                                                                    {"atan", std::atan},
                                                                    {"sinh", std::sinh},
                                                                    {"cosh", std::cosh},
                                                                    {"tanh", std::tanh},
                                                                    {"int", std::trunc},
                                                                    {"aint", std::trunc},
                                                                    {"nint", std::round},
                                                                    {"anint", std::round},
                                                                    {"float", [](double x) { return x; }}};
      const auto found = all.find(name);
      if (found != all.end()) return found->second(a);
    }
    throw fmt::format("there is no function {}() of {} here", name, two ? "two numbers" : "one number");
  }

  std::string_view rest_;
  Lookup lookup_;
  int depth_ = 0;
};

}  // namespace

std::optional<double> parse_dyna_real(std::string_view text) {
  if (const auto plain = parse_real(text)) return plain;
  const auto sign = text.find_last_of("+-");
  if (sign == std::string_view::npos || sign == 0) return std::nullopt;
  const char before = text[sign - 1];
  if (before != '.' && (before < '0' || before > '9')) return std::nullopt;
  return parse_real(std::string(text.substr(0, sign)) + "e" + std::string(text.substr(sign)));
}

bool DynaParameters::take(const DynaKeyword& keyword) {
  const std::string& name = keyword.name;
  if (name == "PARAMETER" || name == "PARAMETER_LOCAL") {
    for (const DynaLine& line : keyword.lines) {
      const bool free = line.text.find(',') != std::string_view::npos;
      std::string_view rest = line.text;
      while (!trim(rest).empty()) {
        const auto next = [&] {
          const auto width = keyword.format == DynaFormat::twenty ? std::size_t(20) : std::size_t(10);
          const auto length = free ? std::min(rest.find(','), rest.size()) : std::min(width, rest.size());
          const auto field = trim(rest.substr(0, length));
          rest.remove_prefix(std::min(length + (free ? 1 : 0), rest.size()));
          return field;
        };
        const auto head = next(), value = next();
        if (!head.empty()) define(head, value, keyword, line.place);
      }
    }
    return true;
  }
  if (name == "PARAMETER_EXPRESSION" || name == "PARAMETER_EXPRESSION_LOCAL") {
    for (const DynaLine& line : keyword.lines)
      if (!trim(line.text).empty()) define_expression(line, keyword);
    return true;
  }
  return false;
}

void DynaParameters::define(std::string_view head, std::string_view value, const DynaKeyword& keyword,
                            const FilePlace& place) {
  const auto where = lines_.where(place);
  const std::string name = lower_case(trim(head.substr(1)));
  const char type = lower_case(head.substr(0, 1))[0];
  if (name.empty() || (type != 'r' && type != 'i' && type != 'c'))
    throw InputError(
        fmt::format("{} '{}' is no name of a parameter; write R (a number) or I (a whole number) and the "
                    "name",
                    where, for_message(head)));
  if (type == 'c') return;  // a text: where it is used, that field is refused
  double number = 0;
  if (is_use(value)) {
    number = this->value(value, place);
  } else {
    const auto read = parse_dyna_real(value);
    if (!read)
      throw InputError(
          fmt::format("{} parameter {}: '{}' is no number; fields have ten columns, or commas between them", where,
                      for_message(name), for_message(value)));
    number = *read;
  }
  if (type == 'i') number = std::trunc(number);
  const bool local = keyword.name.find("_LOCAL") != std::string::npos;
  // As LS-DYNA does by default, the first definition holds.
  values_.try_emplace({local ? place.file : everywhere, name}, Parameter{number, place});
}

void DynaParameters::define_expression(const DynaLine& line, const DynaKeyword& keyword) {
  const auto comma = line.text.find(',');
  const auto width = keyword.format == DynaFormat::twenty ? std::size_t(20) : std::size_t(10);
  const bool free = comma != std::string_view::npos && comma < width;
  const auto end = free ? comma : std::min(width, line.text.size());
  const auto head = trim(line.text.substr(0, end));
  const auto text = trim(line.text.substr(std::min(end + (free ? 1 : 0), line.text.size())));
  if (!head.empty()) define(head, fmt::format("{}", evaluate(text, line.place)), keyword, line.place);
}

double DynaParameters::evaluate(std::string_view text, const FilePlace& place) const {
  double number = 0;
  try {
    number = Expression(text, [&](const std::string& name) {
               const Parameter* known = find(name, place.file);
               if (!known) throw fmt::format("there is no parameter {}", for_message(name));
               return known->value;
             }).value();
  } catch (const std::string& wrong) {
    throw InputError(fmt::format("{} the expression '{}' can't be read: {}; write the number itself",
                                 lines_.where(place), for_message(text), wrong));
  }
  if (!std::isfinite(number))
    throw InputError(
        fmt::format("{} the expression '{}' gives no finite number; mend it", lines_.where(place), for_message(text)));
  return number;
}

const DynaParameters::Parameter* DynaParameters::find(const std::string& name, int file) const {
  // A local one holds in its file and in those that this includes.
  for (int scope = file; scope != everywhere; scope = lines_.includer(scope))
    if (const auto found = values_.find({scope, name}); found != values_.end()) return &found->second;
  const auto found = values_.find({everywhere, name});
  return found == values_.end() ? nullptr : &found->second;
}

double DynaParameters::value(std::string_view field, const FilePlace& place) const {
  if (field.front() == '<') return evaluate(trim(field.substr(1, field.size() - 2)), place);
  const bool negative = field.front() == '-';
  field.remove_prefix(negative ? 2 : 1);
  const std::string name = lower_case(trim(field));
  const Parameter* known = find(name, place.file);
  if (!known)
    throw InputError(
        fmt::format("{} there is no parameter '{}' (of a number) before this line; define it by *PARAMETER",
                    lines_.where(place), for_message(name)));
  return negative ? -known->value : known->value;
}

}  // namespace railwave
