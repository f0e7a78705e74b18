#include <catch2/catch_test_macros.hpp>
#include <limits>

#include "tests/verify/two_blocks.hpp"

/// At every step of a run with rolling and sliding, the nodes in contact are those that a search of all nodes over all
/// segments finds, which knows of no window, no tracked segment and no step before.
using namespace railwave;
using namespace railwave::verify;

namespace {

/// Where a slave stands over one segment: Gauss-Newton from the centre, one tangent plane after the other. Beyond
/// distorted segments that can circle for ever, so its steps are shortened as it goes on, and what has not come to rest
/// is outside.
struct Standing {
  double outside, gap;  ///< in xi or eta; m, at the nearest place within the segment's sides
};

Standing stand(const Vec3& slave, const std::array<Vec3, 4>& x) {
  double s = 0.5, t = 0.5;
  Vec3 a, b, r;
  const auto at = [&] {
    r = (1 - s) * ((1 - t) * x[0] + t * x[3]) + s * ((1 - t) * x[1] + t * x[2]);
    a = (1 - t) * (x[1] - x[0]) + t * (x[2] - x[3]);
    b = (1 - s) * (x[3] - x[0]) + s * (x[2] - x[1]);
  };
  bool at_rest = false;
  for (int k = 0; k < 100 && !at_rest; ++k) {
    const double damping = std::pow(0.8, k / 10);
    at();
    const Vec3 d = slave - r;
    const double aa = dot(a, a), ab = dot(a, b), bb = dot(b, b), determinant = aa * bb - ab * ab;
    const double ds = (bb * dot(a, d) - ab * dot(b, d)) / determinant,
                 dt = (aa * dot(b, d) - ab * dot(a, d)) / determinant;
    s = std::max(-2.0, std::min(3.0, s + damping * ds));
    t = std::max(-2.0, std::min(3.0, t + damping * dt));
    at_rest = std::fabs(ds) + std::fabs(dt) < 1e-12;
  }
  const double outside = !at_rest ? 1e300 : 2 * std::max(std::fabs(s - 0.5), std::fabs(t - 0.5)) - 1;
  s = std::max(0.0, std::min(1.0, s));
  t = std::max(0.0, std::min(1.0, t));
  at();
  const Vec3 n = cross(a, b);
  return {outside, dot(slave - r, n) / norm(n)};
}

/// What all segments say of a node.
struct Verdict {
  double deepest = 0;              ///< gap under the segment that holds it, 0: none
  double nearest_outside = 1e300;  ///< of the segments near
  double gap_there = 1e300;
  double distance = 1e300;   ///< from the nearest side
  std::vector<double> gaps;  ///< over every segment that holds it

  /// Over a fold no segment may hold a node; what is hardly outside counts (ContactSearch::outside_tolerance).
  bool touches() const { return nearest_outside <= 0.05 && (gaps.empty() ? gap_there < 0 : deepest < 0); }
  /// Rounding decides.
  bool doubtful() const {
    double least = std::fabs(gap_there);
    for (double g : gaps) least = std::min(least, std::fabs(g));
    return least < 1e-13 || std::fabs(nearest_outside - 0.05) < 1e-7;
  }
};

Verdict search_all(const Vec3& slave, const std::vector<std::array<Vec3, 4>>& segments) {
  Verdict verdict;
  for (const auto& x : segments) {
    const double size = std::max(norm(x[2] - x[0]), norm(x[3] - x[1]));
    // A node over a segment and less than half its size away is at most its size from its centre.
    if (norm(slave - 0.25 * (x[0] + x[1] + x[2] + x[3])) > 1.1 * size) continue;
    for (int k = 0; k < 4; ++k) {
      const Vec3 way = x[(k + 1) % 4] - x[k];
      const double share = std::max(0.0, std::min(1.0, dot(slave - x[k], way) / dot(way, way)));
      verdict.distance = std::min(verdict.distance, norm(slave - (x[k] + share * way)));
    }
    const Standing here = stand(slave, x);
    if (std::fabs(here.gap) > 0.5 * size) continue;
    if (here.outside <= 1e-9) {
      verdict.gaps.push_back(here.gap);
      verdict.deepest = std::min(verdict.deepest, here.gap);
    }
    if (here.outside < verdict.nearest_outside) {
      verdict.nearest_outside = here.outside;
      verdict.gap_there = here.gap;
    }
  }
  return verdict;
}

struct Count {
  long touching = 0, crossings = 0, meetings = 0, partings = 0, different = 0, doubtful = 0, wrong_gap = 0, steps = 0;
};

/// Runs and compares at every step.
Count compare(Model& model) {
  Count count;
  const ContactPair& pair = model.contacts[0];
  std::vector<int> status_before, segment_before;
  march(model, model.step_count, [&] {
    const auto x = to_host(model.nodes.position);
    const auto place = [&](int n) { return Vec3{x(n, 0), x(n, 1), x(n, 2)}; };
    std::vector<std::array<Vec3, 4>> segments;
    for (const auto& corner : pair.master_segments) {
      segments.emplace_back();
      for (int k = 0; k < 4; ++k) segments.back()[k] = place(pair.master_nodes[corner[k]]);
    }
    const auto status = to_host(pair.arrays.status), segment = to_host(pair.arrays.tracked);
    const auto gap = to_host(pair.arrays.gap);
    ++count.steps;
    for (int s = 0; s < pair.arrays.slave_count; ++s) {
      const Verdict verdict = search_all(place(pair.slave_nodes[s]), segments);
      const bool touches = status(s) != status_apart;
      count.touching += touches;
      if (touches != verdict.touches()) ++(verdict.doubtful() ? count.doubtful : count.different);
      if (touches) {
        // Over a fold that no segment holds the nearest side is as far as the gap.
        double nearest = verdict.gaps.empty() ? std::fabs(-gap(s) - verdict.distance) : 1e300;
        for (double g : verdict.gaps) nearest = std::min(nearest, std::fabs(gap(s) - g));
        count.wrong_gap += !(nearest < 1e-12);
      }
      if (status_before.empty()) continue;
      const bool touched = status_before[s] != status_apart;
      count.crossings += touches && touched && segment(s) != segment_before[s];
      count.meetings += touches && !touched;
      count.partings += touched && !touches;
    }
    status_before.assign(status.data(), status.data() + pair.arrays.slave_count);
    segment_before.assign(segment.data(), segment.data() + pair.arrays.slave_count);
  });
  return count;
}

/// An arc of a wheel with a crowned tread over a rail with a crowned and wavy head, both meshes disordered.
struct WheelOnRail {
  double radius = 0.03, crown = 0.06, rail_crown = 0.08, wave = 1.5e-4, wave_length = 0.017;
  Vec3 velocity{}, spin{};  ///< of the wheel, the spin about its axle
  double pressing = 0;      ///< m/s2 downwards

