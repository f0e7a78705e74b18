#include "model/elements/edge_groups.hpp"

#include <algorithm>

#include "mesh/hexahedron.hpp"

namespace railwave {
namespace {

using Corners = std::array<int, 8>;
using Sides = std::array<int, element_sides>;

/// Corners of an element's sides, and the corner behind each: which is the neighbour's corner there, where that is
/// turned alike. The first and the third of a side lie across from each other.
constexpr int side_corner[element_sides][4] = {{0, 3, 7, 4}, {1, 2, 6, 5}, {0, 1, 5, 4},
                                               {3, 2, 6, 7}, {0, 1, 2, 3}, {4, 5, 6, 7}};
constexpr int side_behind[element_sides][4] = {{1, 2, 6, 5}, {0, 3, 7, 4}, {3, 2, 6, 7},
                                               {0, 1, 5, 4}, {4, 5, 6, 7}, {0, 1, 2, 3}};

/// The ways to number an element's corners that keep it right-handed, by corner 0 and the edge that is xi.
constexpr int turns = 24;

std::array<Corners, turns> all_turns() {
  // A corner's place as bits: whether it is above in xi, eta, zeta.
  int place[8], corner_at[8];
  for (int N = 0; N < 8; ++N) {
    place[N] = 0;
    for (int i = 0; i < 3; ++i) place[N] |= (hexahedron_corner_signs[N][i] > 0 ? 1 : 0) << i;
    corner_at[place[N]] = N;
  }
  std::array<Corners, turns> all{};
  for (int origin = 0; origin < 8; ++origin)
    for (int first = 0; first < 3; ++first)
      for (int N = 0; N < 8; ++N) {
        int at = place[origin];
        for (int i = 0; i < 3; ++i)
          if ((place[N] >> i & 1) != 0)
            at ^= place[origin] ^ place[hexahedron_corner_neighbours[origin][(first + i) % 3]];
        all[3 * origin + first][N] = corner_at[at];
      }
  return all;
}

const std::array<Corners, turns>& turn_table() {
  static const std::array<Corners, turns> all = all_turns();
  return all;
}

Corners turned(const Corners& corners, int turn) {
  Corners result;
  for (int N = 0; N < 8; ++N) result[N] = corners[turn_table()[turn][N]];
  return result;
}

int place_of(const Corners& corners, int node) {
  return static_cast<int>(std::find(corners.begin(), corners.end(), node) - corners.begin());
}

/// Turns an element so that it is turned like the one that has this side in common with it.
Corners turned_like(const Corners& corners, const Corners& neighbour, int side) {
  int place[4];
  for (int k = 0; k < 4; ++k) place[k] = place_of(corners, neighbour[side_corner[side][k]]);
  for (int turn = 0; turn < turns; ++turn) {
    const Corners& table = turn_table()[turn];
    bool fits = true;
    for (int k = 0; k < 4; ++k) fits = fits && table[side_behind[side][k]] == place[k];
    if (fits) return turned(corners, turn);
  }
  return corners;
}

bool turned_alike(const Corners& a, const Corners& b, int side) {
  for (int k = 0; k < 4; ++k)
    if (a[side_corner[side][k]] != b[side_behind[side][k]]) return false;
  return true;
}

/// Elements around each node, as rows.
struct Around {
  std::vector<int> first, element;

  Around(const std::vector<Corners>& elements, int nodes) : first(nodes + 1, 0), element(8 * elements.size()) {
    for (const Corners& corners : elements)
      for (int n : corners) ++first[n + 1];
    for (int n = 0; n < nodes; ++n) first[n + 1] += first[n];
    std::vector<int> filled(first.begin(), first.end() - 1);
    for (std::size_t e = 0; e < elements.size(); ++e)
      for (int n : elements[e]) element[filled[n]++] = static_cast<int>(e);
  }
};

/// The other element that has a side of one in common with it.
int beside(const std::vector<Corners>& elements, const Around& around, int e, const Corners& corners, int side) {
  const int n = corners[side_corner[side][0]];
  for (int k = around.first[n]; k < around.first[n + 1]; ++k) {
    const int other = around.element[k];
    if (other == e) continue;
    bool shared = true;
    for (int c = 1; c < 4 && shared; ++c) shared = place_of(elements[other], corners[side_corner[side][c]]) < 8;
    if (shared) return other;
  }
  return no_element;
}

}  // namespace

TurnedElements turned_elements(const std::vector<Corners>& elements, int nodes, int direction) {
  const Around around(elements, nodes);
  const int count = static_cast<int>(elements.size());
  Sides none;
  none.fill(no_element);
  TurnedElements result{elements, std::vector<Sides>(elements.size(), none)};
  std::vector<char> seen(count, 0);
  std::vector<int> queue;
  for (int seed = 0; seed < count; ++seed) {
    if (seen[seed] != 0) continue;
    seen[seed] = 1;
    result.corners[seed] = turned(elements[seed], direction);
    queue.assign(1, seed);
    for (std::size_t k = 0; k < queue.size(); ++k) {
      const int e = queue[k];
      const Corners& corners = result.corners[e];
      for (int side = 0; side < element_sides; ++side) {
        const int other = beside(elements, around, e, corners, side);
        if (other == no_element) continue;
        if (seen[other] == 0) {
          seen[other] = 1;
          result.corners[other] = turned_like(elements[other], corners, side);
          queue.push_back(other);
        }
        if (turned_alike(corners, result.corners[other], side)) result.next[e][side] = other;
      }
    }
  }
  return result;
}

}  // namespace railwave
