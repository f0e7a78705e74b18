#include <catch2/catch_test_macros.hpp>
#include <catch2/matchers/catch_matchers_floating_point.hpp>
#include <algorithm>
#include <random>

#include "kernels/contact_normals.hpp"
#include "tests/kernels/master_surface.hpp"

using namespace railwave;
using Catch::Matchers::WithinAbs;

namespace {

/// Facets around the y axis at radius 1 about z, two wide.
ContactSearch ring(int facets, double angle) {
  std::vector<Point> nodes;
  std::vector<Quad> quads;
  for (int i = 0; i <= facets; ++i)
    for (double y : {-0.1, 0.0, 0.1}) nodes.push_back({std::sin((i - 0.5 * facets) * angle), y, std::cos((i - 0.5 * facets) * angle)});
  for (int i = 0; i < facets; ++i)
    for (int j = 0; j < 2; ++j) quads.push_back({3 * i + j, 3 * i + 3 + j, 3 * i + 4 + j, 3 * i + 1 + j});
  return search_on(nodes, quads);
}

struct Both {
  Projection facet, smooth;
};

struct Look {
  ContactSearch search;
  Array<const double* [3]> slave;
  Array<Both*> found;
  KOKKOS_INLINE_FUNCTION void operator()(const int i) const {
    const Vector3 x = row(slave, i);
    const Projection facet = search.locate(x, 0);
    found(i) = {facet, SmoothNormals::turned(search, x, facet)};
  }
};

std::vector<Both> look(const ContactSearch& search, const std::vector<Point>& places) {
  const Array<Both*> found("found", places.size());
  Kokkos::parallel_for("look", Range(0, static_cast<int>(places.size())), Look{search, to_device("places", places), found});
  const auto host = to_host(found);
  return {host.data(), host.data() + places.size()};
}

Point at(double angle, double y, double radius) { return {radius * std::sin(angle), y, radius * std::cos(angle)}; }

}  // namespace

TEST_CASE("smooth normals make a circle of facets, and the forces lie in one line", "[contact]") {
  constexpr double angle = 0.1, sagitta = angle * angle / 8;
  const ContactSearch search = ring(9, angle);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> around(-0.3, 0.3), aside(-0.09, 0.09), height(-0.004, 0.004);
  std::vector<Point> places;
  std::vector<double> heights;
  for (int i = 0; i < 2000; ++i) {
    heights.push_back(height(random));
    places.push_back(at(around(random), aside(random), 1 + heights.back()));
  }
  const auto found = look(search, places);
  double largest_gap = 0, largest_turn = 0, largest_aside = 0, facet_gap = 0;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const Projection& p = found[i].smooth;
    const double radius = 1 + heights[i];
    const Vector3 radial{{places[i][0] / radius, 0, places[i][2] / radius}};
    largest_gap = std::max(largest_gap, std::fabs(p.gap - heights[i]));
    facet_gap = std::max(facet_gap, std::fabs(found[i].facet.gap - heights[i]));
    largest_turn = std::max(largest_turn, norm(p.normal - radial));
    largest_aside = std::max(largest_aside, norm(p.offset - dot(p.offset, p.normal) * p.normal));
  }
  INFO("gap off by " << largest_gap << ", of the facets by " << facet_gap << ", normal by " << largest_turn << ", offset aside by " << largest_aside);
  CHECK(facet_gap > 0.9 * sagitta);
  CHECK(largest_gap < 2e-3 * sagitta);
  CHECK(largest_turn < 1e-4);
  CHECK(largest_aside < 1e-12);
}

TEST_CASE("smooth normals do not jump from facet to facet", "[contact]") {
  constexpr double angle = 0.1;
  const ContactSearch search = ring(8, angle);
  for (double height : {-0.002, 0.002}) {
    const auto found = look(search, {at(-1e-9, 0.03, 1 + height), at(1e-9, 0.03, 1 + height), at(0, 0.03, 1 + height),
                                     at(-1e-3, 0.03, 1 + height), at(1e-3, 0.03, 1 + height)});
    INFO("height " << height << ", normals turn by " << norm(found[1].smooth.normal - found[0].smooth.normal));
    CHECK(norm(found[4].facet.normal - found[3].facet.normal) > 0.9 * angle);
    CHECK(norm(found[1].smooth.normal - found[0].smooth.normal) < 1e-7);
    CHECK_THAT(found[1].smooth.gap, WithinAbs(found[0].smooth.gap, 1e-12));
    CHECK_THAT(found[2].smooth.gap, WithinAbs(height, 1e-12));
    CHECK(norm(found[2].smooth.normal - Vector3{{0, 0, 1}}) < 1e-12);
  }
}

TEST_CASE("facets that meet at more than 30 degrees keep their edge", "[contact]") {
  const ContactSearch search = ring(5, 0.6);
  const auto found = look(search, {at(0.1, 0.03, 0.93), at(0.5, -0.03, 0.93), at(-0.2, 0.05, 0.94)});
  for (const Both& both : found) {
    CHECK(both.smooth.segment == both.facet.segment);
    CHECK_THAT(both.smooth.gap, WithinAbs(both.facet.gap, 1e-14));
    CHECK(norm(both.smooth.normal - both.facet.normal) < 1e-14);
  }
}
