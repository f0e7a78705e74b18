#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "mesh/files/dyna_lines.hpp"

namespace railwave {

/// The parameters of a deck (*PARAMETER, *PARAMETER_EXPRESSION, both also _LOCAL): names that stand for numbers where
/// a field is "&name" or "-&name". Names do not tell case.
class DynaParameters {
 public:
  explicit DynaParameters(const DynaLines& lines) : lines_(lines) {}

  /// Whether the keyword is one of those; its definitions are taken then. Throws InputError for one that can't be read.
  bool take(const DynaKeyword& keyword);

  /// Whether a field is "&name", "-&name" or "<expression>".
  static bool is_use(std::string_view field) {
    return !field.empty() &&
           (field[0] == '&' || field.substr(0, 2) == "-&" || (field[0] == '<' && field.back() == '>'));
  }

  /// The number that such a field stands for. Throws InputError where it is not defined.
  double value(std::string_view field, const FilePlace& place) const;

  std::size_t size() const { return values_.size(); }

 private:
  struct Parameter {
    double value;
    FilePlace place;
  };
  void define(std::string_view head, std::string_view value, const DynaKeyword& keyword, const FilePlace& place);
  void define_expression(const DynaLine& line, const DynaKeyword& keyword);
  double evaluate(std::string_view text, const FilePlace& place) const;
  const Parameter* find(const std::string& name, int file) const;

  const DynaLines& lines_;
  std::map<std::pair<int, std::string>, Parameter> values_;  // by file, -1 of those that hold everywhere
};

/// A number as decks have it: also without the exponent's letter, "1.5-3". Nothing when it is none, or too large.
std::optional<double> parse_dyna_real(std::string_view text);

}  // namespace railwave
