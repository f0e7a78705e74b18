#include <catch2/catch_test_macros.hpp>
#include <catch2/matchers/catch_matchers_floating_point.hpp>

#include "tests/verify/march.hpp"
#include "tests/verify/scene_entries.hpp"

using namespace railwave;
using namespace railwave::verify;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace {

constexpr double angle = 0.02;

/// A crowned roller above a plate.
scene::Scene roller_on_plate(double angle_of_attack) {
  scene::Scene scene = block_scene({0.2, 0.2, 0.02}, {8, 8, 2}, 1e-4);
  scene.parts[0].position = {-0.1, -0.1, -0.02};
  scene::MeshSource mesh;
  mesh.name = "roller";
  mesh.type = scene::MeshType::roller;
  mesh.roller.radius = 0.1;
  mesh.roller.bore_radius = 0.05;
  mesh.roller.side_start = -0.02;
  mesh.roller.side_end = 0.02;
  mesh.roller.ring = true;
  mesh.roller.zone_size = 0.005;
  scene.meshes.push_back(mesh);
  scene::Part part;
  part.name = part.mesh = "roller";
  part.material = "steel";
  part.position = {0.01, 0.02, 0.15};
  part.angle_of_attack = angle_of_attack;
  scene.parts.push_back(part);
  scene::NodeSet side;
  side.name = "side";
  side.part = "roller";
  side.box = {{{-1, 0.0399, -1}, {1, 0.0401, 1}}};  // y of its side before it is turned
  scene.node_sets.push_back(side);
  scene::Contact contact;
  contact.name = "tread";
  contact.slave = "roller.tread";
  contact.master = "block.z_max";
  contact.close_gap = Vec3{0, 0, -1};
  scene.contacts.push_back(contact);
  return scene;
}

const Vec3 turned_axle{-std::sin(angle), std::cos(angle), 0};

}  // namespace

TEST_CASE("an angle of attack turns a part about the vertical through its origin, and the gap is closed after that") {
  const Assembly straight = assemble(roller_on_plate(0)), turned = assemble(roller_on_plate(angle));
  const auto& side = turned.node_sets.at("roller.side");
  CHECK(side == straight.node_sets.at("roller.side"));
  for (int n : turned.node_sets.at("roller")) {
    const Vec3 a = straight.nodes[n] - Vec3{0.01, 0.02, 0}, b = turned.nodes[n] - Vec3{0.01, 0.02, 0};
    CHECK_THAT(b[0], WithinAbs(std::cos(angle) * a[0] - std::sin(angle) * a[1], 1e-15));
    CHECK_THAT(b[1], WithinAbs(std::sin(angle) * a[0] + std::cos(angle) * a[1], 1e-15));
  }
  double lowest = 1;
  for (int n : turned.node_sets.at("roller.tread")) lowest = std::min(lowest, turned.nodes[n][2]);
  CHECK_THAT(lowest, WithinAbs(0, 1e-15));
  CHECK(turned.nodes[0] == straight.nodes[0]);  // the plate's
}

TEST_CASE("spin and torque of a part with an angle of attack are about its own axle, and it travels straight on") {
  scene::Scene scene = roller_on_plate(angle);
  scene.contacts.clear();
  add_motion(scene, {"roller"}, {10, 0, 0}, {0, 100, 0});
  add_torque(scene, "roller.bore", 1000, {0, 1, 0});
  Model model;
  build_model(scene, model);
  set_initial_motion(model, model.nodes, model.beams);
  const auto& nodes = model.assembly.node_sets.at("roller");
  const auto moment = [&](NodeField field) {
    const auto v = node_field(model, model.ties, field, nodes).values;
    const Vec3 centre = mean(model, NodeField::position, nodes);
    Vec3 sum{};
    for (std::size_t k = 0; k < nodes.size(); ++k)
      sum = sum + model.mass[nodes[k]] *
                      cross(model.assembly.nodes[nodes[k]] - centre, Vec3{v[3 * k], v[3 * k + 1], v[3 * k + 2]});
    return sum;
  };
  compute_forces(model);
  const Vec3 torque = moment(NodeField::acceleration), spin = moment(NodeField::velocity),
             travel = mean(model, NodeField::velocity, nodes);
  for (int i = 0; i < 3; ++i) {
    CHECK_THAT(torque[i], WithinAbs(1000 * turned_axle[i], 1e-6));
    CHECK_THAT(spin[i] / norm(spin),
               WithinAbs(turned_axle[i], 1e-3));  // the mesh is not quite symmetric about its axle
  }
  CHECK_THAT(travel[0], WithinRel(10.0, 1e-9));
  CHECK_THAT(travel[1], WithinAbs(0, 1e-9));
}
