#include <catch2/catch_test_macros.hpp>
#include <catch2/matchers/catch_matchers_floating_point.hpp>

#include "case/read_case.hpp"
#include "source_folder.hpp"
#include "tests/verify/march.hpp"

using namespace railwave;
using namespace railwave::verify;
using Catch::Matchers::WithinRel;

namespace {

struct Loads {
  double left = 0, right = 0;  // N, vertical, on the wheels
  double unlike() const { return std::fabs(left - right) / (0.5 * (left + right)); }
};

Loads loads_of(const Model& model) {
  return {contact_totals(model, model.contacts, 0).normal_force[2],
          contact_totals(model, model.contacts, 1).normal_force[2]};
}

}  // namespace

TEST_CASE("a wheelset runs 5 ms along two rails with loads symmetric within 1 %", "[long]") {
  std::vector<std::string> coarser{"settle.cache=false", "meshes.wheelset.zone_size=0.006",
                                   "meshes.wheelset.zone_width=0.03", "meshes.wheelset.coarse_size=0.05"};
  for (const std::string track : {"tracks.left.", "tracks.right."})
    for (const char* change : {"zone_size=0.006", "zone_width=0.03", "start=-0.9", "end=0.9", "coarse_size=0.06"})
      coarser.push_back(track + change);
  Model model;
  build_model(read_case(source_folder + "/cases/wheelset.toml", coarser), model);
  const SettleReport settled = settle_whole(model);
  INFO("settled in " << settled.steps << " evaluations, unbalance " << settled.unbalance);
  CHECK(settled.settled);
  double weight = 0;
  for (const char* part : {"wheelset", "left_body", "right_body"})
    for (int n : model.assembly.node_sets.at(part)) weight -= model.scene.gravity[2] * model.mass[n];
  set_initial_motion(model, model.nodes, model.beams);
  double worst = 0, largest = 0, smallest = 1e300;
  Loads sum;
  long samples = 0;
  march(model, model.step_count, [&] {
    if (model.step % 20 != 0) return;
    const Loads now = loads_of(model);
    if (model.step == 0) CHECK_THAT(now.left + now.right, WithinRel(weight, 0.01));
    worst = std::max(worst, now.unlike());
    largest = std::max({largest, now.left, now.right});
    smallest = std::min({smallest, now.left, now.right});
    sum.left += now.left;
    sum.right += now.right;
    ++samples;
  });
  INFO("left and right unlike by at most " << 100 * worst << " %, in the mean " << 100 * sum.unlike() << " %; loads "
                                           << 1e-3 * smallest << " to " << 1e-3 * largest << " kN, static "
                                           << 0.5e-3 * weight << " kN");
  CHECK(worst < 0.01);
  CHECK(sum.unlike() < 0.01);
  CHECK_THAT(sum.left / samples, WithinRel(0.5 * weight, 0.05));
  WARN("left and right unlike by at most " << 100 * worst << " %, in the mean " << 100 * sum.unlike() << " %; loads "
                                           << 1e-3 * smallest << " to " << 1e-3 * largest << " kN, static "
                                           << 0.5e-3 * weight << " kN; " << model.step_count << " steps of "
                                           << model.element_count() << " elements");
}

TEST_CASE("a wheelset that turns about its bore is in balance, however its mesh is graded") {
  for (const char* zone : {"0.004", "0.008"}) {
    Model model;
    build_model(read_case(source_folder + "/cases/squeal.toml",
                          {std::string("meshes.wheelset.zone_size=") + zone, "tracks.track.zone_size=0.006",
                           "tracks.track.start=-0.6", "tracks.track.end=0.6"}),
                model);
    const auto field = centrifugal_field(model, model.nodes.reference, model.beams);
    const auto& nodes = model.assembly.node_sets.at("wheelset");
    Vec3 net{};
    double pulled = 0;
    for (const int n : nodes) {
      net = net + model.mass[n] * field[n];
      pulled += model.mass[n] * norm(field[n]);
    }
    INFO("elements of " << zone << " m: " << norm(net) << " N of " << pulled);
    CHECK(pulled > 1e5);
    CHECK(norm(net) < 10);
    // The bore's own centre of mass lies elsewhere.
    const Vec3 axis = rotation_centre(model, model.scene.initial_motions.at(0), "wheelset", model.nodes.reference),
               bore = centre_of_mass(model, model.assembly.node_sets.at("wheelset.bore"));
    CHECK(std::hypot(axis[0] - bore[0], axis[2] - bore[2]) > 5e-5);
  }
}

TEST_CASE("a bore whose rotation is prescribed turns about its axis, however its mesh is graded") {
  scene::Scene scene = read_case(source_folder + "/cases/verify/rolling.toml");
  scene.prescribed_motions.at(0).centre.reset();
  Model model;
  build_model(scene, model);
  const PrescribedSet& set = model.prescribed.at(0);
  const auto& bore = model.assembly.node_sets.at(set.motion->target);
  double nearest = 1e300, farthest = 0;
  for (const int n : bore) {
    const Vec3 arm = model.assembly.nodes[n] - set.centre;
    nearest = std::min(nearest, std::hypot(arm[0], arm[2]));
    farthest = std::max(farthest, std::hypot(arm[0], arm[2]));
  }
  CHECK(farthest - nearest < 1e-9);
  const Vec3 off = centre_of_mass(model, bore) - set.centre;
  CHECK(std::hypot(off[0], off[2]) > 1e-6);
}
