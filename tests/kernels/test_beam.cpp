#include <catch2/catch_test_macros.hpp>
#include <catch2/matchers/catch_matchers_floating_point.hpp>
#include <random>

#include "kernels/beams/beam_tangent.hpp"
#include "kernels/support/team.hpp"

using namespace railwave;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace {

/// One element from the origin along an oblique axis, far from its place and shape at the start.
struct Element {
  BeamArrays beams;
  Array<double*[3]> position { "position", 2 }, contribution{"contribution", 2};

  Element() {
    beams.count = 1;
    beams.node_count = 2;
    beams.end = Array<int* [2]>("end", 1);
    beams.axes = Array<double* [3][3]>("axes", 1);
    beams.length = Array<double*>("length", 1);
    beams.stiffness = Array<double* [3]>("stiffness", 1);
    beams.bending = Array<double* [3]>("bending", 1);
    beams.stretch = Array<double*>("stretch", 1);
    beams.pretension = Array<double*>("pretension", 1);
    beams.tightened = Array<int*>("tightened", 1);
    beams.node = Array<int*>("node", 2);
    beams.rotation = Array<double* [4]>("rotation", 2);
    beams.moment = Array<double* [3]>("moment", 2);
    const double axes[3][3] = {{2 / 7.0, 3 / 7.0, 6 / 7.0}, {3 / 7.0, -6 / 7.0, 2 / 7.0}, {6 / 7.0, 2 / 7.0, -3 / 7.0}};
    for (int i = 0; i < 3; ++i) {
      for (int k = 0; k < 3; ++k) beams.axes(0, i, k) = axes[i][k];
      beams.stiffness(0, i) = 5 - i;
      beams.bending(0, i) = 1 + 0.3 * i;
    }
    beams.end(0, 1) = beams.node(1) = 1;
    beams.length(0) = 0.8;
    beams.stretch(0) = 0.02;
    beams.pretension(0) = 3;
    beams.tightened(0) = 1;
    std::mt19937 generator(3);
    std::uniform_real_distribution<double> any(-1, 1);
    for (int n = 0; n < 2; ++n) {
      for (int i = 0; i < 3; ++i) position(n, i) = any(generator);
      turn(n, {{3 * any(generator), 3 * any(generator), 3 * any(generator)}});
    }
  }

  /// Turns a node on by a small angle, or sets its rotation to a large one.
  void turn(int n, const Vector3& angle) {
    const Quaternion before = norm(angle) < 0.1 ? quaternion(beams.rotation, n) : Quaternion{1, {{0, 0, 0}}};
    const Quaternion q = of_length_one(turn_about(angle) * before);
    beams.rotation(n, 0) = q.w;
    for (int i = 0; i < 3; ++i) beams.rotation(n, 1 + i) = q.v[i];
  }

  double energy() const {
    double sum = 0;
    BeamEnergy{beams, position}(0, &sum);
    return sum;
  }
};

}  // namespace

TEST_CASE("forces and moments of a beam, however bent, are the derivatives of its energy") {
  if constexpr (on_device) SKIP("works on host arrays");
  Element element;
  BeamForce{element.beams, element.position, element.contribution, false, 0}(0);
  const double h = 1e-6;
  for (int n = 0; n < 2; ++n)
    for (int i = 0; i < 3; ++i) {
      element.position(n, i) += h;
      const double ahead = element.energy();
      element.position(n, i) -= 2 * h;
      const double behind = element.energy();
      element.position(n, i) += h;
      CHECK_THAT(element.contribution(n, i), WithinAbs((behind - ahead) / (2 * h), 1e-8));
      Vector3 angle{{0, 0, 0}};
      angle[i] = h;
      element.turn(n, angle);
      const double turned_on = element.energy();
      element.turn(n, -2.0 * angle);
      const double turned_back = element.energy();
      element.turn(n, angle);
      CHECK_THAT(element.beams.moment(n, i), WithinAbs((turned_back - turned_on) / (2 * h), 1e-8));
    }
}

