// Frames, equivalent ellipses and cuts of a patch, on regular, graded and skewed meshes.

#include <catch2/catch_test_macros.hpp>
#include <catch2/generators/catch_generators.hpp>
#include <catch2/matchers/catch_matchers_floating_point.hpp>

#include "post/centre_cut.hpp"
#include "post/contact_patch.hpp"
#include "tests/post/hertz_contact.hpp"
#include "tests/post/made_up_surfaces.hpp"

using namespace railwave;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace {

/// A Hertzian patch, turned by `turn` about its centre, on skewed facets of 0.6 to 0.9 mm.
ContactState turned_patch(const HertzContact& hertz, double turn) {
  const Vector middle(16e-3, 11e-3, 0);
  const auto place = [&](int i, int j) { return Vector(skewed_place(i, j, 0.6e-3) - middle); };
  ContactSide slave = made_up_side(42, 38, false, place);
  const double c = std::cos(turn), s = std::sin(turn);
  press(
      slave, [&](const Vector& p) { return hertz.pressure(c * p[0] + s * p[1], c * p[1] - s * p[0]); },
      [&](const Vector& p) {
        const double size = hertz.shear(c * p[0] + s * p[1], c * p[1] - s * p[0]);
        return Vector(c * size, s * size, 0);
      });
  return made_up_state(std::move(slave), made_up_side(42, 38, true, place), hertz.friction);
}

}  // namespace

TEST_CASE("the axes of a patch") {
  const LocalFrame top = local_frame(Vector(1, 2, 3), Vector(0, 0, 5), Vector(2, 0, 0));
  CHECK((top.along - Vector::UnitX()).norm() < 1e-12);
  CHECK((top.across - Vector::UnitY()).norm() < 1e-12);
  CHECK((top.place(Vector(1.5, 2.25, 3.125)) - Vector(0.5, 0.25, 0.125)).norm() < 1e-12);
  const LocalFrame under = local_frame(Vector::Zero(), Vector(0, 0, -1), Vector::UnitX());  // the rail as the slave
  CHECK((under.across - Vector::UnitY()).norm() < 1e-12);
  const LocalFrame back = local_frame(Vector::Zero(), Vector::UnitZ(), -Vector::UnitX());
  CHECK((back.across + Vector::UnitY()).norm() < 1e-12);  // left of who goes backwards
  const LocalFrame flange = local_frame(Vector::Zero(), Vector(0.05, -0.9, 0.4), Vector::UnitX());
  CHECK(std::fabs(flange.along.dot(flange.normal)) < 1e-12);
  CHECK(std::fabs(flange.along.dot(flange.across)) < 1e-12);
  CHECK(flange.across[1] > 0.3);
  CHECK(flange.along[0] > 0.99);
  const LocalFrame wall = local_frame(Vector::Zero(), Vector::UnitY(), Vector::UnitX());
  CHECK((wall.across - Vector::UnitZ()).norm() < 1e-12);  // up a vertical face
  const LocalFrame head_on = local_frame(Vector::Zero(), Vector::UnitX(), Vector::UnitX());
  CHECK((head_on.along - Vector::UnitZ()).norm() < 1e-12);
}

TEST_CASE("semi-axes from second moments, whichever way the patch is turned") {
  const double turn = GENERATE(0.0, 0.3, -0.5, 0.7);
  const HertzContact hertz;
  const ContactPatch patch = contact_solution(turned_patch(hertz, turn)).patches.at(0);
  CHECK_THAT(patch.ellipse.semi_axis_along, WithinRel(hertz.a, 0.01));
  CHECK_THAT(patch.ellipse.semi_axis_across, WithinRel(hertz.b, 0.01));
  CHECK_THAT(patch.ellipse.turn, WithinAbs(turn, 0.03));
  CHECK_THAT(patch.normal_force, WithinRel(hertz.normal_force(), 0.005));
  CHECK_THAT(std::hypot(patch.creep_force, patch.lateral_force), WithinRel(hertz.creep_force(), 0.01));
  CHECK_THAT(std::atan2(patch.lateral_force, patch.creep_force), WithinAbs(turn, 1e-9));
  CHECK_THAT(patch.area, WithinRel(hertz.area(), 0.02));
  CHECK_THAT(patch.peak_facet_pressure, WithinRel(hertz.p0, 0.015));
}

