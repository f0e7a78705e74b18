#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "kernels/contact/near_nodes.hpp"
#include "model/contact/surface_motion.hpp"
#include "model/contact/surface_rows.hpp"
#include "model/lent_array.hpp"
#include "solve/tasks.hpp"

namespace railwave {
namespace {

/// The window reaches this many of the largest segment's diagonals beyond a segment.
constexpr double margin_in_segments = 3;
/// Most steps between two measurements of how far the surfaces have moved since the window was built.
constexpr long most_steps_between_checks = 512;
/// A layout is made early rather than followed by another check so soon.
constexpr long least_steps_between_checks = 16;
/// Steps between two choices of the nodes that can touch; of a run ContactPair has them.
constexpr long steps_between_near_checks_settling = 16;

/// What the present speeds do not tell of the coming motion, as a share of the way that a dilatational wave travels:
/// the surface's speed behind a wave that strains it by 0.25 %, coming out of nothing.
constexpr double sudden_share = 0.005;

using Rows = Array<double* [3]>::HostMirror;

/// Points in cubic cells as wide as the reach, for finding those within it of a place.
class CellGrid {
 public:
  CellGrid(const Rows& points, double reach) : points_(points), cell_(reach) {
    for (int i = 0; i < static_cast<int>(points.extent(0)); ++i) {
      cells_[key(index(i, 0), index(i, 1), index(i, 2))].push_back(i);
      for (int k = 0; k < 3; ++k) {
        low_[k] = std::fmin(low_[k], points(i, k) - reach);
        high_[k] = std::fmax(high_[k], points(i, k) + reach);
      }
    }
  }

