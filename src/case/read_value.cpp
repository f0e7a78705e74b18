#include "case/read_value.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "case/plausible.hpp"
#include "case/suggest.hpp"

namespace railwave::case_file {
namespace {

/// Reads one value; each member function returns nothing once it has complained.
class Reader {
 public:
  Reader(const Key& key, const Complain& complain, const Complain& remark)
      : key_(key), complain_(complain), remark_(remark) {}

  std::optional<Value> read(const Node& node) const {
    switch (key_.kind) {
      case Kind::absent:
        return std::nullopt;
      case Kind::boolean:
        return node.type == Node::Type::boolean ? std::optional<Value>(node.boolean) : wrong(node);
      case Kind::integer:
        return as_value(integer(node, ""));
      case Kind::number:
        return as_value(number(node, ""));
      case Kind::text:
        return text(node);
      case Kind::choice:
        return choice(node);
      case Kind::vector:
        return vector(node);
      case Kind::integer_vector:
        return integer_vector(node);
      case Kind::axes:
        return axes(node);
      case Kind::directions:
        return directions(node);
      case Kind::texts:
        return texts(node);
      case Kind::pairs:
        return pairs(node);
      case Kind::numbers:
        return numbers(node);
      case Kind::integer_pair:
        return integer_pair(node);
      case Kind::box:
        return box(node);
    }
    return std::nullopt;
  }

 private:
  template <class T>
  static std::optional<Value> as_value(const std::optional<T>& read) {
    return read ? std::optional<Value>(*read) : std::nullopt;
  }

  std::nullopt_t bad(const Node& node, const std::string& text) const {
    complain_(node.where, text);
    return std::nullopt;
  }

  std::nullopt_t wrong(const Node& node) const {
    const bool short_list = node.type == Node::Type::list &&
                            (key_.kind == Kind::vector || key_.kind == Kind::integer_vector ||
                             key_.kind == Kind::axes || key_.kind == Kind::integer_pair || key_.kind == Kind::box);
    const auto is = short_list
                        ? fmt::format("has {} value{}", node.children.size(), node.children.size() == 1 ? "" : "s")
                        : "is " + node.described();
    return bad(node, is + ", must be " + expectation(key_));
  }

  /// `which` names a component: "its x".
  std::optional<double> number(const Node& node, const std::string& which) const {
    const std::string& unit = key_.unit;
    const auto is = which.empty() ? std::string("is") : which + " is";
    if (!node.is_number())
      return bad(node,
                 fmt::format("{} {}, must be a number{}", is, node.described(), unit.empty() ? "" : " in " + unit));
    if (!std::isfinite(node.number))
      return bad(node,
                 fmt::format("{} {}, must be a finite number{}", is, node.number, unit.empty() ? "" : " in " + unit));
    const Range allowed = key_.range.has(node.number) ? allowed_range(key_) : key_.range;
    if (!allowed.has(node.number))
      return bad(node, fmt::format("{} {}, must be {}{}{}", is, node.number, range_text(allowed),
                                   unit.empty() ? "" : " " + unit, unit_hint(key_, node.number)));
    if (const double least = least_beside_zero(key_); node.number != 0 && std::fabs(node.number) < least)
      return bad(node, fmt::format("{} {}, must be 0 or at least {}{}{}", is, node.number, least,
                                   unit.empty() ? "" : " ", unit));
    if (!is_usual(key_, node.number))
      remark_(node.where, (which.empty() ? "" : which + " ") + oddity(key_, node.number));
    return node.number;
  }

  std::optional<int> integer(const Node& node, const std::string& which) const {
    const auto is = which.empty() ? std::string("is") : which + " is";
    if (!node.is_number()) return bad(node, fmt::format("{} {}, must be a whole number", is, node.described()));
    if (!(std::floor(node.number) == node.number))
      return bad(node, fmt::format("{} {}, must be a whole number", is, node.number));
    const auto checked = number(node, which);
    if (!checked) return std::nullopt;
    if (std::fabs(*checked) > std::numeric_limits<int>::max()) {
      return bad(node, fmt::format("{} {}, must be at most {}", is, *checked, std::numeric_limits<int>::max()));
    }
    return static_cast<int>(*checked);
  }

  std::optional<Value> text(const Node& node) const {
    if (node.type != Node::Type::text) return wrong(node);
    if (!key_.choices.empty() && !chosen(node)) return std::nullopt;
    const auto initial = key_.initial();
    const bool may_be_empty = !key_.required && std::get<std::string>(initial).empty();
    if (node.text.empty() && !may_be_empty) return bad(node, "is empty, must be " + expectation(key_));
    return node.text;
  }

