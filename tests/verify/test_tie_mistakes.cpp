#include <catch2/catch_test_macros.hpp>
#include <catch2/matchers/catch_matchers_string.hpp>

#include "case/error.hpp"
#include "tests/verify/tied_blocks.hpp"

using namespace railwave;
using namespace railwave::verify;
using Catch::Matchers::ContainsSubstring;

TEST_CASE("what cannot be tied is refused, with where and why") {
  TiedBlocks blocks;
  scene::Scene scene = blocks.scene(1e-5);
  CHECK(complaint_of_building(scene).empty());
  SECTION("too far") {
    scene.parts[1].position[2] += 0.004;
    CHECK_THAT(complaint_of_building(scene),
               ContainsSubstring("100 of the 100 nodes of 'fine.z_min' have no face of 'coarse.z_max' near enough"));
    CHECK_THAT(complaint_of_building(scene), ContainsSubstring("0, 0.064) m, 0.004 m from it (allowed: 0.00283 m); ("));
    scene.ties[0].max_distance = 0.005;
    CHECK(complaint_of_building(scene).empty());
  }
  SECTION("beside") {
    scene.parts[1].position[0] += 0.012;
    CHECK_THAT(complaint_of_building(scene), ContainsSubstring("20 of the 100 nodes"));
  }
  SECTION("tied twice") {
    scene.ties.push_back(scene.ties[0]);
    scene.ties[1].name = "again";
    CHECK_THAT(complaint_of_building(scene),
               ContainsSubstring("0.06) m is tied by [ties.grown] already; name surfaces without common nodes"));
  }
  SECTION("each other's slave") {
    scene.meshes[1].box.divisions = {3, 3, 3};
    scene.ties.push_back(scene.ties[0]);
    scene.ties[1].name = "back";
    std::swap(scene.ties[1].slave, scene.ties[1].master);
    CHECK_THAT(complaint_of_building(scene),
               ContainsSubstring("ties.grown") && ContainsSubstring("is of a slave and of a master"));
  }
  SECTION("coarse slave") {
    std::swap(scene.ties[0].slave, scene.ties[0].master);
    CHECK_THAT(complaint_of_building(scene), ContainsSubstring("the slave is the coarser mesh there"));
  }
  SECTION("held") {
    hold(scene, "fine.x_min", {true, false, false});
    CHECK_THAT(complaint_of_building(scene),
               ContainsSubstring("is held by a constraint that does not hold the face under it"));
    hold(scene, "coarse.x_min", {true, false, false});
    CHECK(complaint_of_building(scene).empty());
  }
  SECTION("moved") {
    scene::PrescribedMotion motion;
    motion.name = "driven";
    motion.target = "fine.z_min";
    scene.prescribed_motions.push_back(motion);
    CHECK_THAT(complaint_of_building(scene), ContainsSubstring("moves as [prescribed_motion.driven] says"));
  }
  SECTION("end") {
    scene::NonReflecting end;
    end.name = "open";
    end.target = "fine.x_max";
    scene.non_reflecting.push_back(end);
    CHECK_THAT(complaint_of_building(scene), ContainsSubstring("belongs to [non_reflecting.open]"));
    scene.non_reflecting[0].target = "coarse.x_max";
    CHECK(complaint_of_building(scene).empty());
  }
  SECTION("multiplier") {
    scene.parts.push_back(scene.parts[0]);
    scene.parts[2].name = "third";
    scene.parts[2].position = {0.06, 0, 0.06};
    scene::Contact contact;
    contact.name = "touch";
    contact.slave = "fine.x_max";
    contact.master = "third.x_min";
    contact.algorithm = scene::ContactAlgorithm::multiplier;
    scene.contacts.push_back(contact);
    CHECK_THAT(complaint_of_building(scene), ContainsSubstring("whose algorithm \"multiplier\" cannot predict"));
    scene.contacts[0].algorithm = scene::ContactAlgorithm::penalty;
    CHECK(complaint_of_building(scene).empty());
  }
}

TEST_CASE("a scene without ties computes none") {
  const auto names = [](const scene::Scene& scene) {
    Model model;
    build_model(scene, model);
    std::string all;
    for (const Task& task : make_plan(model, StepKind::advancing).forces) all += task.name + "\n";
    for (const std::string& what : model.left_out) all += "left out: " + what + "\n";
    return all;
  };
  scene::Scene scene = TiedBlocks{}.scene(1e-5);
  CHECK_THAT(names(scene), ContainsSubstring("\nforces of ties\n") && !ContainsSubstring("ties between meshes"));
  scene.ties.clear();
  CHECK_THAT(names(scene), !ContainsSubstring("of ties\n") && ContainsSubstring("left out: ties between meshes"));
}