  /// The nearest point within the reach, of several the first, or -1; where `any` does, the first that comes.
  int near(const double (&x)[3], bool any) const {
    long c[3];
    for (int k = 0; k < 3; ++k) {
      if (!(x[k] >= low_[k] && x[k] <= high_[k])) return -1;
      c[k] = static_cast<long>(std::floor(x[k] / cell_));
    }
    int nearest = -1;
    double least = cell_ * cell_;
    constexpr int outwards[3] = {0, -1, 1};
    for (int i : outwards)
      for (int j : outwards)
        for (int k : outwards) {
          const auto cell = cells_.find(key(c[0] + i, c[1] + j, c[2] + k));
          if (cell == cells_.end()) continue;
          for (int p : cell->second) {
            const double dx = points_(p, 0) - x[0], dy = points_(p, 1) - x[1], dz = points_(p, 2) - x[2];
            const double squared = dx * dx + dy * dy + dz * dz;
            if (squared > least || (squared == least && nearest >= 0 && nearest < p)) continue;
            least = squared;
            nearest = p;
            if (any) return p;
          }
        }
    return nearest;
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
  double low_[3] = {1e300, 1e300, 1e300}, high_[3] = {-1e300, -1e300, -1e300};
  std::unordered_map<long, std::vector<int>> cells_;
};

/// A node that leaves the window is apart, and its arrays must say so; one that enters needs a place to begin at.
struct EnterOrLeave {
  ContactArrays contact;
  Array<const int*> inside, nearest;
  KOKKOS_INLINE_FUNCTION void operator()(const int s) const {
    if (inside(s) != 0) {
      if (contact.tracked(s) < 0) {
        contact.tracked(s) = contact.segment_of_node(contact.first_segment(nearest(s)));
        contact.place(s, 0) = contact.place(s, 1) = 0;
      }
      return;
    }
    contact.tracked(s) = -1;
    contact.status(s) = status_apart;
    contact.gap(s) = beside_surface;
    contact.entry_depth(s) = 0;
    for (int k = 0; k < 3; ++k) contact.normal_force(s, k) = contact.tangential_force(s, k) = 0;
  }
};

/// Launches that are recorded know where the arrays are: they are made once.
void fill_window(ContactWindow& window, int slave_count, const std::vector<WindowEntry>& entries) {
  if (static_cast<int>(window.entries.extent(0)) != slave_count) {
    window.entries = Array<WindowEntry*>("window", slave_count);
    window.near = Array<int*>("near nodes", slave_count);
    window.near_count = Array<int*>("number of near nodes", 1);
  }
  const auto host = Kokkos::create_mirror_view(window.entries);
  std::copy(entries.begin(), entries.end(), host.data());
  std::fill(host.data() + entries.size(), host.data() + slave_count, WindowEntry{});
  copy_in_order(window.entries, host);
  window.resize(static_cast<int>(entries.size()));
}

void build_window(const NodeArrays& nodes, ContactPair& pair, double margin) {
  const ContactArrays& contact = pair.arrays;
  pair.slaves_at_layout = gathered_rows(nodes.position, contact.slave_nodes);
  pair.masters_at_layout = gathered_rows(nodes.position, contact.master_nodes);
  const Rows slaves = to_host(pair.slaves_at_layout), masters = to_host(pair.masters_at_layout);

  // A slave's projection lies on a segment whose corners are at most a diagonal away from it.
  const double reach = pair.segment_size + 2 * margin;
  const CellGrid grid(masters, reach);

  std::vector<WindowEntry> entries;
  std::vector<int> near(contact.slave_count, 1), rests(contact.slave_count, 0);
  const auto before = to_host(pair.window.entries);
  for (int i = 0; i < pair.window.count; ++i) {
    near[before(i).slave] = before(i).near;
    rests[before(i).slave] = before(i).rests;
  }
  const auto tracked = to_host(contact.tracked);
  std::vector<int> nearest(contact.slave_count, 0), inside(contact.slave_count, 0);
  for (int s = 0; s < contact.slave_count; ++s) {
    if (pair.on_both[s] != 0) continue;
    // A node that is tracked already needs no place to begin at.
    const int found = grid.near({slaves(s, 0), slaves(s, 1), slaves(s, 2)}, tracked(s) >= 0);
    if (found < 0) continue;
    entries.push_back({s, pair.slave_nodes[s], near[s], rests[s]});
    nearest[s] = found;
    inside[s] = 1;
  }
  fill_window(pair.window, contact.slave_count, entries);
  Kokkos::parallel_for("enter_or_leave", Range(0, contact.slave_count),
                       EnterOrLeave{contact, to_device("inside window", inside), to_device("nearest", nearest)});
}

/// In the default space, after what has been launched in another and before what will be.
void build_window_between(const ExecutionSpace& space, const NodeArrays& nodes, ContactPair& pair, double margin) {
  wait_for(space);
  build_window(nodes, pair, margin);
  ++pair.layouts;
  wait_for(ExecutionSpace());
}

/// @param may_be_old the surfaces' motion may be of the near check before
/// @return whether the window was built anew
bool renew_window(const ExecutionSpace& space, const NodalState& nodal, ContactPair& pair, double step, double sudden,
                  bool may_be_old) {
  // A slave outside the window was at least a segment and two margins from every master node when it was built, so
  // more than two margins from touching.
  const double margin = margin_in_segments * pair.segment_size;
  ++pair.checks;
  const bool built = pair.slaves_at_layout.extent(0) != 0;
  if (!built) build_window_between(space, nodal.nodes, pair, margin);
  const bool asked = may_be_old && pair.asked_motion.is_of(nodal.step, ContactPair::steps_between_near_checks);
  if (!built || !asked) ask_for_motion(space, nodal.nodes, pair, nodal.step);
  SurfaceMotion motion = take_motion(pair);
  const auto steps_left = [&] {
    const auto since = static_cast<double>(nodal.step - motion.step);
    return (2 * margin - motion.moved) / (1.25 * motion.speed * step + sudden) - since;
  };
  bool anew = !built;
  if (built && steps_left() < least_steps_between_checks && motion.moved < 1e100) {
    build_window_between(space, nodal.nodes, pair, margin);
    motion.moved = 0;
    motion.step = nodal.step;
    pair.asked_motion.forget();
    anew = true;
  }
  pair.next_check = nodal.step + static_cast<long>(std::fmax(1.0, std::fmin(steps_left(), most_steps_between_checks)));
  return anew;
}

/// Whether near nodes rest. On a GPU they don't: it looks at as many as there are in the time that the slowest takes.
constexpr bool near_nodes_rest = !on_device;

/// Nodes that rest are projected from now on, as those of a processor's checkpoint are on a GPU.
void end_rests(ContactWindow& window) {
  const auto entries = to_host(window.entries);
  const auto near = to_host(window.near), near_count = to_host(window.near_count);
  for (int i = 0; i < window.count; ++i) {
    if (entries(i).rests == 0) continue;
    entries(i).rests = 0;
    near(near_count(0)++) = i;
  }
  copy_in_order(window.entries, entries);
  copy_in_order(window.near, near);
  copy_in_order(window.near_count, near_count);
}

/// Before nodes are sorted. One launch, as a GPU takes as long for several of these as for a step's nodes.
struct BeginNearNodes {
  EncloseBoxes enclose;
  Array<int*> near_count, uncounted;

