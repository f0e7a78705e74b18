#include <catch2/catch_test_macros.hpp>
#include <catch2/matchers/catch_matchers_floating_point.hpp>

#include "tests/verify/tied_blocks.hpp"

using namespace railwave;
using namespace railwave::verify;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace {

/// Largest deviation of the settled blocks' stress from the one under uniaxial traction along z, relative to it.
double patch_error(const TiedBlocks& blocks) {
  scene::Scene scene = blocks.pulled();
  scene.settle.active = true;
  scene.settle.tolerance = 1e-8;
  scene.settle.max_steps = 100000;
  Model model;
  build_model(scene, model);
  const SettleReport report = settle_whole(model);
  CHECK(report.settled);
  const auto stress = element_stress(model, model.nodes, all_elements(model)).values;
  double worst = 0;
  for (std::size_t k = 0; k < stress.size(); ++k)
    worst = std::fmax(worst, std::fabs(stress[k] - (k % 6 == 2 ? 1e6 : 0)) / 1e6);
  return worst;
}

}  // namespace

TEST_CASE("patch test: stress goes through a tie of meshes 3:1 unchanged") {
  const double worst = patch_error({});
  INFO("stress off by " << worst);
  CHECK(worst < 1e-4);
}

TEST_CASE("patch test: where nodes of the meshes do not fall on each other, stress is still near") {
  TiedBlocks blocks;
  blocks.coarse = {4, 4, 3};
  blocks.fine = {11, 11, 9};
  const double worst = patch_error(blocks);
  INFO("4 to 11 elements: stress off by " << worst);
  CHECK(worst < 0.05);
}

namespace {

/// Largest velocity that a pulse from one block leaves in it after it has gone over into the other, relative to its
/// own.
double reflected(TiedBlocks blocks, bool from_coarse) {
  blocks.axis = 0;
  blocks.size = {0.4, 0.01, 0.01};
  blocks.coarse = {80, 2, 2};
  blocks.fine = {240, 6, 6};
  const double deviation = 0.03, amplitude = 1e-6;
  scene::Scene scene = blocks.scene(1);
  for (const char* part : {"coarse", "fine"}) hold(scene, part, {false, true, true});
  const double c = scene.materials[0].dilatational_speed(), sign = from_coarse ? 1 : -1,
               from = from_coarse ? 0.25 : 0.55;
  scene.time.end = 0.3 / c;
  Model model;
  build_model(scene, model);
  const auto shape = [&](double x) { return amplitude * std::exp(-0.5 * std::pow((x - from) / deviation, 2)); };
  set_position(model, [&](const Vec3& x, int) { return Vec3{x[0] + shape(x[0]), x[1], x[2]}; });
  set_velocity(model, [&](const Vec3& x, int) {
    return Vec3{sign * c * (x[0] - from) / (deviation * deviation) * shape(x[0]), 0, 0};
  });
  const auto fastest = [&](const std::string& part) {
    const auto v = node_field(model, model.ties, NodeField::velocity, model.assembly.node_sets.at(part)).values;
    double largest = 0;
    for (double component : v) largest = std::fmax(largest, std::fabs(component));
    return largest;
  };
  const std::string behind = from_coarse ? "coarse" : "fine", before = from_coarse ? "fine" : "coarse";
  double first = -1;
  march(model, model.step_count, [&] {
    if (first < 0) first = fastest(behind);
  });
  CHECK_THAT(fastest(before), WithinRel(first, 0.02));
  return fastest(behind) / first;
}

}  // namespace

TEST_CASE("a P pulse goes through a tie of meshes 3:1 with less than 2 % thrown back") {
  for (auto precision :
       {scene::Precision::double_precision, scene::Precision::mixed, scene::Precision::single_precision})
    for (bool from_coarse : {true, false}) {
      TiedBlocks blocks;
      blocks.precision = precision;
      const double share = reflected(blocks, from_coarse);
      INFO("precision " << static_cast<int>(precision) << (from_coarse ? ", into the fine" : ", into the coarse")
                        << ": amplitude thrown back " << share);
      CHECK(share < 0.02);
    }
}