  /// Position among the choices.
  std::optional<int> chosen(const Node& node) const {
    const auto found = std::find(key_.choices.begin(), key_.choices.end(), node.text);
    if (found != key_.choices.end()) return static_cast<int>(found - key_.choices.begin());
    const auto near = nearest_name(node.text, key_.choices);
    return bad(node, fmt::format("is '{}', must be {}{}", printable(node.text), alternatives(key_.choices),
                                 near.empty() ? "" : "; did you mean '" + near + "'?"));
  }

  std::optional<Value> choice(const Node& node) const {
    if (node.type != Node::Type::text) return wrong(node);
    const auto position = chosen(node);
    if (!position) return std::nullopt;
    return Choice{*position};
  }

  std::optional<Numbers3> components(const Node& node, const std::string& of) const {
    if (node.type != Node::Type::list || node.children.size() != 3) return wrong(node);
    Numbers3 result{};
    bool good = true;
    for (std::size_t i = 0; i < 3; ++i) {
      const auto one = number(node.children[i], fmt::format("{}{}", of, "xyz"[i]));
      if (one) result[i] = *one;
      good = good && one;
    }
    return good ? std::optional<Numbers3>(result) : std::nullopt;
  }

  std::optional<Value> vector(const Node& node) const {
    auto result = components(node, "");
    if (!result || !key_.is_direction) return as_value(result);
    const double length = std::hypot((*result)[0], (*result)[1], (*result)[2]);
    if (!(length > 0) || !std::isfinite(length))
      return bad(node, fmt::format("has length {}, must be a direction such as [0, 0, 1]", length));
    for (auto& one : *result) one /= length;
    return *result;
  }

  std::optional<Value> integer_vector(const Node& node) const {
    if (node.type != Node::Type::list || node.children.size() != 3) return wrong(node);
    Integers3 result{};
    bool good = true;
    for (std::size_t i = 0; i < 3; ++i) {
      const auto one = integer(node.children[i], std::string(1, "xyz"[i]));
      if (one) result[i] = *one;
      good = good && one;
    }
    return good ? std::optional<Value>(result) : std::nullopt;
  }

  std::optional<Value> integer_pair(const Node& node) const {
    if (node.type != Node::Type::list || node.children.size() != 2) return wrong(node);
    const auto first = integer(node.children[0], "the first"), second = integer(node.children[1], "the second");
    return first && second ? std::optional<Value>(Integers2{*first, *second}) : std::nullopt;
  }

  std::optional<Value> box(const Node& node) const {
    if (node.type != Node::Type::list || node.children.size() != 2) return wrong(node);
    const auto low = components(node.children[0], "lowest "), high = components(node.children[1], "highest ");
    if (!low || !high) return std::nullopt;
    for (std::size_t i = 0; i < 3; ++i)
      if ((*low)[i] > (*high)[i])
        return bad(node,
                   fmt::format("begins at {} = {} and ends at {}; the first corner is the lowest in all directions",
                               "xyz"[i], (*low)[i], (*high)[i]));
    return Corners{*low, *high};
  }

  std::optional<Value> numbers(const Node& node) const {
    if (node.type != Node::Type::list) return wrong(node);
    if (node.children.empty()) return bad(node, "is empty, must be " + expectation(key_));
    Numbers result;
    for (std::size_t i = 0; i < node.children.size(); ++i) {
      const auto one = number(node.children[i], fmt::format("entry {}", i + 1));
      if (!one) return std::nullopt;
      result.push_back(*one);
    }
    return result;
  }

  std::optional<Value> axes(const Node& node) const {
    if (node.type != Node::Type::list || node.children.size() != 3) return wrong(node);
    Axes result{};
    for (std::size_t i = 0; i < 3; ++i) {
      const auto one = components(node.children[i], fmt::format("axis {}, ", i + 1));
      if (!one) return std::nullopt;
      result[i] = *one;
    }
    return orthonormal(node, result) ? std::optional<Value>(result) : std::nullopt;
  }

