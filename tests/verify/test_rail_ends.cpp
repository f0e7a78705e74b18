#include <catch2/catch_test_macros.hpp>

#include "tests/verify/march.hpp"

using namespace railwave;
using namespace railwave::verify;

namespace {

/// Faces in the plane x = `place`.
std::vector<Face> faces_at(const Assembly& assembly, double place) {
  std::vector<Face> faces;
  for (int e = 0; e < static_cast<int>(assembly.elements.size()); ++e)
    for (int side = 0; side < 6; ++side) {
      bool there = true;
      for (int n : assembly.face_nodes({e, side})) there = there && std::fabs(assembly.nodes[n][0] - place) < 1e-9;
      if (there) faces.push_back({e, side});
    }
  return faces;
}

/// Share of a packet's energy that is left in a coarse 54E1 rail with two non-reflecting ends. The packet is a velocity
/// along `direction` in the middle, a Gaussian times a cosine; it parts into two that run to both ends.
double left_in_rail(const Vec3& direction, double wavelength, double deviation, double time, bool open) {
  scene::Scene scene = block_scene({1, 1, 1}, {1, 1, 1}, time);
  scene.meshes[0].type = scene::MeshType::rail;
  scene::RailMesh& rail = scene.meshes[0].rail;
  rail.start = -2;
  rail.end = 2;
  rail.zone_size = 0.006;
  rail.section_size = 0.01;
  rail.coarse_size = rail.core_size = 0.04;
  rail.zone_start = -0.006;
  rail.zone_end = 0.006;
  rail.zone_width = 0.018;
  rail.zone_layers = 1;
  rail.web_columns = 2;
  rail.inclination = 0;
  set_hourglass(scene.parts[0], scene::HourglassType::stiffness, 0.05);
  Assembly assembly = assemble(scene);
  for (double side : {-2.0, 2.0}) {
    scene::NonReflecting end;
    end.name = side < 0 ? "near" : "far";
    end.target = "block." + end.name;
    assembly.surfaces[end.target] = faces_at(assembly, side);
    if (open) scene.non_reflecting.push_back(end);
  }
  Model model;
  build_model(scene, assembly, model);
  set_velocity(model, [&](const Vec3& x, int) {
    return (std::exp(-0.5 * std::pow(x[0] / deviation, 2)) * std::cos(2 * M_PI * x[0] / wavelength)) * direction;
  });
  const auto energy = [&] {
    const EnergyAccount now = account_energies(model, model.step_size);
    return now.kinetic + now.internal + now.hourglass;
  };
  double first = -1;
  march(model, model.step_count, [&] {
    if (first < 0) first = energy();
  });
  return energy() / first;
}

}  // namespace

TEST_CASE("a rail's ends let axial and bending packets out", "[long]") {
  const double axial = left_in_rail({1, 0, 0}, 1.5, 0.5, 1.2e-3, true);
  const double vertical = left_in_rail({0, 0, 1}, 0.5, 0.4, 3e-3, true),
               lateral = left_in_rail({0, 1, 0}, 0.5, 0.4, 4e-3, true);
  UNSCOPED_INFO("left in the rail: axial " << axial << ", vertical bending " << vertical << ", lateral bending "
                                           << lateral);
  // Uniform over the section, the axial packet is not a pure bar wave: some of it bends and thickens the rail.
  CHECK(axial < 0.05);
  CHECK(vertical < 0.1);
  CHECK(lateral < 0.1);
  // They would be there if the ends were free.
  CHECK(left_in_rail({0, 0, 1}, 0.5, 0.4, 3e-3, false) > 0.99);
}
