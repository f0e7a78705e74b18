#include <algorithm>
#include <catch2/catch_test_macros.hpp>
#include <catch2/matchers/catch_matchers_floating_point.hpp>
#include <random>

#include "kernels/contact/contact_normals.hpp"
#include "tests/kernels/master_surface.hpp"

using namespace railwave;
using Catch::Matchers::WithinAbs;

namespace {

/// Facets around the y axis at radius 1 about z, two wide.
ContactSearch ring(int facets, double angle) {
  std::vector<Point> nodes;
  std::vector<Quad> quads;
  for (int i = 0; i <= facets; ++i)
    for (double y : {-0.1, 0.0, 0.1})
      nodes.push_back({std::sin((i - 0.5 * facets) * angle), y, std::cos((i - 0.5 * facets) * angle)});
  for (int i = 0; i < facets; ++i)
    for (int j = 0; j < 2; ++j) quads.push_back({3 * i + j, 3 * i + 3 + j, 3 * i + 4 + j, 3 * i + 1 + j});
  return search_on(nodes, quads);
}

struct Both {
  Projection facet, smooth;
};

struct Nearest {
  ContactSearch search;
  Array<const double* [3]> slave;
  Array<Both*> found;
  KOKKOS_INLINE_FUNCTION void operator()(const int i) const {
    const Vector3 x = row(slave, i);
    const Projection facet = search.locate(x, 0);
    found(i) = {facet, SmoothNormals::turned(search, x, facet)};
  }
};

std::vector<Both> nearest(const ContactSearch& search, const std::vector<Point>& places) {
  const Array<Both*> found("found", places.size());
  Kokkos::parallel_for("nearest", Range(0, static_cast<int>(places.size())),
                       Nearest{search, to_device("places", places), found});
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
  const auto found = nearest(search, places);
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
  INFO("gap off by " << largest_gap << ", of the facets by " << facet_gap << ", normal by " << largest_turn
                     << ", offset aside by " << largest_aside);
  CHECK(facet_gap > 0.9 * sagitta);
  CHECK(largest_gap < 2e-3 * sagitta);
  CHECK(largest_turn < 1e-4);
  CHECK(largest_aside < 1e-12);
}

TEST_CASE("smooth normals do not jump from facet to facet", "[contact]") {
  constexpr double angle = 0.1;
  const ContactSearch search = ring(8, angle);
  for (double height : {-0.002, 0.002}) {
    const auto found =
        nearest(search, {at(-1e-9, 0.03, 1 + height), at(1e-9, 0.03, 1 + height), at(0, 0.03, 1 + height),
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
  const auto found = nearest(search, {at(0.1, 0.03, 0.93), at(0.5, -0.03, 0.93), at(-0.2, 0.05, 0.94)});
  for (const Both& both : found) {
    CHECK(both.smooth.segment == both.facet.segment);
    CHECK_THAT(both.smooth.gap, WithinAbs(both.facet.gap, 1e-14));
    CHECK(norm(both.smooth.normal - both.facet.normal) < 1e-14);
  }
}

namespace {

/// What a force's shares do when the nodes move.
struct WorkOfShares {
  Segment segment;
  Array<const double* [3]> moved;
  double* sum;
  KOKKOS_INLINE_FUNCTION void corners(const Vector3 (&share)[4]) const {
    for (int k = 0; k < 4; ++k) *sum += dot(share[k], row(moved, segment.node[k]));
  }
  KOKKOS_INLINE_FUNCTION void pair(int plus, int minus, const Vector3& share) const {
    *sum += dot(share, row(moved, plus) - row(moved, minus));
  }
};

struct Shared {
  double work;      ///< of the shares of a force
  Vector3 carried;  ///< of the contact point
};

struct Share {
  ContactSearch search;
  Array<const Both*> found;
  Vector3 force;
  bool along_normal;
  Array<const double* [3]> moved;
  Array<Shared*> result;
  KOKKOS_INLINE_FUNCTION void operator()(const int i) const {
    const Projection& p = found(i).smooth;
    Shared shared{0, SmoothNormals::carried(search, p.segment, p.place, moved)};
    SmoothNormals::reaction(search, p.segment, p.place, along_normal ? p.normal : force,
                            WorkOfShares{search.contact.surface(p.segment), moved, &shared.work});
    result(i) = shared;
  }
};

std::vector<Shared> share(const ContactSearch& search, const std::vector<Both>& found, const std::vector<Point>& moved,
                          const Vector3* force) {
  const Array<Shared*> result("shared", found.size());
  Kokkos::parallel_for("share", Range(0, static_cast<int>(found.size())),
                       Share{search, to_device("found", found), force ? *force : Vector3{}, force == nullptr,
                             to_device("moved", moved), result});
  const auto host = to_host(result);
  return {host.data(), host.data() + found.size()};
}

/// A hilly surface of unequal segments.
struct Hills {
  std::vector<Point> nodes;
  std::vector<Quad> quads;
  explicit Hills(unsigned seed) {
    constexpr int n = 7;
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> aside(-0.15, 0.15), up(-0.06, 0.06);
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i) nodes.push_back({i + aside(random), j + aside(random), up(random)});
    for (int j = 0; j + 1 < n; ++j)
      for (int i = 0; i + 1 < n; ++i) quads.push_back({n * j + i, n * j + i + 1, n * (j + 1) + i + 1, n * (j + 1) + i});
  }
  ContactSearch search(const std::vector<Point>& moved, double factor) const {
    std::vector<Point> there = nodes;
    for (std::size_t k = 0; k < there.size(); ++k)
      for (int i = 0; i < 3; ++i) there[k][i] += factor * moved[k][i];
    return search_on(there, quads);
  }
};

}  // namespace

TEST_CASE("on curved segments a contact's forces are the gradient of its gap, and balance in sum and in moment",
          "[contact]") {
  for (unsigned seed = 1; seed <= 4; ++seed) {
    const Hills hills(seed);
    std::mt19937 random(100 + seed);
    std::uniform_real_distribution<double> inside(1.5, 4.5), height(-0.03, 0.02), any(-1, 1);
    std::vector<Point> slaves, moves, nodes_move(hills.nodes.size());
    for (int i = 0; i < 300; ++i) {
      slaves.push_back({inside(random), inside(random), height(random)});
      moves.push_back({any(random), any(random), any(random)});
    }
    for (Point& move : nodes_move) move = {any(random), any(random), any(random)};

    const ContactSearch search = hills.search(nodes_move, 0);
    const auto found = nearest(search, slaves);
    const auto shared = share(search, found, nodes_move, nullptr);
    constexpr double step = 1e-5;
    const auto nearest_at = [&](double factor) {
      auto there = slaves;
      for (std::size_t i = 0; i < there.size(); ++i)
        for (int c = 0; c < 3; ++c) there[i][c] += factor * moves[i][c];
      return nearest(hills.search(nodes_move, factor), there);
    };
    const auto ahead = nearest_at(step), behind = nearest_at(-step);
    double largest = 0, least_neighbours = 0;
    int compared = 0;
    for (std::size_t i = 0; i < slaves.size(); ++i) {
      const Projection& p = found[i].smooth;
      // Between segments the normal jumps by what hills of so few facets leave: not where the place changes its
      // segment, nor at its sides.
      if (ahead[i].smooth.segment != p.segment || behind[i].smooth.segment != p.segment || p.place.outside() > -1e-3)
        continue;
      const Vector3 move{{moves[i][0], moves[i][1], moves[i][2]}};
      const double slope = (ahead[i].smooth.gap - behind[i].smooth.gap) / (2 * step);
      largest = std::max(largest, std::fabs(slope - (dot(p.normal, move) - shared[i].work)));
      CHECK_THAT(dot(p.normal, shared[i].carried), WithinAbs(shared[i].work, 1e-12));
      double alone = 0;
      const Quad& corner = hills.quads[p.segment];
      for (int k = 0; k < 4; ++k)
        for (int c = 0; c < 3; ++c)
          alone += segment_shape(k, p.place.xi, p.place.eta) * p.normal[c] * nodes_move[corner[k]][c];
      least_neighbours = std::max(least_neighbours, std::fabs(alone - shared[i].work));
      ++compared;
    }
    INFO(compared << " places, gradient off by " << largest << ", shape functions alone by " << least_neighbours);
    CHECK(compared > 250);
    CHECK(largest < 1e-7);  // the second differences of hills of 0.06 over 1, by the step's square
    CHECK(least_neighbours > 0.05);

    // A rigid motion moves the contact point as any other.
    const Vector3 force{{0.3, -0.5, 0.8}}, turn{{0.7, 0.2, -0.4}}, shift{{-0.1, 0.6, 0.2}};
    std::vector<Point> rigid;
    for (const Point& x : hills.nodes) {
      const Vector3 moved = shift + cross(turn, Vector3{{x[0], x[1], x[2]}});
      rigid.push_back({moved[0], moved[1], moved[2]});
    }
    const auto carried = share(search, found, rigid, &force);
    for (std::size_t i = 0; i < slaves.size(); ++i) {
      const Vector3 contact = Vector3{{slaves[i][0], slaves[i][1], slaves[i][2]}} + found[i].smooth.offset;
      CHECK_THAT(carried[i].work, WithinAbs(dot(force, shift + cross(turn, contact)), 1e-12));
    }
  }
}
