#include "model/elements/edge_groups.hpp"

#include <algorithm>
#include <deque>

#include "mesh/hexahedron.hpp"
#include "model/elements/number_range.hpp"

namespace railwave {
namespace {

using Sides = std::array<int, element_sides>;

/// Corners of an element's sides, and the corner behind each: which is the neighbour's corner there, where that is
/// turned alike. The first and the third of a side lie across from each other.
constexpr int side_corner[element_sides][4] = {{0, 3, 7, 4}, {1, 2, 6, 5}, {0, 1, 5, 4},
                                               {3, 2, 6, 7}, {0, 1, 2, 3}, {4, 5, 6, 7}};
constexpr int side_behind[element_sides][4] = {{1, 2, 6, 5}, {0, 3, 7, 4}, {3, 2, 6, 7},
                                               {0, 1, 5, 4}, {4, 5, 6, 7}, {0, 1, 2, 3}};

/// The ways to number an element's corners that keep it right-handed, by corner 0 and the edge that is xi.
constexpr int turns = 24;

struct Turns {
  int corner[turns][8];            ///< of each turn: the elements' own corners, by corner as turned
  int side[turns][element_sides];  ///< of each turn: the element's own sides, by side as turned
  /// By side as turned: the turn by which own corners are the first two of side_behind.
  std::uint8_t by_corners[element_sides][8][8];

  Turns() {
    // A corner's place as bits: whether it is above in xi, eta, zeta.
    int place[8], corner_at[8];
    for (int N = 0; N < 8; ++N) {
      place[N] = 0;
      for (int i = 0; i < 3; ++i) place[N] |= (hexahedron_corner_signs[N][i] > 0 ? 1 : 0) << i;
      corner_at[place[N]] = N;
    }
    for (int origin = 0; origin < 8; ++origin)
      for (int first = 0; first < 3; ++first)
        for (int N = 0; N < 8; ++N) {
          int at = place[origin];
          for (int i = 0; i < 3; ++i)
            if ((place[N] >> i & 1) != 0)
              at ^= place[origin] ^ place[hexahedron_corner_neighbours[origin][(first + i) % 3]];
          corner[3 * origin + first][N] = corner_at[at];
        }
    std::fill_n(&by_corners[0][0][0], sizeof(by_corners), std::uint8_t{0});
    for (int turn = 0; turn < turns; ++turn)
      for (int s = 0; s < element_sides; ++s) {
        const int(&own)[8] = corner[turn];
        by_corners[s][own[side_behind[s][0]]][own[side_behind[s][1]]] = static_cast<std::uint8_t>(turn);
        for (int k = 0; k < element_sides; ++k) {
          const auto has = [&](int N) {
            return std::find(side_corner[k], side_corner[k] + 4, N) != side_corner[k] + 4;
          };
          if (has(own[side_corner[s][0]]) && has(own[side_corner[s][2]])) side[turn][s] = k;
        }
      }
  }
};

const Turns& table() {
  static const Turns all;
  return all;
}

/// A side's nodes, in an order that is the same from both of its elements: the lowest, the one across from it, and the
/// other two. Sides with the same nodes are the same.
struct SideNodes {
  int lowest, across, less, more;

  SideNodes(const CornerNodes& corners, int side) {
    const int* at = side_corner[side];
    int k = 0;
    for (int other = 1; other < 4; ++other)
      if (corners[at[other]] < corners[at[k]]) k = other;
    lowest = corners[at[k]];
    across = corners[at[k ^ 2]];
    less = corners[at[k ^ 1]];
    more = corners[at[k ^ 3]];
    if (less > more) std::swap(less, more);
  }
  bool operator==(const SideNodes& other) const {
    return lowest == other.lowest && across == other.across && less == other.less && more == other.more;
  }
};

/// The neighbours of each element by its own sides, as places in `elements`.
std::vector<Sides> neighbours(const std::vector<CornerNodes>& mesh, const std::vector<int>& elements) {
  const int count = static_cast<int>(elements.size());
  std::vector<Sides> next(count);
  // Sides whose neighbour was not met yet lie in lists by their lowest node. Until it is, the place of the neighbour
  // holds the next side of the list, so that lists take no memory.
  constexpr int none = -1;
  ValuesOfRange<int> first(node_range(mesh, elements, 0, count), none);
  const auto place = [&](int side) -> int& { return next[side / element_sides][side % element_sides]; };
  for (int e = 0; e < count; ++e)
    for (int s = 0; s < element_sides; ++s) {
      const SideNodes nodes(mesh[elements[e]], s);
      int* at = &first[nodes.lowest];
      while (*at != none && !(*at / element_sides != e &&
                              SideNodes(mesh[elements[*at / element_sides]], *at % element_sides) == nodes))
        at = &place(*at);
      const int met = *at;
      if (met == none) {
        next[e][s] = first[nodes.lowest];
        first[nodes.lowest] = element_sides * e + s;
        continue;
      }
      *at = place(met);
      place(met) = e;
      next[e][s] = met / element_sides;
    }
  // The outside.
  for (int e = 0; e < count; ++e)
    for (int n : mesh[elements[e]])
      while (first[n] != none) {
        int& side = place(first[n]);
        first[n] = side;
        side = no_element;
      }
  return next;
}

/// The turn by which an element is turned like the one that has this side in common with it; any, if none is.
int turn_like(const CornerNodes& corners, const CornerNodes& neighbour, int side) {
  const auto place_of = [&](int N) {
    return std::find(corners.begin(), corners.end() - 1, neighbour[N]) - corners.begin();
  };
  return table().by_corners[side][place_of(side_corner[side][0])][place_of(side_corner[side][1])];
}

/// @param corners of one element as turned
/// @param other corners of the one at its side, and how it is turned
bool turned_alike(const CornerNodes& corners, int side, const CornerNodes& other, int turn) {
  const int(&own)[8] = table().corner[turn];
  for (int k = 0; k < 4; ++k)
    if (corners[side_corner[side][k]] != other[own[side_behind[side][k]]]) return false;
  return true;
}

}  // namespace

CornerNodes turned(const CornerNodes& corners, int turn) {
  CornerNodes result;
  for (int N = 0; N < 8; ++N) result[N] = corners[table().corner[turn][N]];
  return result;
}

TurnedElements turned_elements(const std::vector<CornerNodes>& mesh, const std::vector<int>& elements) {
  constexpr std::uint8_t not_yet = turns;
  const int count = static_cast<int>(elements.size());
  TurnedElements result{std::vector<std::uint8_t>(count, not_yet), neighbours(mesh, elements)};
  std::deque<int> queue;
  for (int seed = 0; seed < count; ++seed) {
    if (result.turn[seed] != not_yet) continue;
    result.turn[seed] = 0;
    for (queue.push_back(seed); !queue.empty(); queue.pop_front()) {
      const int e = queue.front();
      const CornerNodes corners = turned(mesh[elements[e]], result.turn[e]);
      const Sides own = result.next[e];
      for (int side = 0; side < element_sides; ++side) {
        const int other = own[table().side[result.turn[e]][side]];
        result.next[e][side] = no_element;
        if (other == no_element) continue;
        if (result.turn[other] == not_yet) {
          result.turn[other] = static_cast<std::uint8_t>(turn_like(mesh[elements[other]], corners, side));
          queue.push_back(other);
        }
        if (turned_alike(corners, side, mesh[elements[other]], result.turn[other])) result.next[e][side] = other;
      }
    }
  }
  return result;
}

}  // namespace railwave