TEST_CASE("a rigid turn of the tied pair leaves no stress, with a gap between the surfaces too") {
  for (double gap : {0.0, 1e-3, -1e-3}) {
    TiedBlocks blocks;
    blocks.gap = gap;
    scene::Scene scene = blocks.scene(1e-4);
    scene.ties[0].max_distance = 2e-3;
    Model model;
    build_model(scene, model);
    const auto axes = oblique_axes();
    set_position(model, [&](const Vec3& x, int) { return turned(axes, x) + Vec3{1, 2, 3}; });
    march(model, 200, [] {});
    INFO("gap " << gap << " m: stress " << largest_stress(model) << " Pa");
    CHECK(largest_stress(model) < 10);
  }
}

TEST_CASE("ties keep linear and angular momentum to rounding, and energy in balance") {
  for (double gap : {0.0, 1e-3}) {
    TiedBlocks blocks;
    blocks.gap = gap;
    scene::Scene scene = blocks.scene(2e-4);
    scene.ties[0].max_distance = 2e-3;
    scene.output.history_interval = 5e-6;
    scene.parts[0].hourglass = scene.parts[1].hourglass = scene::HourglassType::stiffness;
    Model model;
    build_model(scene, model);
    set_velocity(model, [](const Vec3& x, int) {
      return Vec3{10 * std::sin(40 * x[2]), 20 * x[0] - 5, 8 * std::cos(50 * x[1])};
    });
    march(model, 1, [] {});
    const Momentum before(model);
    march(model, 500, [] {});
    const Momentum after(model);
    INFO("gap " << gap << ": linear " << norm(after.linear - before.linear) / norm(before.linear) << ", angular "
                << norm(after.angular - before.angular) / norm(before.angular));
    CHECK(norm(after.linear - before.linear) < 1e-11 * norm(before.linear));
    CHECK(norm(after.angular - before.angular) < 1e-11 * norm(before.angular));

    Model again;
    build_model(scene, again);
    set_velocity(again, [](const Vec3& x, int) {
      return Vec3{10 * std::sin(40 * x[2]), 20 * x[0] - 5, 8 * std::cos(50 * x[1])};
    });
    Recorder recorder;
    run(again, {&recorder});
    double worst = 0;
    for (const HistorySample& sample : recorder.samples)
      worst = std::fmax(worst, std::fabs(sample.energy.balance_error));
    const double largest = largest_energy(recorder.samples.back().energy);
    INFO("gap " << gap << ": worst imbalance " << worst / largest);
    CHECK(worst < 1e-4 * largest);
  }
}

TEST_CASE("the history of a set that is tied in part is the mean of its nodes' motion, tied ones as their faces move") {
  TiedBlocks blocks;
  scene::Scene scene = blocks.scene(2e-5);
  scene.output.history_sets = {"fine"};
  Model model;
  build_model(scene, model);
  set_velocity(model, [](const Vec3& x, int) {
    return Vec3{10 * std::sin(40 * x[2]), 20 * x[0] - 5, 8 * std::cos(50 * x[1])};
  });
  march(model, 20, [] {});
  const std::vector<int>& nodes = model.assembly.node_sets.at("fine");
  REQUIRE(std::any_of(nodes.begin(), nodes.end(), [&](int n) { return model.ties.place_of(n) != nullptr; }));
  const MeanMotion found = take_sample(model, model.step_size).sets.at(0);
  for (const auto& [field, of_set] : {std::pair{NodeField::displacement, found.displacement},
                                      {NodeField::velocity, found.velocity},
                                      {NodeField::acceleration, found.acceleration}}) {
    const Vec3 expected = mean(model, field, nodes);
    for (int i = 0; i < 3; ++i) CHECK_THAT(of_set[i], WithinAbs(expected[i], 1e-10 * norm(expected)));
  }
}

