#include "solve/contact_window.hpp"

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "model/host_copy.hpp"

namespace railwave {
namespace {

/// The window reaches this many of the largest segment's diagonals beyond a segment: the relative motion that it allows.
constexpr double margin_in_segments = 0.5;
/// Steps between looks at how far the surfaces have moved since the window was laid out.
constexpr long steps_between_looks = 20;
/// Share of the margin that may be used up at a look; the rest is for the steps until the next one.
constexpr double usable_margin = 0.5;

struct GatherRows {
  Array<const double* [3]> values;
  Array<const int*> rows;
  Array<double* [3]> result;
  KOKKOS_INLINE_FUNCTION void operator()(const int i) const {
    for (int k = 0; k < 3; ++k) result(i, k) = values(rows(i), k);
  }
};

Array<double* [3]> rows_of(const Array<double* [3]>& values, const Array<int*>& rows) {
  const auto result = unset_array<double* [3]>("rows", rows.extent(0));
  Kokkos::parallel_for("gather_rows", Range(0, rows.extent(0)), GatherRows{values, rows, result});
  return result;
}

using Rows = Array<double* [3]>::HostMirror;

/// Points in cubic cells, for finding those near a place.
class CellGrid {
 public:
  CellGrid(const Rows& points, double cell) : points_(points), cell_(cell) {
    for (int i = 0; i < static_cast<int>(points.extent(0)); ++i) cells_[key(index(i, 0), index(i, 1), index(i, 2))].push_back(i);
  }

  /// Calls found(i, squared distance) for every point within `reach` (at most one cell) of (x, y, z).
  template <class Found>
  void near(const double (&x)[3], double reach, const Found& found) const {
    long c[3];
    for (int k = 0; k < 3; ++k) c[k] = static_cast<long>(std::floor(x[k] / cell_));
    for (long i = c[0] - 1; i <= c[0] + 1; ++i)
      for (long j = c[1] - 1; j <= c[1] + 1; ++j)
        for (long k = c[2] - 1; k <= c[2] + 1; ++k) {
          const auto cell = cells_.find(key(i, j, k));
          if (cell == cells_.end()) continue;
          for (int p : cell->second) {
            const double dx = points_(p, 0) - x[0], dy = points_(p, 1) - x[1], dz = points_(p, 2) - x[2];
            const double squared = dx * dx + dy * dy + dz * dz;
            if (squared <= reach * reach) found(p, squared);
          }
        }
  }

 private:
  long index(int i, int k) const { return static_cast<long>(std::floor(points_(i, k) / cell_)); }
  /// 21 bits an index: different cells never share a key, so that no point is found twice.
  static long key(long i, long j, long k) {
    constexpr long mask = (1L << 21) - 1;
    return (i & mask) | (j & mask) << 21 | (k & mask) << 42;
  }

  Rows points_;
  double cell_;
  std::unordered_map<long, std::vector<int>> cells_;
};

/// Largest squared distance of a surface's nodes from where they were.
struct SquaredMotion {
  Array<const double* [3]> position;
  Array<const int*> nodes;
  Array<const double* [3]> before;
  KOKKOS_INLINE_FUNCTION void operator()(const int i, double& largest) const {
    const Vector3 moved = row(position, nodes(i)) - row(before, i);
    const double squared = dot(moved, moved);
    // A NaN counts as far: kept as NaN it would be lost, and with it the motions before it, at the next comparison.
    if (!(squared <= largest)) largest = squared < 1e300 ? squared : 1e300;
  }
};

double farthest(const Array<double* [3]>& position, const Array<int*>& nodes, const Array<double* [3]>& before) {
  double squared = 0;
  Kokkos::parallel_reduce("window_motion", Range(0, nodes.extent(0)), SquaredMotion{position, nodes, before},
                          Kokkos::Max<double>(squared));
  return std::sqrt(squared);
}

/// A node that leaves the window is apart; its arrays must say so.
struct ClearOutside {
  ContactArrays contact;
  Array<const int*> inside;
  KOKKOS_INLINE_FUNCTION void operator()(const int s) const {
    if (inside(s) != 0) return;
    contact.segment(s) = -1;
    contact.status(s) = status_apart;
    contact.gap(s) = 1e300;
    for (int k = 0; k < 3; ++k) contact.normal_force(s, k) = contact.tangential_force(s, k) = 0;
  }
};

void lay_out_window(Model& model, ContactPair& pair, double margin) {
  const ContactArrays& contact = pair.arrays;
  pair.slaves_at_layout = rows_of(model.nodes.position, contact.slave_nodes);
  pair.masters_at_layout = rows_of(model.nodes.position, contact.master_nodes);
  const Rows slaves = to_host(pair.slaves_at_layout), masters = to_host(pair.masters_at_layout);

  // A slave's projection lies on a segment whose corners are at most a diagonal away from it.
  const double reach = pair.segment_size + 2 * margin;
  const CellGrid grid(masters, reach);

  std::vector<int> window, nearest(contact.slave_count, 0), inside(contact.slave_count, 0);
  std::vector<std::vector<int>> candidates(contact.master_count);
  for (int s = 0; s < contact.slave_count; ++s) {
    const double x[3] = {slaves(s, 0), slaves(s, 1), slaves(s, 2)};
    double least = reach * reach * 1.01;
    grid.near(x, reach, [&](int m, double squared) {
      if (squared < least || (squared == least && m < nearest[s])) {
        least = squared;
        nearest[s] = m;
      }
      candidates[m].push_back(s);
    });
    if (least > reach * reach) continue;
    window.push_back(s);
    inside[s] = 1;
  }

  std::vector<int> loaded, first{0}, listed;
  for (int m = 0; m < contact.master_count; ++m) {
    if (candidates[m].empty()) continue;
    loaded.push_back(m);
    listed.insert(listed.end(), candidates[m].begin(), candidates[m].end());
    first.push_back(static_cast<int>(listed.size()));
  }
  pair.window.slave_count = static_cast<int>(window.size());
  pair.window.master_count = static_cast<int>(loaded.size());
  pair.window.slaves = to_device("window slaves", window);
  pair.window.masters = to_device("window masters", loaded);
  pair.window.first = to_device("window first", first);
  pair.window.candidates = to_device("window candidates", listed);
  Kokkos::deep_copy(contact.closest, to_device("nearest", nearest));
  Kokkos::parallel_for("clear_outside", Range(0, contact.slave_count),
                       ClearOutside{contact, to_device("inside window", inside)});
  Kokkos::deep_copy(contact.master_force, 0.0);
}

}  // namespace

void keep_window(Model& model, ContactPair& pair) {
  if (model.step < pair.next_look) return;
  pair.next_look = model.step + steps_between_looks;
  // A slave outside is at least a segment and two margins from every master node, so more than a margin from touching.
  const double margin = margin_in_segments * pair.segment_size;
  if (pair.slaves_at_layout.extent(0) != 0) {
    const double moved = farthest(model.nodes.position, pair.arrays.slave_nodes, pair.slaves_at_layout) +
                         farthest(model.nodes.position, pair.arrays.master_nodes, pair.masters_at_layout);
    if (moved < usable_margin * margin) return;
  }
  lay_out_window(model, pair, margin);
  ++pair.layouts;
}

}  // namespace railwave
