#pragma once

#include <array>
#include <string>
#include <variant>
#include <vector>

/// The kinds of values that a key of the case file can have, as they go from the file into the scene.
namespace railwave::case_file {

using Numbers3 = std::array<double, 3>;
using Integers3 = std::array<int, 3>;
using Integers2 = std::array<int, 2>;
using Corners = std::array<Numbers3, 2>;
using Axes = std::array<Numbers3, 3>;
using Flags3 = std::array<bool, 3>;
using Texts = std::vector<std::string>;
using Numbers = std::vector<double>;
using Pairs = std::vector<std::array<double, 2>>;

/// A choice of an enum: its position in the key's list of choices.
struct Choice {
  int position = 0;
};

/// In the order of Value's alternatives. A default that is absent (std::optional) is monostate.
enum class Kind {
  absent,
  boolean,
  integer,
  number,
  text,
  choice,
  vector,
  integer_vector,
  axes,
  directions,
  texts,
  pairs,
  numbers,
  integer_pair,
  box
};

using Value = std::variant<std::monostate, bool, int, double, std::string, Choice, Numbers3, Integers3, Axes, Flags3,
                           Texts, Pairs, Numbers, Integers2, Corners>;

}  // namespace railwave::case_file
