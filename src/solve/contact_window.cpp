#include "solve/contact_window.hpp"

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "model/host_copy.hpp"

namespace railwave {
namespace {

/// The window reaches this many of the largest segment's diagonals beyond a segment: the relative motion that it allows.
constexpr double margin_in_segments = 0.5;
/// Longest life of a window, in steps.
constexpr long longest_life = 2000;
/// Relative speed may grow by this factor within a window's life before a node could be missed.
constexpr double speed_reserve = 2.0;

struct GatherRows {
  Array<const double* [3]> values;
  Array<const int*> rows;
  Array<double* [3]> result;
  KOKKOS_INLINE_FUNCTION void operator()(const int i) const {
    for (int k = 0; k < 3; ++k) result(i, k) = values(rows(i), k);
  }
};

Array<double* [3]>::HostMirror rows_to_host(const Array<double* [3]>& values, const Array<int*>& rows) {
  const auto result = unset_array<double* [3]>("rows", rows.extent(0));
  Kokkos::parallel_for("gather_rows", Range(0, rows.extent(0)), GatherRows{values, rows, result});
  return to_host(result);
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

double fastest(const Rows& velocity, const std::vector<int>& rows) {
  double squared = 0;
  for (int i : rows)
    squared = std::max(squared, velocity(i, 0) * velocity(i, 0) + velocity(i, 1) * velocity(i, 1) + velocity(i, 2) * velocity(i, 2));
  return std::sqrt(squared);
}

std::vector<int> all_rows(const Rows& rows) {
  std::vector<int> all(rows.extent(0));
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = static_cast<int>(i);
  return all;
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

}  // namespace

void lay_out_window(Model& model, ContactPair& pair, const Instant& instant) {
  const ContactArrays& contact = pair.arrays;
  const Rows slaves = rows_to_host(model.nodes.position, contact.slave_nodes);
  const Rows masters = rows_to_host(model.nodes.position, contact.master_nodes);
  const Rows slave_velocity = rows_to_host(model.nodes.velocity, contact.slave_nodes);
  const Rows master_velocity = rows_to_host(model.nodes.velocity, contact.master_nodes);

  const double margin = margin_in_segments * pair.segment_size;
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

  // Every slave outside is at least `reach` from every master node, so more than `margin` from touching.
  const double speed = speed_reserve * (fastest(slave_velocity, all_rows(slave_velocity)) +
                                        fastest(master_velocity, all_rows(master_velocity)));
  // Velocities of a relaxation are per unit of pseudo-time, one step.
  const double moved = speed * (instant.settling ? 1.0 : instant.step);
  long life = moved > 0 ? static_cast<long>(std::min<double>(margin / moved, longest_life)) : longest_life;
  // From rest, speeds are not known yet.
  if (model.step < 100 || instant.settling) life = std::min(life, 20L);
  pair.window_until = model.step + std::max(life, 1L);
}

}  // namespace railwave
