#include <algorithm>
#include <array>
#include <catch2/catch_test_macros.hpp>
#include <cmath>
#include <vector>

#include "model/beams/beams.hpp"
#include "solve/plan.hpp"
#include "tests/verify/beam_scene.hpp"
#include "tests/verify/tied_blocks.hpp"

using namespace railwave;
using namespace railwave::verify;

namespace {

scene::Connector& add_connector(scene::Scene& scene, const std::string& from, const std::string& to) {
  scene::Connector& made = scene.connectors.emplace_back();
  made.name = from + "_to_" + to;
  made.from = from;
  made.to = to;
  made.stiffness = {3e6, 2e6, 7e6};
  made.damping = {200, 300, 500};
  made.preload = {10, -20, 40};
  return made;
}

/// A plate above another one, of more nodes than a team has chunks at a time; a bed between, whose cells have nodes in
/// common; beams from one point to a whole side; a torque and loads of all kinds.
scene::Scene bedded_plates() {
  TiedBlocks blocks;
  blocks.size = {0.4, 0.4, 0.02};
  blocks.coarse = blocks.fine = {36, 36, 1};
  blocks.gap = 0.01;
  scene::Scene scene = blocks.scene(1e-5);
  scene.ties.clear();
  scene.points = {massless("pole", {0.5, 0.2, 0.04})};
  scene.points[0].mass = 3;
  scene.beams = {round_beam("pole", "fine.x_max", 0.004, 1)};
  add_connector(scene, "coarse.z_max", "fine.z_min").spread = {7, 5};
  add_connector(scene, "ground", "coarse.z_min");
  add_connector(scene, "fine.y_min", "pole");
  add_connector(scene, "pole", "ground");
  add_torque(scene, "fine.z_max", 40, {0.2, 0, 1});
  add_force(scene, "fine.z_max", {3, 4, -1e4});
  add_pressure(scene, "coarse.x_min", 1e5);
  return scene;
}

/// Nodes where no formula finds them by chance.
void shake(const NodeArrays& nodes) {
  const auto x = to_host(nodes.position), v = to_host(nodes.velocity);
  for (int n = 0; n < nodes.count; ++n)
    for (int k = 0; k < 3; ++k) {
      x(n, k) += 1e-4 * std::sin(1.7 * n + 2.3 * k);
      v(n, k) = 0.3 * std::cos(0.9 * n - 1.1 * k);
    }
  Kokkos::deep_copy(nodes.position, x);
  Kokkos::deep_copy(nodes.velocity, v);
}

/// Weighted means over a set, one node after the other.
struct Means {
  Vec3 position{}, velocity{};

  Means(const Model& model, int set) {
    const auto x = to_host(model.nodes.position), v = to_host(model.nodes.velocity);
    const auto node = to_host(model.sets.nodes);
    const auto weight = to_host(model.sets.weight);
    for (int k = model.first_of_set[set]; k < model.first_of_set[set + 1]; ++k)
      for (int i = 0; i < 3; ++i) {
        position[i] += weight(k) * x(node(k), i);
        velocity[i] += weight(k) * v(node(k), i);
      }
  }
};

Vec3 connector_force(const Model& model, int c) {
  const ConnectorArrays& arrays = model.connectors.arrays;
  const auto set = to_host(arrays.set);
  const auto rest = to_host(arrays.rest), stiffness = to_host(arrays.stiffness), damping = to_host(arrays.damping),
             preload = to_host(arrays.preload);
  Vec3 force{};
  std::array<Means, 2> ends{Means(model, std::max(0, set(c, 0))), Means(model, std::max(0, set(c, 1)))};
  for (int i = 0; i < 3; ++i) {  // its axes are the global ones
    const auto part = [&](const Vec3& from, const Vec3& to) {
      return (set(c, 1) >= 0 ? to[i] : 0) - (set(c, 0) >= 0 ? from[i] : 0);
    };
    force[i] = preload(c, i) - stiffness(c, i) * (part(ends[0].position, ends[1].position) - rest(c, i)) -
               damping(c, i) * part(ends[0].velocity, ends[1].velocity);
  }
  return force;
}

/// The torque's force on a node of its set, and by which weight the node has it.
struct Torque {
  Vec3 centre{}, axis{};
  double factor = 0;

  explicit Torque(const Model& model) {
    const int set = to_host(model.torques.set)(0);
    const auto axes = to_host(model.torques.axis), x = to_host(model.nodes.position);
    const auto node = to_host(model.sets.nodes);
    const auto weight = to_host(model.sets.weight);
    centre = Means(model, set).position;
    axis = {axes(0, 0), axes(0, 1), axes(0, 2)};
    double arms = 0;
    for (int k = model.first_of_set[set]; k < model.first_of_set[set + 1]; ++k) {
      const Vec3 arm = cross(axis, Vec3{x(node(k), 0), x(node(k), 1), x(node(k), 2)} - centre);
      arms += weight(k) * dot(arm, arm);
    }
    factor = 40 / arms;
  }
};

}  // namespace

TEST_CASE("teams find what each node feels of connectors, torques, beams and other loads") {
  Model model;
  build_model(bedded_plates(), model);
  shake(model.nodes);
  const SetTeams& teams = model.set_teams;
  REQUIRE(teams.count > 2);
  REQUIRE(teams.rows.extent(0) > 0);
  // A node of several teams' cells; the pole, on which all beams push.
  REQUIRE(teams.others_with_few > 0);
  REQUIRE(teams.others.extent(0) > static_cast<std::size_t>(teams.others_with_few));
  const std::vector<SetTeam> all = to_vector(teams.teams);
  REQUIRE(std::any_of(all.begin(), all.end(),
                      [&](const SetTeam& team) { return team.end_chunk - team.first_chunk > teams.chunks_at_once; }));

  run_tasks(load_tasks(model, model, model.beams, StepKind::sampled, {}), Instant{0, 1e-8, 0}, 0);

  std::vector<Vec3> of_connector;
  for (int c = 0; c < model.connectors.arrays.count; ++c) of_connector.push_back(connector_force(model, c));
  const Torque torque(model);
  const auto given = to_host(model.external.contribution), load = to_host(model.external.sum.load),
             x = to_host(model.nodes.position);
  const std::vector<RowShare> shares = to_vector(model.external.shares);
  double largest = 0, error = 0;
  for (const LoadedRow& row : to_vector(model.external.loaded)) {
    Vec3 sum{};
    for (int k = row.first; k < row.last; ++k) {
      const RowShare& share = shares[k];
      if (share.law == RowShare::given)
        for (int i = 0; i < 3; ++i) sum[i] += given(share.contribution, i);
      else if (share.law < model.connectors.arrays.count)
        sum = sum + share.weight * of_connector[share.law];
      else
        sum = sum + (torque.factor * share.weight) *
                        cross(torque.axis, Vec3{x(row.node, 0), x(row.node, 1), x(row.node, 2)} - torque.centre);
    }
    for (int i = 0; i < 3; ++i) {
      largest = std::max(largest, std::abs(sum[i]));
      error = std::max(error, std::abs(load(row.row, i) - sum[i]));
    }
  }
  CHECK(largest > 100);
  CHECK(error < 1e-10 * largest);
}
