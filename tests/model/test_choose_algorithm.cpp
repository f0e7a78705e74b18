#include <catch2/catch_test_macros.hpp>
#include <catch2/matchers/catch_matchers_string.hpp>

#include "model/contact/contact_law.hpp"
#include "tests/verify/two_blocks.hpp"

/// Which algorithm contacts get that leave it to the scene.
using namespace railwave;
using namespace railwave::verify;
using Catch::Matchers::ContainsSubstring;
using scene::ContactAlgorithm;

namespace {

scene::Scene blocks(double gap = 0) {
  TwoBlocks two;
  two.algorithm = ContactAlgorithm::automatic;
  two.gap = gap;
  two.friction = 0.3;
  return two.scene(1e-5);
}

/// What the model makes of the scene's contact: its pair has the arrays of that algorithm.
std::string chosen(const scene::Scene& scene) {
  Model model;
  build_model(scene, model);
  const scene::Contact& contact = model.scene.contacts[0];
  CHECK(model.contacts[0].has_springs() == (contact.algorithm == ContactAlgorithm::penalty));
  CHECK(contact.algorithm != ContactAlgorithm::automatic);
  CHECK(contact.algorithm_reason.has_value());
  return describe_algorithm(contact);
}

std::string complaint_with_multipliers(scene::Scene scene) {
  scene.contacts[0].algorithm = ContactAlgorithm::multiplier;
  return complaint_of_building(scene);
}

}  // namespace

TEST_CASE("a contact that leaves its algorithm to the scene has multipliers, one that names it keeps it") {
  CHECK(scene::Contact{}.algorithm == ContactAlgorithm::automatic);
  CHECK(chosen(blocks()) == "multipliers, the default");
  for (const ContactAlgorithm named : {ContactAlgorithm::penalty, ContactAlgorithm::multiplier}) {
    scene::Scene scene = blocks();
    scene.contacts[0].algorithm = named;
    Model model;
    build_model(scene, model);
    CHECK(model.scene.contacts[0].algorithm == named);
    CHECK(describe_algorithm(model.scene.contacts[0]) ==
          (named == ContactAlgorithm::penalty ? "penalty springs" : "multipliers"));
  }
}

TEST_CASE("keys of springs make it springs, the halves of a symmetric contact both") {
  scene::Scene scene = blocks();
  std::string key;
  SECTION("scale") {
    scene.contacts[0].penalty_scale = 2;
    key = "penalty_scale";
  }
  SECTION("growth, on smooth normals") {
    scene.contacts[0].penalty_growth = {{0, 1}, {1e-6, 4}};
    scene.contacts[0].normals = scene::ContactNormals::smooth;
    key = "penalty_growth";
  }
  SECTION("damping") {
    scene.contacts[0].damping = 0.1;
    key = "damping";
  }
  SECTION("symmetric") {
    scene.contacts[0].symmetric = true;
    key = "symmetric";
  }
  CHECK(chosen(scene) == "penalty springs, as " + key + " is of springs");
  Model model;
  build_model(scene, model);
  for (const ContactPair& pair : model.contacts) CHECK(pair.has_springs());
}

TEST_CASE("what multipliers refuse gets springs") {
  scene::Scene scene = blocks();
  std::string reason;
  SECTION("a non-reflecting end beside the surface") {
    scene::NonReflecting end;
    end.name = "side";
    end.target = "lower.x_max";
    scene.non_reflecting.push_back(end);
    reason = "nodes of its surfaces are of [non_reflecting.side]";
  }
  SECTION("both surfaces held") {
    hold(scene, "upper.z_min", {true, true, true});
    hold(scene, "lower.z_max", {true, true, true});
    reason = "holds or drives 'upper.z_min' along its normal";
  }
  CHECK_FALSE(complaint_with_multipliers(scene).empty());
  CHECK_THAT(chosen(scene), ContainsSubstring("penalty springs, as ") && ContainsSubstring(reason));
}

TEST_CASE("surfaces that overlap get springs where nothing settles") {
  scene::Scene scene = blocks(-1e-5);
  CHECK_THAT(chosen(scene), ContainsSubstring("penalty springs, as its surfaces overlap where the run begins"));
  scene.settle.active = true;
  CHECK(chosen(scene) == "multipliers, the default");
  CHECK(chosen(blocks(1e-5)) == "multipliers, the default");
}

TEST_CASE("each contact of a scene has its own choice, and the keys of kept states have them") {
  scene::Scene scene = blocks();
  scene.contacts.push_back(scene.contacts[0]);
  scene.contacts[1].name = "sides";
  scene.contacts[1].slave = "upper.x_min";
  scene.contacts[1].damping = 0.1;
  Model model;
  build_model(scene, model);
  CHECK_FALSE(model.contacts[0].has_springs());
  CHECK(model.contacts[1].has_springs());
  const std::string mixed = chosen_algorithms(model.scene);
  scene.contacts[1].damping = 0;
  Model alike;
  build_model(scene, alike);
  CHECK(chosen_algorithms(alike.scene) != mixed);
}