  bool orthonormal(const Node& node, const Axes& axes) const {
    constexpr double tolerance = 1e-6;
    const auto dot = [](const Numbers3& a, const Numbers3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; };
    for (std::size_t i = 0; i < 3; ++i) {
      const double length = std::hypot(axes[i][0], axes[i][1], axes[i][2]);
      if (!(std::fabs(length - 1) <= tolerance))
        return bad(node, fmt::format("axis {} has length {:.7g}, must be 1", i + 1, length)), false;
    }
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t j = (i + 1) % 3;
      const double cosine = dot(axes[i], axes[j]);
      if (!(std::fabs(cosine) <= tolerance)) {
        return bad(node, fmt::format("axes {} and {} must be perpendicular; the cosine of their angle is {:.3g}", i + 1,
                                     j + 1, cosine)),
               false;
      }
    }
    const auto &a = axes[0], &b = axes[1];
    const Numbers3 third{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
    if (dot(third, axes[2]) < 0)
      return bad(node, "axes are left-handed; turn one of them round, so that the third is first x second"), false;
    return true;
  }

  std::optional<Value> directions(const Node& node) const {
    if (node.type != Node::Type::list) return wrong(node);
    if (node.children.empty()) return bad(node, "is empty, must be " + expectation(key_));
    Flags3 result{};
    bool good = true;
    for (const auto& child : node.children) {
      const auto position = child.type == Node::Type::text && child.text.size() == 1
                                ? std::string("xyz").find(child.text)
                                : std::string::npos;
      if (position == std::string::npos) {
        const auto has = child.type == Node::Type::text ? "'" + printable(child.text) + "'" : child.described();
        complain_(child.where, "has " + has + ", may only have 'x', 'y' and 'z'");
        good = false;
      } else if (result[position]) {
        complain_(child.where, "has '" + child.text + "' twice");
        good = false;
      } else {
        result[position] = true;
      }
    }
    return good ? std::optional<Value>(result) : std::nullopt;
  }

  std::optional<Value> texts(const Node& node) const {
    if (key_.may_be_one && node.type == Node::Type::text) {
      if (node.text.empty()) return bad(node, "is empty, must be " + expectation(key_));
      return Texts{node.text};
    }
    if (node.type != Node::Type::list) return wrong(node);
    if (key_.required && node.children.empty()) return bad(node, "is empty, must be " + expectation(key_));
    Texts result;
    bool good = true;
    for (const auto& child : node.children) {
      if (child.type != Node::Type::text) {
        complain_(child.where, "has " + child.described() + ", must be " + expectation(key_));
        good = false;
      } else if (std::find(result.begin(), result.end(), child.text) != result.end()) {
        complain_(child.where, "has '" + printable(child.text) + "' twice");
        good = false;
      } else {
        if (!key_.choices.empty() && !chosen(child)) good = false;
        result.push_back(child.text);
      }
    }
    return good ? std::optional<Value>(result) : std::nullopt;
  }

  /// Each number of a pair has a unit and a range of its own.
  std::optional<double> of_pair(const Node& node, std::size_t pair, const std::string& what, const Range& range) const {
    if (!node.is_number())
      return bad(node, fmt::format("the {} of pair {} is {}, must be a number", what, pair, node.described()));
    if (!std::isfinite(node.number))
      return bad(node, fmt::format("the {} of pair {} is {}, must be a finite number", what, pair, node.number));
    if (!range.has(node.number))
      return bad(node, fmt::format("the {} of pair {} is {}, must be {}", what, pair, node.number, range_text(range)));
    return node.number;
  }

  std::optional<Value> pairs(const Node& node) const {
    if (node.type != Node::Type::list) return wrong(node);
    if (node.children.empty()) return bad(node, "is empty, must be " + expectation(key_));
    Pairs result;
    for (std::size_t i = 0; i < node.children.size(); ++i) {
      const auto& child = node.children[i];
      if (child.type != Node::Type::list || child.children.size() != 2)
        return bad(child, fmt::format("entry {} must be a pair [{}, {}]", i + 1, key_.pair.first, key_.pair.second));
      const auto first = of_pair(child.children[0], i + 1, key_.pair.first, key_.pair.first_range);
      const auto second = of_pair(child.children[1], i + 1, key_.pair.second, key_.pair.second_range);
      if (!first || !second) return std::nullopt;
      result.push_back({*first, *second});
    }
    return result;
  }

  const Key& key_;
  const Complain& complain_;
  const Complain& remark_;
};

}  // namespace

std::optional<Value> read_value(const Key& key, const Node& node, const Complain& complain, const Complain& remark) {
  return Reader(key, complain, remark).read(node);
}

}  // namespace railwave::case_file