TEST_CASE("a beam, with a pretension held or not, leaves no resultant force and no resultant moment") {
  if constexpr (on_device) SKIP("works on host arrays");
  for (bool held : {false, true}) {
    Element element;
    BeamForce{element.beams, element.position, element.contribution, held, 0}(0);
    Vector3 force{{0, 0, 0}}, moment{{0, 0, 0}};
    for (int n = 0; n < 2; ++n) {
      force = force + row(element.contribution, n);
      moment = moment + cross(row(element.position, n), row(element.contribution, n)) + row(element.beams.moment, n);
    }
    CHECK(norm(row(element.contribution, 0)) > 1);
    CHECK(norm(force) < 1e-13);
    CHECK(norm(moment) < 1e-13);
    if (held) CHECK(beam_middle(element.beams, element.position, 0, true).force[0] == 3);
  }
}

TEST_CASE(
    "a beam's springs answer small motions as its forces do, where it is free of stress and wherever it has turned") {
  if constexpr (on_device) SKIP("works on host arrays");
  Element element;
  element.beams.stretch(0) = 0;
  const Vector3 angle{{0.4, -1.1, 0.7}};
  const Vector3 along{{2 / 7.0, 3 / 7.0, 6 / 7.0}};
  for (int n = 0; n < 2; ++n) {
    element.turn(n, angle);
    const Vector3 x = n == 0 ? Vector3{{0, 0, 0}} : turned(turn_about(angle), 0.8 * along);
    for (int i = 0; i < 3; ++i) element.position(n, i) = 3 + x[i];
  }
  const BeamTangent tangent{element.beams, element.position, false, Array<double* [8][4][3]>("share", 1),
                            Array<double* [8]>("stiffness", 1)};
  tangent(0);
  for (int s : {6, 7}) CHECK_THAT(tangent.stiffness(0, s), WithinAbs(0, 1e-12));
  const auto forces = [&](int row, int i) {
    BeamForce{element.beams, element.position, element.contribution, false, 0}(0);
    return row < 2 ? element.contribution(row, i) : element.beams.moment(row - 2, i);
  };
  const auto move = [&](int row, int i, double h) {
    Vector3 by{{0, 0, 0}};
    by[i] = h;
    if (row < 2)
      element.position(row, i) += h;
    else
      element.turn(row - 2, by);
  };
  const double h = 1e-5;
  for (int column = 0; column < 4; ++column)
    for (int j = 0; j < 3; ++j)
      for (int row = 0; row < 4; ++row)
        for (int i = 0; i < 3; ++i) {
          double stiffness = 0;
          for (int s = 0; s < 8; ++s)
            stiffness += tangent.stiffness(0, s) * tangent.share(0, s, row, i) * tangent.share(0, s, column, j);
          move(column, j, h);
          const double ahead = forces(row, i);
          move(column, j, -2 * h);
          const double behind = forces(row, i);
          move(column, j, h);
          CHECK_THAT(stiffness, WithinAbs((behind - ahead) / (2 * h), 1e-8));
        }
}

TEST_CASE("turns follow each other as rotation matrices do") {
  const Quaternion a = turn_about({{0.3, -1, 2}}), b = turn_about({{-2, 0.5, 0.1}});
  const Vector3 x{{1, 2, -3}};
  const Vector3 one_by_one = turned(a, turned(b, x)), at_once = turned(a * b, x),
                back = turned(reversed(a), turned(a, x));
  for (int i = 0; i < 3; ++i) {
    CHECK_THAT(at_once[i], WithinAbs(one_by_one[i], 1e-14));
    CHECK_THAT(back[i], WithinAbs(x[i], 1e-14));
  }
  const Vector3 quarter = turned(turn_about({{0, 0, M_PI / 2}}), Vector3{{1, 0, 0}});
  CHECK_THAT(quarter[1], WithinRel(1.0, 1e-15));
}
