#include <algorithm>
#include <limits>
#include <numeric>
#include <unordered_map>
#include <utility>

#include "model/elements/block_order.hpp"
#include "model/elements/edge_groups.hpp"

namespace railwave {
namespace {

constexpr int row_length = elements_of_group, line_length = row_length + 1;
using Row = std::array<int, row_length>;
using Line = std::array<int, line_length>;

/// Rows of elements along one direction, by sheets: in each they lie side by side, across faces.
using Sheet = std::vector<Row>;
struct Sheets {
  std::vector<Sheet> sheet;
  std::size_t rows = 0;
};

constexpr int rows_of_block = elements_of_block / row_length;
/// A row and its like share lines of nodes, so many of which have room in a block.
constexpr int lines_of_block = nodes_of_block / line_length;
/// Sheets of fewer rows would leave many small blocks.
constexpr std::size_t least_of_sheet = rows_of_block;

class RowFinder {
 public:
  RowFinder(const TurnedElements& turned, int direction)
      : turned_(turned), direction_(direction), taken_(turned.next.size(), 0) {}

  Sheets find() {
    Sheets sheets;
    for (std::size_t e = 0; e < taken_.size(); ++e) {
      Row row;
      if (taken_[e] != 0 || !take_row(static_cast<int>(e), row)) continue;
      Sheet sheet = spread(row);
      if (sheet.size() < least_of_sheet) continue;
      sheets.rows += sheet.size();
      sheets.sheet.push_back(std::move(sheet));
    }
    return sheets;
  }

 private:
  bool free(int e) const { return e != no_element && taken_[e] == 0; }

  /// The neighbour at a side, where the rows' direction is xi.
  int next(int e, int side) const { return turned_.next[e][side_along(direction_, side)]; }

  /// Takes the free elements along xi before and behind one, if they make a row.
  bool take_row(int e, Row& row) {
    std::vector<int> found{e};
    taken_[e] = 1;
    for (const int side : {xi_below, xi_above})
      for (int at = next(e, side); free(at) && found.size() < row_length; at = next(at, side)) {
        taken_[at] = 1;
        found.insert(side == xi_below ? found.begin() : found.end(), at);
      }
    if (found.size() == row_length) {
      std::copy(found.begin(), found.end(), row.begin());
      return true;
    }
    for (int at : found) taken_[at] = 0;
    return false;
  }

  /// All rows beside one, and beside those.
  Sheet spread(const Row& row) {
    Sheet sheet{row};
    for (std::size_t k = 0; k < sheet.size(); ++k)
      for (int side = first_side_across; side < element_sides; ++side) {
        Row beside;
        if (take_beside(sheet[k], side, beside)) sheet.push_back(beside);
      }
    return sheet;
  }

  /// Takes the free elements at one side of a row's, where they are a row.
  bool take_beside(const Row& row, int side, Row& beside) {
    for (int k = 0; k < row_length; ++k) {
      beside[k] = next(row[k], side);
      const bool goes_on = k == 0 || next(beside[k - 1], xi_above) == beside[k];
      if (free(beside[k]) && goes_on && std::find(beside.begin(), beside.begin() + k, beside[k]) == beside.begin() + k)
        continue;
      return false;
    }
    for (int e : beside) taken_[e] = 1;
    return true;
  }

  const TurnedElements& turned_;
  const int direction_;
  std::vector<char> taken_;
};

struct HashLine {
  std::size_t operator()(const Line& line) const {
    std::size_t hash = 0;
    for (int n : line) hash = 1000003 * hash + static_cast<std::size_t>(n);
    return hash;
  }
};

/// Elements in rows along one direction of theirs.
struct AlignedElements {
  const Assembly& assembly;
  const std::vector<int>& element;        ///< numbers in the assembly; rows have places among them
  const std::vector<std::uint8_t>& turn;  ///< of each, see TurnedElements
  int direction;

