#include <catch2/catch_test_macros.hpp>
#include <catch2/matchers/catch_matchers_floating_point.hpp>

#include "tests/verify/two_blocks.hpp"

/// A small block under constant load on a cylinder of plane facets that turns once below it: every node crosses every
/// edge.
using namespace railwave;
using namespace railwave::verify;
using Catch::Matchers::WithinRel;

namespace {

constexpr int facets = 90, rows = 3;
constexpr double radius = 0.02, thickness = 0.002, width = 0.006, cube = 0.002;  // m
constexpr double load = 2000, turn_time = 0.01;                                  // N, s

/// The lower block bent to a ring about y through the origin, its two ends joined.
Assembly ring(const scene::Scene& scene) {
  Assembly box = assemble(scene);
  const Assembly::PartRange lower = box.parts[1];
  std::vector<int> number(box.nodes.size());
  Assembly made = box;
  made.nodes.clear();
  std::map<std::array<long, 2>, int> first_column;  // by y and z: the nodes at the box's beginning
  const double length = facets * 1e-3;
  for (int n = 0; n < static_cast<int>(box.nodes.size()); ++n) {
    const Vec3 x = box.nodes[n];
    number[n] = static_cast<int>(made.nodes.size());
    if (n < lower.first_node) {
      made.nodes.push_back(x);
      continue;
    }
    const std::array<long, 2> at{std::lround(x[1] * 1e7), std::lround(x[2] * 1e7)};
    const double along = x[0] + 0.5 * length;
    if (std::fabs(along) < 1e-9) first_column[at] = number[n];
    if (std::fabs(along - length) < 1e-9) {
      number[n] = first_column.at(at);
      continue;
    }
    const double angle = 2 * M_PI * along / length, r = radius + x[2];
    made.nodes.push_back({r * std::sin(angle), x[1], r * std::cos(angle)});
  }
  made.parts[1].node_count = static_cast<int>(made.nodes.size()) - made.parts[1].first_node;
  for (auto& corners : made.elements)
    for (int& n : corners) n = number[n];
  for (auto& [name, set] : made.node_sets) {
    for (int& n : set) n = number[n];
    std::sort(set.begin(), set.end());
    set.erase(std::unique(set.begin(), set.end()), set.end());
  }
  return made;
}

/// Gives held nodes the velocities that carry them to their places at the next angle.
struct Turn {
  Array<const int*> nodes;
  Array<const double*[3]> reference, position;
  Array<double* [3]> velocity;
  double cosine, sine, step;
  KOKKOS_INLINE_FUNCTION void operator()(const int i) const {
    const int n = nodes(i);
    const Vector3 x = row(reference, n);
    const double to[3] = {cosine * x[0] + sine * x[2], x[1], cosine * x[2] - sine * x[0]};
    for (int k = 0; k < 3; ++k) velocity(n, k) = (to[k] - position(n, k)) / step;
  }
};

struct Ride {
  double least = 1e300, most = 0, mean = 0, deviation = 0;  ///< of the load
  int fewest = 4;
  long steps = 0, crossings = 0;
};

Ride ride(double damping, scene::ContactNormals normals) {
  TwoBlocks blocks;
  blocks.upper_size = {cube, cube, cube};
  blocks.upper_divisions = {1, 1, 1};
  blocks.lower_size = {facets * 1e-3, width, thickness};
  blocks.lower_divisions = {facets, rows, 1};
  // As high as the facets' middle, under the block's corners.
  blocks.gap = std::sqrt(radius * radius - 0.25 * cube * cube);
  scene::Scene scene = blocks.scene(turn_time);
  scene.parts[0].position[2] = blocks.gap;
  scene.contacts[0].damping = damping;
  scene.contacts[0].normals = normals;
  hold(scene, "lower", {true, true, true});
  hold(scene, "upper", {true, true, false});
  add_force(scene, "upper", {0, 0, -load});
  scene.time.step_scale = 0.6;
  scene.settle.active = true;
  scene.settle.tolerance = 1e-6;
  Model model;
  build_model(scene, ring(scene), model);
  REQUIRE(settle_whole(model).settled);

  const auto& turning = model.assembly.node_sets.at("lower");
  const auto nodes = to_device("turning", turning);
  const ContactPair& pair = model.contacts[0];
  Ride result;
  std::vector<int> before;
  // Full speed is reached in the first twentieth of the time; a full turn and a little more in all.
  const double begin = 0.05 * turn_time, full = 2 * M_PI / (turn_time - 0.5 * begin) * 1.01;
  march(model, model.step_count, [&] {
    const double t = model.time + model.step_size;
    const double angle =
        t < begin ? 0.5 * full * (t - begin / M_PI * std::sin(M_PI * t / begin)) : full * (t - 0.5 * begin);
    Kokkos::parallel_for("turn", Range(0, static_cast<int>(turning.size())),
                         Turn{nodes, model.nodes.reference, model.nodes.position, model.nodes.velocity, std::cos(angle),
                              std::sin(angle), model.step_size});
    const auto force = to_host(pair.arrays.normal_force);
    const auto status = to_host(pair.arrays.status), segment = to_host(pair.arrays.tracked);
    double sum = 0;
    int touching = 0;
    for (int s = 0; s < pair.arrays.slave_count; ++s) {
      sum += force(s, 2) / load;
      touching += status(s) != status_apart;
      if (!before.empty()) result.crossings += segment(s) != before[s];
    }
    before.assign(segment.data(), segment.data() + pair.arrays.slave_count);
    result.least = std::min(result.least, sum);
    result.most = std::max(result.most, sum);
    result.mean += sum;
    result.deviation += (sum - 1) * (sum - 1);
    result.fewest = std::min(result.fewest, touching);
    ++result.steps;
  });
  result.mean /= static_cast<double>(result.steps);
  result.deviation = std::sqrt(result.deviation / static_cast<double>(result.steps));
  return result;
}

}  // namespace

TEST_CASE("no contact is lost in a full turn of a faceted cylinder below a loaded block") {
  for (double damping : {0.0, 0.1}) {
    const Ride result = ride(damping, scene::ContactNormals::facet);
    WARN("faceted cylinder, damping " << damping << ": force " << result.least << " to " << result.most
                                      << " of the load, jitter (rms) " << result.deviation << ", mean " << result.mean
                                      << ", edges crossed " << result.crossings << ", at least " << result.fewest
                                      << " of 4 nodes in contact, " << result.steps << " steps");
    CHECK(result.fewest >= 2);
    CHECK(result.least > 0.5);
    CHECK_THAT(result.mean, WithinRel(1.0, 0.01));
    CHECK(result.crossings >= 4 * facets);
  }
}

TEST_CASE("with smooth normals a block does not feel the facets of a turning cylinder") {
  const Ride result = ride(0, scene::ContactNormals::smooth);
  WARN("faceted cylinder, smooth normals: force " << result.least << " to " << result.most
                                                  << " of the load, jitter (rms) " << result.deviation);
  CHECK(result.fewest == 4);
  CHECK(result.deviation < 1e-5);
  CHECK(result.crossings >= 4 * facets);
}