TEST_CASE("tied bodies fall freely, and settle under their weight as one") {
  TiedBlocks blocks;
  scene::Scene scene = blocks.scene(1e-4);
  scene.gravity = {0, 0, -9.81e3};
  SECTION("fall") {
    Model model;
    build_model(scene, model);
    march(model, model.step_count, [] {});
    const double fallen = 0.5 * 9.81e3 * model.time * model.time;
    for (int n = 0; n < model.nodes.count; ++n)
      CHECK(std::fabs(node_field(model, model.ties, NodeField::displacement, {n}).values[2] + fallen) < 1e-9 * fallen);
  }
  SECTION("settle") {
    hold(scene, "coarse.z_min", {false, false, true});
    for (const char* part : {"coarse", "fine"}) hold(scene, part, {true, true, false});
    scene.settle.active = true;
    scene.settle.tolerance = 1e-7;
    scene.settle.max_steps = 100000;
    Model model;
    build_model(scene, model);
    CHECK(settle_whole(model).settled);
    // rho g L^2 / 2 M for a column that cannot widen.
    const double expected = -7800 * 9.81e3 * 0.12 * 0.12 / (2 * steel().dilatational_modulus());
    CHECK_THAT(mean(model, NodeField::displacement, model.assembly.node_sets.at("fine.z_max"))[2],
               WithinRel(expected, 2e-3));
  }
}

TEST_CASE("the stable step knows of ties: at the global estimate nothing grows, a little above it does") {
  for (double gap : {0.0, 1e-3}) {
    TiedBlocks blocks;
    blocks.gap = gap;
    scene::Scene scene = blocks.scene(1e-3);
    scene.ties[0].max_distance = 2e-3;
    scene.solver.step_estimate = scene::StepEstimate::global;
    Model model;
    build_model(scene, model);
    CHECK(model.stable_step.global > 0.999 * model.stable_step.by_eigenvalues);
    for (double factor : {1.0, 1.03}) {
      reset_to_start(model);
      model.step_size = factor * model.stable_step.limit;
      std::mt19937 generator(7);
      std::uniform_real_distribution<double> any(-1e-3, 1e-3);
      set_velocity(model, [&](const Vec3&, int) { return Vec3{any(generator), any(generator), any(generator)}; });
      double first = -1;
      march(model, 3000, [&] {
        if (first < 0) first = account_energies(model, model.step_size).kinetic;
      });
      const double last = account_energies(model, model.step_size).internal;
      INFO("gap " << gap << " m, " << factor << " times the limit: " << last << " J of " << first << " J");
      CHECK((last < 2 * first) == (factor == 1.0));
    }
  }
}

TEST_CASE("a contact may press on tied nodes: forces go over the tie, momentum is kept") {
  TiedBlocks blocks;
  blocks.axis = 0;
  scene::Scene scene = blocks.scene(1e-4);
  scene.parts.push_back(scene.parts[0]);
  scene.parts[2].name = "hammer";
  scene.parts[2].position = {0.03, 0.01, 0.06 + 1e-6};
  scene::Contact contact;
  contact.name = "hit";
  contact.slave = "fine.z_max";
  contact.master = "hammer.z_min";
  contact.friction = 0.3;
  scene.contacts.push_back(contact);
  Model model;
  build_model(scene, model);
  CHECK(model.contacts[0].has_springs());  // multipliers would not see the ties
  set_velocity(model, [](const Vec3& x, int) { return x[2] > 0.06 + 5e-7 ? Vec3{1, 0, -2} : Vec3{0, 0, 0}; });
  march(model, 1, [] {});
  const Momentum before(model);
  double most = 0;
  march(model, model.step_count,
        [&] { most = std::fmax(most, norm(contact_totals(model, model.contacts, 0).normal_force)); });
  const Momentum after(model);
  CHECK(most > 1e4);
  CHECK(norm(after.linear - before.linear) < 1e-11 * norm(before.linear));
}