  CornerNodes corners(int e) const { return turned(turned(assembly.elements[element[e]], turn[e]), direction); }
};

/// A sheet's rows as elements of an assembly of their own, between the ends of their lines of nodes.
Assembly assembly_of_rows(const AlignedElements& aligned, const Sheet& sheet) {
  constexpr int lower[4] = {0, 3, 4, 7}, upper[4] = {1, 2, 5, 6};
  Assembly rows;
  std::unordered_map<Line, int, HashLine> known;
  for (const Row& row : sheet) {
    Line lines[4];
    for (int at = 0; at < row_length; ++at) {
      const CornerNodes element = aligned.corners(row[at]);
      for (int k = 0; k < 4; ++k) {
        lines[k][at] = element[lower[k]];
        lines[k][at + 1] = element[upper[k]];
      }
    }
    CornerNodes corners{};
    for (int k = 0; k < 4; ++k) {
      const auto [found, is_new] = known.try_emplace(lines[k], static_cast<int>(rows.nodes.size()));
      if (is_new) {
        rows.nodes.push_back(aligned.assembly.nodes[lines[k].front()]);
        rows.nodes.push_back(aligned.assembly.nodes[lines[k].back()]);
      }
      corners[lower[k]] = found->second;
      corners[upper[k]] = found->second + 1;
    }
    rows.elements.push_back(corners);
  }
  return rows;
}

/// Divides a sheet into blocks: its rows in their order, and where each block begins among them.
void divide_sheet(const Assembly& rows, std::vector<int>& order, std::vector<int>& first) {
  const BlockLimits limits{rows_of_block, 2 * lines_of_block};
  const int count = static_cast<int>(rows.elements.size());
  order.resize(count);
  std::iota(order.begin(), order.end(), 0);
  std::vector<int> grown = order, first_grown;
  halve_into_blocks(rows, order, 0, count, first, limits);
  if (static_cast<int>(first.size()) * rows_of_block < count + rows_of_block) return;
  grow_blocks(rows, grown, 0, count, first_grown, limits);
  if (first_grown.size() >= first.size()) return;
  order = std::move(grown);
  first = std::move(first_grown);
}

/// Rows along one direction, the one with the most.
int gather_along_one(const Assembly& assembly, std::vector<int>& elements, int begin, int end,
                     std::vector<int>& first) {
  const std::vector<int> element(elements.begin() + begin, elements.begin() + end);
  TurnedElements turned = turned_elements(assembly.elements, element);
  Sheets best;
  int best_direction = 0;
  for (int direction = 0; direction < 3 && best.rows * row_length < element.size(); ++direction) {
    Sheets sheets = RowFinder(turned, direction).find();
    if (sheets.rows <= best.rows) continue;
    best = std::move(sheets);
    best_direction = direction;
  }
  turned.next = {};  // the most that there is beside the mesh
  const AlignedElements aligned{assembly, element, turned.turn, best_direction};
  std::vector<char> gathered(element.size(), 0);
  int next = begin;
  for (const Sheet& sheet : best.sheet) {
    std::vector<int> order, first_row;
    divide_sheet(assembly_of_rows(aligned, sheet), order, first_row);
    for (int row : first_row) first.push_back(next + row_length * row);
    for (int row : order)
      for (int e : sheet[row]) {
        gathered[e] = 1;
        elements[next++] = element[e];
      }
  }
  const int left = next;
  for (std::size_t e = 0; e < element.size(); ++e)
    if (gathered[e] == 0) elements[next++] = element[e];
  return left;
}

}  // namespace

int gather_rows(const Assembly& assembly, std::vector<int>& elements, int begin, int end, std::vector<int>& first) {
  // Sides have numbers, see turned_elements().
  if (end - begin > std::numeric_limits<int>::max() / element_sides) return begin;
  // What is left over may have rows along another direction.
  for (int from = begin;; begin = from) {
    from = gather_along_one(assembly, elements, begin, end, first);
    if (from == begin || from == end) return from;
  }
}

}  // namespace railwave
