// The table of fields: every row that a case may name has values, as many as it says.

#include <catch2/catch_test_macros.hpp>
#include <catch2/matchers/catch_matchers_floating_point.hpp>
#include <cmath>

#include "model/fields.hpp"
#include "output/hdf5/hdf5.hpp"
#include "output/histories/history_values.hpp"
#include "tests/verify/two_blocks.hpp"

using namespace railwave;
using namespace railwave::verify;
using Catch::Matchers::WithinRel;

TEST_CASE("every field that output.fields may name can be fetched, with the components that the table tells") {
  scene::Scene scene = TwoBlocks{}.scene(1e-5);
  scene.contacts.clear();
  Model model;
  build_model(scene, model);
  const std::vector<int> asked{7, 0, 7};
  for (const FieldRow* row : fields_for(FieldRow::fields)) {
    CAPTURE(row->name);
    const HostField field = output_field(model, model, model.ties, *row, asked);
    CHECK(field.components == row->components);
    CHECK(field.values.size() == asked.size() * row->components);
    CHECK(output_field(model, model, model.ties, *row, {}).values.empty());
  }
  const FieldRow unknown{"temperature", FieldRow::Place::node, 1, "K", FieldRow::fields, ""};
  CHECK_THROWS_AS(output_field(model, model, model.ties, unknown, asked), std::logic_error);
}

TEST_CASE("the field mises is von Mises' equivalent of the Cauchy stress") {
  scene::Scene scene = TwoBlocks{}.scene(1e-5);
  scene.contacts.clear();
  scene.solver.precision = scene::Precision::double_precision;
  Model model;
  build_model(scene, model);
  // Uniaxial strain e gives the principal differences 2 mu e, 2 mu e and 0; simple shear g adds the stress xy = mu g.
  const double e = 1e-6, g = 2e-6, mu = 210e9 / 2.6;
  set_position(model, [&](const Vec3& x, int) { return Vec3{(1 + e) * x[0] + g * x[1], x[1], x[2]}; });
  const double expected = std::sqrt(4 * mu * mu * e * e + 3 * mu * mu * g * g);
  const HostField field = output_field(model, model, model.ties, field_named("mises"), {0, 5});
  REQUIRE(field.values.size() == 2);
  // The law's second order is of the size of the strains.
  for (const double value : field.values) CHECK_THAT(value, WithinRel(expected, 10 * (e + g)));
}

TEST_CASE("every quantity of histories has its place in the means of a set") {
  for (const FieldRow* row : fields_for(FieldRow::histories, FieldRow::Place::node))
    CHECK(motion_values(*row) != nullptr);
  for (const FieldRow* row : fields_for(FieldRow::histories, FieldRow::Place::element))
    CHECK(element_values(*row) != nullptr);
  const MeanMotion motion{{1, 2, 3}, {4, 5, 6}, {7, 8, 9}};
  CHECK(*motion_values(field_named("velocity"))(motion) == 4);
  ElementMeans means;
  means.plastic_strain = 0.5;
  CHECK(*element_values(field_named("plastic_strain"))(means) == 0.5);
  CHECK_THROWS_AS(motion_values(field_named("stress")), std::logic_error);
}

TEST_CASE("names of fields are unique, and their datasets have the table's units") {
  for (const FieldRow& row : field_table()) {
    CAPTURE(row.name);
    CHECK(&field_named(row.name) == &row);
    CHECK((row.components == 1 || row.components == 3 || row.components == 6));
    if (row.serves(FieldRow::fields)) CHECK(unit_of(std::string("/fields/rail/") + row.name) == row.unit);
    if (row.serves(FieldRow::histories))
      CHECK(unit_of(std::string("/history/set/rail.middle/") + row.name) == row.unit);
  }
  CHECK(find_field("temperature") == nullptr);
  CHECK_THROWS_AS(field_named("temperature"), std::logic_error);
  CHECK(unit_of("/fields/rail/temperature").empty());
}
