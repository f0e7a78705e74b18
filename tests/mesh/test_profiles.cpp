#include <catch2/catch_test_macros.hpp>
#include <catch2/matchers/catch_matchers_floating_point.hpp>
#include <cmath>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "mesh/sections/profiles.hpp"
#include "source_folder.hpp"

using namespace railwave;
using Catch::Matchers::WithinAbs;

namespace {

std::vector<std::vector<double>> table(const std::string& name) {
  std::ifstream file(source_folder + "/data/" + name);
  REQUIRE(file.good());
  std::vector<std::vector<double>> rows;
  for (std::string text; std::getline(file, text);) {
    if (text.empty() || text[0] == '#') continue;
    std::stringstream line(text);
    rows.emplace_back();
    for (std::string value; std::getline(line, value, ',');) rows.back().push_back(std::strtod(value.c_str(), nullptr));
  }
  return rows;
}

double distance_to(const Curve& curve, Point2 p) {
  double best = 1e300, at = 0;
  for (int i = 0; i <= 2000; ++i) {
    const double s = curve.length * i / 2000, d = norm(curve.at(s) - p);
    if (d < best) best = d, at = s;
  }
  double low = std::max(0.0, at - curve.length / 2000), high = std::min(curve.length, at + curve.length / 2000);
  for (int i = 0; i < 60; ++i) {
    const double a = low + (high - low) / 3, b = high - (high - low) / 3;
    (norm(curve.at(a) - p) < norm(curve.at(b) - p) ? high : low) =
        norm(curve.at(a) - p) < norm(curve.at(b) - p) ? b : a;
  }
  return std::min(best, norm(curve.at((low + high) / 2) - p));
}

}  // namespace

TEST_CASE("S1002 agrees with its table in height and slope") {
  const auto rows = table("S1002_profile.csv");
  REQUIRE(rows.size() > 400);
  for (const auto& row : rows) {
    const double s = 1e-3 * row[0];
    CHECK_THAT(1e3 * s1002_height(s), WithinAbs(row[1], 2e-6));
    if (std::isfinite(row[2]) && std::abs(row[2]) < 1e6)
      CHECK_THAT(s1002_slope(s), WithinAbs(row[2], 2e-6 * (1 + std::abs(row[2]))));
  }
  CHECK_THAT(s1002_height(0), WithinAbs(0, 1e-15));
  CHECK_THAT(s1002_height(-0.055), WithinAbs(0.028, 1e-9));
}

TEST_CASE("S1002 is continuous with a continuous slope at its sections' joints") {
  for (double s : {32.15796, -26.0, -35.0, -38.426669071, -39.764473993, -49.662510381, -62.764705882}) {
    // The published coefficients themselves leave a jump of 0.12 micrometres at s = -35 mm.
    CHECK_THAT(s1002_height(1e-3 * s + 1e-12), WithinAbs(s1002_height(1e-3 * s - 1e-12), 1.3e-7));
    CHECK_THAT(s1002_slope(1e-3 * s + 1e-12), WithinAbs(s1002_slope(1e-3 * s - 1e-12), 5e-4));
  }
}

TEST_CASE("Rail outlines pass through the points of their tables") {
  for (const std::string section : {"54E1", "60E1"}) {
    const RailOutline outline = rail_outline(section);
    const Curve whole =
        joined({outline.head, outline.underside, outline.web, outline.foot_top, outline.toe, outline.base});
    double worst = 0;
    const auto rows = table("rail_" + section + "_outline.csv");
    for (std::size_t i = 0; i < rows.size(); i += 7)
      if (rows[i][0] >= 0) worst = std::max(worst, distance_to(whole, {1e-3 * rows[i][0], 1e-3 * rows[i][1]}));
    INFO(section);
    CHECK(worst < 5e-8);
    CHECK_THAT(outline.base.end().y, WithinAbs(0, 1e-12));
    CHECK_THAT(outline.head.begin().z, WithinAbs(section == "54E1" ? 0.159 : 0.172, 1e-12));
  }
  CHECK_THROWS_AS(rail_outline("UIC60"), std::invalid_argument);
}

TEST_CASE("Curves run at unit speed and end where they should") {
  const Curve profile = s1002_curve(0.46, 0.06);
  const RailOutline outline = rail_outline("54E1");
  for (const Curve& curve :
       {profile, outline.head, reversed(outline.web), arc({1, 0}, {0, 1}, 1), arc({0, 1}, {1, 0}, -1)}) {
    double length = 0;
    Point2 before = curve.begin();
    for (int i = 1; i <= 4000; ++i) {
      const Point2 now = curve.at(curve.length * i / 4000);
      const double speed = norm(now - before) / (curve.length / 4000);
      CHECK_THAT(speed, WithinAbs(1, 3e-3));  // of 30 micrometres, across the profile's own jump
      length += norm(now - before);
      before = now;
    }
    CHECK_THAT(length / curve.length, WithinAbs(1, 2e-6));
  }
  CHECK_THAT(profile.begin().y, WithinAbs(s1002_flange_back_joint, 1e-12));
  CHECK_THAT(profile.end().y, WithinAbs(0.06, 1e-12));
  const Point2 middle = arc({1, 0}, {0, 1}, 1).at(std::acos(-1.0) / 4);
  CHECK_THAT(middle.y, WithinAbs(std::sqrt(0.5), 1e-12));
  CHECK_THAT(middle.z, WithinAbs(std::sqrt(0.5), 1e-12));
}