TEST_CASE("a patch wider than long keeps its longitudinal semi-axis first") {
  HertzContact hertz;
  std::swap(hertz.a, hertz.b);
  const ContactPatch patch = contact_solution(turned_patch(hertz, 0.2)).patches.at(0);
  CHECK_THAT(patch.ellipse.semi_axis_along, WithinRel(hertz.a, 0.01));
  CHECK_THAT(patch.ellipse.semi_axis_across, WithinRel(hertz.b, 0.01));
  CHECK_THAT(patch.ellipse.turn, WithinAbs(0.2, 0.03));
}

TEST_CASE("one node alone is a patch without size, wherever it lies") {
  for (int k = 0; k < 100; ++k) {
    ContactSide side;
    side.nodes = {0, 1};
    const double x = 0.1 * k + 1e-3 / (k + 1.0);
    side.position = {x, 0.3 * x, 0.7 - x, x, 0.3 * x, 0.7 - x};
    const LocalFrame frame = local_frame(Vector(x + 1e-9, 0.3 * x, 0.7 - x), Vector(0.1, 0.02 * k, 5), Vector(1, 0, 0));
    const EquivalentEllipse ellipse = equivalent_ellipse(side, {0, 1}, {300.1 + k, 1e-3}, frame);
    CHECK_THAT(ellipse.semi_axis_along, WithinAbs(0, 1e-6));
    CHECK_THAT(ellipse.semi_axis_across, WithinAbs(0, 1e-6));
  }
}

TEST_CASE("cuts through the centre carry linear fields exactly") {
  ContactState state = turned_patch(HertzContact{}, 0);
  press(
      state.slave, [](const Vector& p) { return 1e8 * (2 + 20 * p[0] - 30 * p[1]); },
      [](const Vector& p) { return Vector(1e9 * p[0], 1e7, 0); });
  set_vectors(state.slave, state.slave.velocity,
              [](const Vector& p) { return Vector(10 * p[1], 20 * p[0], 30 * p[0]); });
  const ContactPatch patch = contact_solution(state).patches.at(0);
  REQUIRE(patch.touching.size() == state.slave.nodes.size());
  for (const CutDirection direction : {CutDirection::along, CutDirection::across}) {
    const std::vector<CutPoint> cut = centre_cut(state, patch, direction);
    REQUIRE(cut.size() > 100);
    for (const CutPoint& point : cut) {
      const Vector p = patch.frame.centre +
                       point.distance * (direction == CutDirection::along ? patch.frame.along : patch.frame.across);
      CHECK_THAT(point.pressure, WithinAbs(1e8 * (2 + 20 * p[0] - 30 * p[1]), 1));
      CHECK_THAT(point.bound, WithinRel(state.friction * point.pressure, 1e-12));
      CHECK_THAT(point.shear[0], WithinAbs(1e9 * p[0], 1));
      CHECK_THAT(point.shear[1], WithinAbs(1e7, 1));
      CHECK_THAT(point.micro_slip[0], WithinAbs(10 * p[1], 1e-9));
      CHECK_THAT(point.micro_slip[1], WithinAbs(20 * p[0], 1e-9));
      CHECK_THAT(point.parting, WithinAbs(30 * p[0], 1e-9));
    }
  }
}

TEST_CASE("a cut of a Hertzian patch shows its profile, bound and stick region") {
  const HertzContact hertz;
  HertzGrid grid;
  grid.x0 += 0.2e-3;
  grid.y0 += 0.3e-3;
  const ContactState state = hertz_contact_state(hertz, grid, HertzForces::sampled);
  const ContactPatch patch = contact_solution(state).patches.at(0);
  const std::vector<CutPoint> cut = centre_cut(state, patch, CutDirection::along);
  double error = 0, slip_until = -1;
  for (const CutPoint& point : cut) {
    const double x = patch.frame.centre[0] + point.distance, y = patch.frame.centre[1];
    if (std::fabs(x) < 5e-3) error = std::max(error, std::fabs(point.pressure - hertz.pressure(x, y)));
    CHECK(point.shear.norm() <= point.bound * (1 + 1e-9) + 1);
    if (point.pressure > 0 && point.slip_by_force > 0.5) slip_until = std::max(slip_until, x);
    if (point.pressure > 0) CHECK((point.slip_by_velocity > 0.5) == (point.slip_by_force > 0.5));
  }
  CHECK(error < 0.03 * hertz.p0);
  CHECK_THAT(slip_until, WithinAbs(hertz.a * (1 - 2 * hertz.stick), 1e-3));  // a cell
}