  scene::Scene scene(double end) const {
    TwoBlocks blocks;
    blocks.upper_size = {0.045, 0.01, 0.006};
    blocks.upper_divisions = {30, 7, 2};
    blocks.lower_size = {0.07, 0.018, 0.006};
    blocks.lower_divisions = {70, 18, 2};
    blocks.friction = 0.05;  // little, so that it goes on sliding
    blocks.gap = 1e-5;
    scene::Scene made = blocks.scene(end);
    made.gravity = {0, 0, -pressing};
    hold(made, "lower.z_min", {true, true, true});
    made.time.step_scale = 0.7;
    return made;
  }

  Assembly assembly(const scene::Scene& scene) const {
    Assembly made = assemble(scene);
    const std::vector<int> rail = made.node_sets.at("lower"), wheel = made.node_sets.at("upper");
    std::mt19937 generator(17);
    std::uniform_real_distribution<double> shift(-1, 1);
    for (int n : rail) {
      Vec3& x = made.nodes[n];
      x[0] += 1.2e-4 * shift(generator);
      x[1] += 1.2e-4 * shift(generator);
      const double height = 1 + x[2] / 0.006;  // 0 at the foot, 1 at the head
      x[2] += height * (-x[1] * x[1] / (2 * rail_crown) + wave * std::sin(2 * M_PI * x[0] / wave_length));
    }
    const int highest =
        *std::max_element(rail.begin(), rail.end(), [&](int a, int b) { return made.nodes[a][2] < made.nodes[b][2]; });
    const double head = made.nodes[highest][2];
    for (int n : wheel) {
      const Vec3 x = made.nodes[n];
      const double angle = (x[0] + 1.5e-4 * shift(generator)) / radius, y = x[1] + 1.5e-4 * shift(generator);
      const double r = radius - x[2] - y * y / (2 * crown);
      made.nodes[n] = {r * std::sin(angle) - 0.018, y, head + radius - r * std::cos(angle)};
    }
    return made;
  }

  void set_in_motion(Model& model) const {
    const Vec3 axle = {-0.018, 0, 0};
    std::vector<bool> on_wheel(model.nodes.count, false);
    for (int n : model.assembly.node_sets.at("upper")) on_wheel[n] = true;
    set_velocity(model, [&](const Vec3& x, int n) {
      return on_wheel[n] ? velocity + cross(spin, x - (axle + Vec3{0, 0, radius})) : Vec3{0, 0, 0};
    });
  }
};

void check(const WheelOnRail& made, double end, long least_touching, long least_crossings) {
  const scene::Scene scene = made.scene(end);
  Model model;
  build_model(scene, made.assembly(scene), model);
  made.set_in_motion(model);
  const Count count = compare(model);
  const ContactPair& pair = model.contacts[0];
  INFO("steps " << count.steps << ", nodes in contact " << count.touching << ", segments crossed " << count.crossings
                << ", met " << count.meetings << ", parted " << count.partings << ", in doubt " << count.doubtful
                << ", window built " << pair.layouts << " times, checked " << pair.checks << " times");
  CHECK(count.different == 0);
  CHECK(count.doubtful < 5);
  CHECK(count.wrong_gap == 0);
  CHECK(to_host(pair.missed)(0) == 0);
  CHECK(count.touching > least_touching);
  CHECK(count.crossings > least_crossings);
  CHECK(count.meetings > 50);
  CHECK(count.partings > 20);
  // The host is not kept waiting.
  CHECK(pair.checks < count.steps / 20);
}

}  // namespace

TEST_CASE("a wheel that rolls and slips touches at every step where a search of everything says so") {
  WheelOnRail made;
  made.velocity = {100, 0, -3};
  made.spin = {0, 1000, 0};
  made.pressing = 2e6;
  check(made, 2.6e-4, 10000, 200);
}

TEST_CASE("a wheel that slides askew touches at every step where a search of everything says so") {
  WheelOnRail made;
  made.velocity = {110, 15, -8};
  made.spin = {0, -600, 200};
  made.pressing = 2e6;
  check(made, 2.5e-4, 10000, 200);
}
