#include <catch2/catch_test_macros.hpp>
#include <catch2/matchers/catch_matchers_floating_point.hpp>

#include "case/error.hpp"
#include "tests/verify/two_blocks.hpp"

/// Self-contact of a seam: a slit in one part, whose two sides lie on each other and meet at its front.
using namespace railwave;
using namespace railwave::verify;
using Catch::Matchers::WithinRel;

namespace {

constexpr int columns = 8, rows = 3, layers = 8;  // along x, y, z
constexpr double size = 0.01;                     // of an element

scene::Scene slit_scene(double end, double friction) {
  scene::Scene scene = block_scene({columns * size, rows * size, layers * size}, {columns, rows, layers}, end);
  set_hourglass(scene.parts[0], scene::HourglassType::stiffness, 0.05);
  scene::Contact seam;
  seam.name = "seam";
  seam.slave = "block.seam_above";
  seam.master = "block.seam_below";
  seam.friction = friction;
  seam.algorithm = scene::ContactAlgorithm::penalty;
  scene.contacts.push_back(seam);
  scene.time.step_scale = 0.6;
  return scene;
}

/// The block with a slit in mid height, from x = 0 half way in; its front's nodes are common to both sides.
Assembly slit(const scene::Scene& scene, double depth = 0.5) {
  Assembly made = assemble(scene);
  const double level = 0.5 * layers * size, front = depth * columns * size;
  std::map<int, int> twin;
  for (int n = 0, count = static_cast<int>(made.nodes.size()); n < count; ++n) {
    const Vec3 x = made.nodes[n];
    if (std::fabs(x[2] - level) > 1e-9 || x[0] > front - 1e-9) continue;
    twin[n] = static_cast<int>(made.nodes.size());
    made.nodes.push_back(x);
    made.node_sets.at("block").push_back(twin[n]);
  }
  made.parts[0].node_count = static_cast<int>(made.nodes.size());
  for (int e = 0; e < static_cast<int>(made.elements.size()); ++e) {
    double middle = 0, x = 0;
    for (int n : made.elements[e]) {
      middle += made.nodes[n][2] / 8;
      x += made.nodes[n][0] / 8;
    }
    const bool above = middle > level;
    if (std::fabs(middle - level) > size || x > front) continue;
    if (above)
      for (int& n : made.elements[e])
        if (twin.count(n)) n = twin[n];
    made.surfaces[above ? "block.seam_above" : "block.seam_below"].push_back({e, above ? 0 : 1});
  }
  return made;
}

double largest_force(const Model& model) {
  const ContactState state = contact_state(model, model.ties, model.contacts, 0);
  double largest = 0;
  for (double f : state.slave.normal_force) largest = std::max(largest, std::fabs(f));
  return largest;
}

}  // namespace

TEST_CASE("a closed seam at rest has no forces, at the first step and after a thousand") {
  for (bool symmetric : {false, true}) {
    scene::Scene scene = slit_scene(1e-3, 0.3);
    scene.contacts[0].symmetric = symmetric;
    Model model;
    build_model(scene, slit(scene), model);
    double largest = 0, fastest = 0;
    march(model, 1000, [&] {
      if (model.step % 100 != 0) return;
      largest = std::max(largest, largest_force(model));
      fastest = std::max(fastest, largest_speed(model));
    });
    INFO("symmetric " << symmetric << ", largest force " << largest << " N, fastest " << fastest << " m/s");
    CHECK(largest < 1e-5);
    CHECK(fastest < 1e-9);
  }
}

TEST_CASE("a seam passes pressure on, and opens under a pull") {
  for (bool symmetric : {false, true})
    for (double sign : {-1.0, 1.0}) {
      scene::Scene scene = slit_scene(4e-4, 0.3);
      scene.contacts[0].symmetric = symmetric;
      hold(scene, "block.z_min", {true, true, true});
      add_ramp(scene, "growing", 0, 3e-4);
      const double area = columns * rows * size * size, stress = 1e8;
      add_traction(scene, "block.z_max", {0, 0, sign * stress}, "growing");
      Model model;
      build_model(scene, slit(scene), model);
      double least_gap = 1, most_gap = -1, first = 0, imbalance = 0;
      EnergyAccount last;
      march(model, model.step_count, [&] {
        if (model.step % 20 != 0 && model.step != model.step_count) return;
        last = account_energies(model, model.step_size);
        if (model.step == 0) first = balance_total(last);
        imbalance = std::max(imbalance, std::fabs(balance_total(last) - first));
      });
      const ContactState state = contact_state(model, model.ties, model.contacts, 0);
      for (std::size_t s = 0; s < state.gap.size(); ++s) {
        if (!std::isfinite(state.gap[s])) continue;
        least_gap = std::min(least_gap, state.gap[s]);
        most_gap = std::max(most_gap, state.gap[s]);
      }
      const ContactTotals totals = contact_totals(model, model.contacts, 0);
      WARN((symmetric ? "symmetric seam" : "seam")
           << (sign < 0 ? ", pressed" : ", pulled") << ": force " << totals.normal_force[2] << " N of "
           << 0.5 * area * stress << " N on its half, gaps " << least_gap << " to " << most_gap << " m, imbalance "
           << imbalance / largest_energy(last));
      CHECK(reaction_error(totals) < 1e-9);
      CHECK(imbalance < 0.01 * largest_energy(last));
      if (sign < 0) {
        // The springs let the slit's half give way by a penetration, so that its share is a little less than half.
        CHECK(totals.normal_force[2] > 0.4 * area * stress);
        CHECK(totals.normal_force[2] < 0.5 * area * stress);
      } else {
        CHECK(norm(totals.normal_force) == 0);
        CHECK(most_gap > 1e-6);
        CHECK(least_gap >= 0);
      }
    }
}

TEST_CASE("surfaces that share nodes without facing each other are refused, and a seam without nodes of its own") {
  scene::Scene scene = slit_scene(1e-3, 0);
  scene.contacts[0].slave = "block.z_max";
  scene.contacts[0].master = "block.x_min";
  Model corner;
  CHECK_THROWS_AS(build_model(scene, slit(scene), corner), InputError);

  scene = slit_scene(1e-3, 0);
  Assembly uncut = slit(scene);
  const Assembly whole = assemble(scene);
  uncut.nodes = whole.nodes;
  uncut.elements = whole.elements;
  uncut.node_sets = whole.node_sets;
  uncut.parts = whole.parts;
  Model closed;
  CHECK_THROWS_AS(build_model(scene, uncut, closed), InputError);
}
