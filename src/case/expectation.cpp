#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "case/read_value.hpp"

namespace railwave::case_file {
namespace {

bool finite(double limit) {
  return limit > -std::numeric_limits<double>::max() && limit < std::numeric_limits<double>::max();
}

std::string written(const std::string& text) { return "\"" + text + "\""; }

std::string written(const Numbers3& vector) { return fmt::format("[{}, {}, {}]", vector[0], vector[1], vector[2]); }

struct Written {
  const Key& key;
  std::string operator()(std::monostate) const { return ""; }
  std::string operator()(bool flag) const { return flag ? "true" : "false"; }
  std::string operator()(int number) const { return fmt::format("{}", number); }
  std::string operator()(double number) const { return fmt::format("{}", number); }
  std::string operator()(const std::string& text) const { return text.empty() ? "" : written(text); }
  std::string operator()(Choice choice) const {
    return written(key.choices.at(static_cast<std::size_t>(choice.position)));
  }
  std::string operator()(const Numbers3& vector) const { return written(vector); }
  std::string operator()(const Integers3& vector) const {
    return fmt::format("[{}, {}, {}]", vector[0], vector[1], vector[2]);
  }
  std::string operator()(const Axes& axes) const {
    return fmt::format("[{}, {}, {}]", written(axes[0]), written(axes[1]), written(axes[2]));
  }
  std::string operator()(const Flags3&) const { return "[]"; }
  std::string operator()(const Texts&) const { return "[]"; }
  std::string operator()(const Pairs&) const { return "[]"; }
  std::string operator()(const Numbers&) const { return "[]"; }
  std::string operator()(const Integers2& pair) const { return fmt::format("[{}, {}]", pair[0], pair[1]); }
  std::string operator()(const Corners& box) const { return fmt::format("[{}, {}]", written(box[0]), written(box[1])); }
};

}  // namespace

std::string alternatives(const std::vector<std::string>& choices) {
  std::string text;
  for (std::size_t i = 0; i < choices.size(); ++i) {
    text += (i == 0 ? "" : i + 1 == choices.size() ? " or " : ", ") + ("'" + choices[i] + "'");
  }
  return text;
}

std::string range_text(const Range& range) {
  // 1e+18 rather than its digits.
  const auto written_limit = [](double limit) {
    return std::abs(limit) >= 1e6 ? fmt::format("{:g}", limit) : fmt::format("{}", limit);
  };
  const auto low_limit = written_limit(range.low), high_limit = written_limit(range.high);
  const auto low = fmt::format("{} {}", range.low_open ? "above" : "at least", low_limit);
  const auto high = fmt::format("{} {}", range.high_open ? "below" : "at most", high_limit);
  if (finite(range.low) && finite(range.high)) {
    return !range.low_open && !range.high_open ? fmt::format("between {} and {}", low_limit, high_limit)
                                               : low + " and " + high;
  }
  return finite(range.low) ? low : finite(range.high) ? high : "";
}

std::string default_text(const Key& key) {
  if (!key.default_text.empty()) return key.default_text;
  return key.required ? "" : std::visit(Written{key}, key.initial());
}

std::string expectation(const Key& key, bool with_unit) {
  const auto unit = key.unit.empty() || !with_unit ? "" : " in " + key.unit;
  const bool named = key.refers_to != refers_to_nothing;
  switch (key.kind) {
    case Kind::absent:
      return "";
    case Kind::boolean:
      return "true or false";
    case Kind::integer:
      return "a whole number" + unit;
    case Kind::number:
      return "a number" + unit;
    case Kind::text:
      return !key.choices.empty() ? alternatives(key.choices)
             : key.is_path        ? "a file name in quotes"
             : named              ? "a name in quotes"
                                  : "text in quotes";
    case Kind::choice:
      return alternatives(key.choices);
    case Kind::vector:
      return "three numbers [x, y, z]" + unit;
    case Kind::integer_vector:
      return "three whole numbers [x, y, z]" + unit;
    case Kind::axes:
      return "three unit vectors [[x, y, z], [x, y, z], [x, y, z]]";
    case Kind::directions:
      return "a list of directions such as [\"x\", \"z\"]";
    case Kind::texts:
      return !key.choices.empty() ? "a list of " + alternatives(key.choices)
             : key.may_be_one     ? "a name in quotes or a list of such"
             : named              ? "a list of names in quotes"
                                  : "a list of texts";
    case Kind::pairs:
      return fmt::format("a list of pairs [[{}, {}], ...]", key.pair.first, key.pair.second);
    case Kind::numbers:
      return "a list of numbers" + unit;
    case Kind::integer_pair:
      return "two whole numbers";
    case Kind::box:
      return "a box [[x, y, z], [x, y, z]], lowest corner first" + unit;
  }
  return "";
}

}  // namespace railwave::case_file
