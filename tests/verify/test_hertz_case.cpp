#include <catch2/catch_test_macros.hpp>
#include <catch2/matchers/catch_matchers_floating_point.hpp>

#include "case/read_case.hpp"
#include "post/contact_patch.hpp"
#include "source_folder.hpp"
#include "tests/verify/march.hpp"

using namespace railwave;
using namespace railwave::verify;
using Catch::Matchers::WithinRel;

// The whole table is scripts/verify_contact's matter; here the case is run coarsely, six elements over the patch.
TEST_CASE("the case of Hertz's sphere on a plane comes near Hertz's solution on a coarse mesh") {
  std::vector<std::string> changed{"contacts.hertz.algorithm=multiplier", "settle.tolerance=5e-3",
                                   "meshes.block.zone_centre=0.00055"};
  for (const std::string mesh : {"sphere", "block"})
    for (const char* key : {"zone_size=2.4e-3", "zone_layers=3", "growth=1.5", "coarse_size=0.04"})
      changed.push_back("meshes." + mesh + "." + key);
  const scene::Scene scene = read_case(source_folder + "/cases/verify/hertz_sphere.toml", changed);
  Model model;
  build_model(scene, model);
  const SettleReport report = settle_whole(model);
  CHECK(report.settled);
  compute_forces(model);
  const ContactPatch found = contact_solution(contact_state(model, model.ties, model.contacts, 0)).whole;

  const double force = found.normal_force, radius = 0.46, modulus = 210e9 / (2 * (1 - 0.09));
  const double a = std::cbrt(0.75 * force * radius / modulus);
  INFO("force " << force << " N, peak " << found.peak_nodal_pressure / (1.5 * force / (M_PI * a * a)) << ", area "
                << found.area / (M_PI * a * a) << " of Hertz's; settled in " << report.steps << " steps");
  CHECK_THAT(force, WithinRel(126680.0, 0.1));
  CHECK_THAT(found.peak_nodal_pressure, WithinRel(1.5 * force / (M_PI * a * a), 0.06));
  CHECK_THAT(found.area, WithinRel(M_PI * a * a, 0.1));
}

// A node of the sphere that lies on a node of the block has four facets below it, whose normals differ.
TEST_CASE("nodes that meet exactly come to rest with smooth normals") {
  std::vector<std::string> changed{"contacts.hertz.algorithm=multiplier", "contacts.hertz.normals=smooth",
                                   "settle.tolerance=2e-3", "settle.max_steps=3000", "meshes.block.zone_centre=0"};
  for (const std::string mesh : {"sphere", "block"})
    for (const char* key : {"zone_size=2.4e-3", "zone_layers=3", "growth=1.5", "coarse_size=0.04", "zone_start=-0.012",
                            "zone_end=0.012", "zone_width=0.024"})
      changed.push_back("meshes." + mesh + "." + key);
  const scene::Scene scene = read_case(source_folder + "/cases/verify/hertz_sphere.toml", changed);
  Model model;
  build_model(scene, model);
  const SettleReport report = settle_whole(model);
  INFO("unbalanced force " << report.unbalance << " of all after " << report.steps << " steps");
  CHECK(report.settled);
}
