#pragma once

#include <cstdint>
#include <initializer_list>
#include <limits>
#include <string_view>
#include <vector>

#include "mesh/files/dyna_parameters.hpp"

namespace railwave {

/// Largest number that nodes, elements, parts and so on may have here.
inline constexpr std::int64_t largest_dyna_number = std::numeric_limits<std::int32_t>::max();

/// What fields need besides their line: where it is, and what parameters stand for.
struct DynaReading {
  const DynaLines& lines;
  const DynaParameters& parameters;
};

/// One card (a data line), taken to fields: by commas, or by columns. Empty fields are 0.
class DynaCard {
 public:
  /// A card of fields of ten columns each, or of twenty in the long format.
  DynaCard(const DynaReading& reading, const DynaLine& line, const DynaKeyword& keyword);

  /// A card of fields of other widths: columns of the standard format, those of I10, whether it is a number of a thing
  /// (see DynaFormat).
  struct Width {
    int standard, ten;
  };
  DynaCard(const DynaReading& reading, const DynaLine& line, const DynaKeyword& keyword,
           std::initializer_list<Width> widths);

  bool blank(int field) const { return text(field).empty(); }
  bool blank() const;

  /// How many fields hold something, counted to the last that does.
  int count() const;
  std::string_view text(int field) const;

  /// Throw InputError naming the place and the field where that is no number, or beyond `largest`.
  std::int64_t whole(int field, const char* name) const;
  double real(int field, const char* name) const;
  double real(int field, const char* name, double if_blank_or_zero) const;

  const FilePlace& place() const { return line_.place; }

 private:
  void take_columns(const std::vector<std::size_t>& widths);
  double number(int field, const char* name) const;
  const DynaReading& reading_;
  const DynaLine& line_;
  std::vector<std::string_view> fields_;
  std::vector<char> cut_;  // fields whose number seems to go on beyond their columns
};

/// Whole numbers of eight columns, reals of sixteen: cards of *NODE and *ELEMENT.
inline constexpr DynaCard::Width dyna_number{8, 10}, dyna_coordinate{16, 16}, dyna_code{8, 8}, dyna_point{20, 20};

}  // namespace railwave