  KOKKOS_INLINE_FUNCTION void operator()(const Team::member_type& team) const {
    enclose(team);
    if (team.team_rank() > 0) return;
    near_count(0) = 0;
    uncounted(0) = 0;
  }
};

/// Sends a number to the host in a launch, of which a GPU waits less before and after than of a copy.
struct SendNumber {
  Array<const int*> number;
  PinnedArray<int*> sent;
  KOKKOS_INLINE_FUNCTION void operator()(const int) const { sent(0) = number(0); }
};

/// m in a step.
double sudden_motion(const scene::Scene& scene, const ContactPair& pair, double step, StepKind kind) {
  // Settling scales masses such that a wave travels a share of each element in a step.
  if (kind == StepKind::settling) return sudden_share * pair.segment_size;
  double fastest = 0;
  for (const scene::Material& material : scene.materials) fastest = std::max(fastest, material.dilatational_speed());
  return sudden_share * fastest * step;
}

}  // namespace

void keep_window(const scene::Scene& scene, const NodalState& nodal, ContactPair& pair, const Instant& instant,
                 StepKind kind) {
  const double step = instant.step;
  const ExecutionSpace space = instant.space();
  const bool settling = kind == StepKind::settling, rest = near_nodes_rest && !settling;
  const bool check = nodal.step >= pair.next_check;
  const bool near_check = check || nodal.step >= pair.next_near_check;
  const long since = near_check ? 0 : nodal.step - pair.near_checked_at;
  const bool wake = rest && !near_check && since % NearRest::span == 0;
  if (!near_check && !wake && pair.boxed) return;
  const double sudden = sudden_motion(scene, pair, step, kind);
  const bool counts = pair.counts_springs();
  const long steps = settling ? steps_between_near_checks_settling : ContactPair::steps_between_near_checks,
             ahead =
                 (near_check ? steps : pair.next_near_check - nodal.step) + (counts ? ContactPair::steps_to_answer : 0);
  const double interval = static_cast<double>(ahead) * step, sudden_until_then = static_cast<double>(ahead) * sudden;
  const bool first = pair.layouts == 0 || settling;
  const bool built = check && renew_window(space, nodal, pair, step, sudden, !settling);
  const ContactSearch search{{pair.arrays, nodal.nodes.position}};
  const auto update = [&](const auto& enclose) {
    update_boxes(space, search, nodal.nodes.velocity, interval, sudden_until_then, enclose);
  };
  const EncloseBoxes enclose{pair.arrays.boxes};
  FindNearNodes find{
      search,      pair.window, nodal.nodes.velocity, interval, sudden_until_then, first, first || built || wake,
      pair.missed, {},          pair.uncounted,       {}};
  if (rest) find.rest = {static_cast<int>(since), static_cast<double>(ahead) / NearRest::span};
  if (!near_check) {
    if (!pair.boxed) update(enclose);
    // A checkpoint has no boxes. Made anew they differ, but not what is found with them.
    if (!pair.boxed && !near_nodes_rest) end_rests(pair.window);
    pair.boxed = true;
    if constexpr (near_nodes_rest)
      if (wake) Kokkos::parallel_for("wake_nodes", SpreadRange(space, 0, pair.window.count), WakeNodes{find});
    return;
  }
  pair.boxed = true;
  // At multiples, as what else is due every so many steps: so graphs of steps are cut in fewer places.
  pair.next_near_check = nodal.step - nodal.step % steps + steps;
  pair.answer_due = pair.answer_of(nodal.step);
  pair.near_checked_at = nodal.step;
  update(BeginNearNodes{enclose, pair.window.near_count, pair.uncounted});
  find.counted = pair.counted;
  search_parallel_for(space, "near_nodes", pair.window.count, find);
  // The window's check that comes with the next of these takes it, without waiting for the device.
  if (!settling && pair.next_check <= pair.next_near_check) ask_for_motion(space, nodal.nodes, pair, nodal.step);
  if (!counts) return;
  Kokkos::parallel_for("send_number", SpreadRange(space, 0, 1), SendNumber{pair.uncounted, pair.uncounted_sent});
  pair.uncounted_arrives.put(space);
  pair.uncounted_of = nodal.step;
}

std::vector<std::string> late_contacts(const std::vector<ContactPair>& contacts) {
  std::vector<std::string> lines;
  for (const ContactPair& pair : contacts) {
    const auto gaps = to_vector(pair.arrays.gap);
    if (const auto inside = std::count(gaps.begin(), gaps.end(), turned_away); inside > 0)
      lines.push_back(fmt::format(
          "contact {}: {} nodes of {} are inside the other body at the end and do not touch, for they came in "
          "beside its surface {}, not through it; name the faces that they came through in the contact too, "
          "as a list of masters",
          pair.contact->name, inside, pair.reversed ? pair.contact->master.text() : pair.contact->slave,
          pair.reversed ? pair.contact->slave : pair.contact->master.text()));
    if (const int late = to_host(pair.missed)(0); late > 0)
      lines.push_back(fmt::format(
          "contact {}: {} nodes met the master faster than was predicted, so that their forces began up to {} "
          "steps late; were they set in motion by a shock, a shorter time.step_scale brings them nearer",
          pair.contact->name, late, ContactPair::steps_between_near_checks));
  }
  return lines;
}

}  // namespace railwave
