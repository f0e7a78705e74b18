#include <algorithm>
#include <array>
#include <catch2/catch_test_macros.hpp>
#include <cmath>
#include <functional>
#include <random>

#include "kernels/contact/contact_track.hpp"
#include "tests/kernels/master_surface.hpp"

using namespace railwave;

namespace {

using Real = long double;
struct Place {
  Real x[3];
};
Real dot3(const Place& a, const Place& b) { return a.x[0] * b.x[0] + a.x[1] * b.x[1] + a.x[2] * b.x[2]; }
Place minus(const Place& a, const Place& b) { return {{a.x[0] - b.x[0], a.x[1] - b.x[1], a.x[2] - b.x[2]}}; }
Place plus(const Place& a, Real f, const Place& b) {
  return {{a.x[0] + f * b.x[0], a.x[1] + f * b.x[1], a.x[2] + f * b.x[2]}};
}
Place extended(const Point& p) { return {{p[0], p[1], p[2]}}; }

/// A closed body of hexahedra: cells of a grid of 4 x 4 x 4 of which some are carved out, turned at random.
struct Body {
  std::vector<Point> nodes;
  std::vector<Quad> quads;
  bool kept[4][4][4];
  double turn[3][3];
  bool flat;  ///< all faces are squares

  bool has(int i, int j, int k) const { return i >= 0 && j >= 0 && k >= 0 && i < 4 && j < 4 && k < 4 && kept[i][j][k]; }

  /// Whether a place is inside, of a flat one.
  bool inside(const Point& p) const {
    int cell[3];
    for (int c = 0; c < 3; ++c) {
      double back = 0;
      for (int r = 0; r < 3; ++r) back += turn[r][c] * p[r];
      cell[c] = static_cast<int>(std::floor(back));
    }
    return has(cell[0], cell[1], cell[2]);
  }
};

/// No side belongs to more than two faces, and no corner joins two bodies: there a surface is one.
bool sound(const Body& body) {
  for (int i = 0; i <= 4; ++i)
    for (int j = 0; j <= 4; ++j)
      for (int k = 0; k <= 4; ++k) {
        bool cell[2][2][2];
        for (int a = 0; a < 8; ++a)
          cell[a & 1][a >> 1 & 1][a >> 2] = body.has(i - 1 + (a & 1), j - 1 + (a >> 1 & 1), k - 1 + (a >> 2));
        // Two cells that meet at a corner or an edge alone.
        for (int a = 0; a < 8; ++a)
          for (int b = a + 1; b < 8; ++b) {
            const int differ = a ^ b, ways = (differ & 1) + (differ >> 1 & 1) + (differ >> 2);
            const auto at = [&](int c) { return cell[c & 1][c >> 1 & 1][c >> 2]; };
            if (ways < 2 || at(a) != at(b)) continue;
            // Is there a way from a to b through cells alike?
            bool reached[8] = {};
            reached[a] = true;
            for (int sweep = 0; sweep < 8; ++sweep)
              for (int c = 0; c < 8; ++c)
                if (reached[c])
                  for (int bit : {1, 2, 4})
                    if (at(c ^ bit) == at(a)) reached[c ^ bit] = true;
            if (!reached[b]) return false;
          }
      }
  return true;
}

Body body(std::mt19937& random, bool flat) {
  std::uniform_real_distribution<double> unit(0, 1), shift(-0.12, 0.12), angle(-1, 1);
  Body result{};
  result.flat = flat;
  do {
    for (auto& plane : result.kept)
      for (auto& line : plane)
        for (bool& cell : line) cell = unit(random) < 0.75;
  } while (!sound(result));
  double q[4], size = 0;
  for (double& c : q) {
    c = angle(random);
    size += c * c;
  }
  for (double& c : q) c /= std::sqrt(size);
  const double turn[3][3] = {
      {1 - 2 * (q[2] * q[2] + q[3] * q[3]), 2 * (q[1] * q[2] - q[0] * q[3]), 2 * (q[1] * q[3] + q[0] * q[2])},
      {2 * (q[1] * q[2] + q[0] * q[3]), 1 - 2 * (q[1] * q[1] + q[3] * q[3]), 2 * (q[2] * q[3] - q[0] * q[1])},
      {2 * (q[1] * q[3] - q[0] * q[2]), 2 * (q[2] * q[3] + q[0] * q[1]), 1 - 2 * (q[1] * q[1] + q[2] * q[2])}};
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c) result.turn[r][c] = turn[r][c];
  int number[5][5][5];
  for (auto& plane : number)
    for (auto& line : plane)
      for (int& n : line) n = -1;
  const auto node = [&](int i, int j, int k) {
    int& n = number[i][j][k];
    if (n >= 0) return n;
    n = static_cast<int>(result.nodes.size());
    const double x[3] = {i + (flat ? 0 : shift(random)), j + (flat ? 0 : shift(random)),
                         k + (flat ? 0 : shift(random))};
    Point p{};
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 3; ++c) p[r] += turn[r][c] * x[c];
    result.nodes.push_back(p);
    return n;
  };
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j)
      for (int k = 0; k < 4; ++k) {
        if (!result.kept[i][j][k]) continue;
        if (!result.has(i - 1, j, k))
          result.quads.push_back({node(i, j, k), node(i, j, k + 1), node(i, j + 1, k + 1), node(i, j + 1, k)});
        if (!result.has(i + 1, j, k))
          result.quads.push_back(
              {node(i + 1, j, k), node(i + 1, j + 1, k), node(i + 1, j + 1, k + 1), node(i + 1, j, k + 1)});
        if (!result.has(i, j - 1, k))
          result.quads.push_back({node(i, j, k), node(i + 1, j, k), node(i + 1, j, k + 1), node(i, j, k + 1)});
        if (!result.has(i, j + 1, k))
          result.quads.push_back(
              {node(i, j + 1, k), node(i, j + 1, k + 1), node(i + 1, j + 1, k + 1), node(i + 1, j + 1, k)});
        if (!result.has(i, j, k - 1))
          result.quads.push_back({node(i, j, k), node(i, j + 1, k), node(i + 1, j + 1, k), node(i + 1, j, k)});
        if (!result.has(i, j, k + 1))
          result.quads.push_back(
              {node(i, j, k + 1), node(i + 1, j, k + 1), node(i + 1, j + 1, k + 1), node(i, j + 1, k + 1)});
      }
  return result;
}

Place on_quad(const Place (&corner)[4], Real xi, Real eta) {
  const Real shape[4] = {(1 - xi) * (1 - eta) / 4, (1 + xi) * (1 - eta) / 4, (1 + xi) * (1 + eta) / 4,
                         (1 - xi) * (1 + eta) / 4};
  Place x{};
  for (int k = 0; k < 4; ++k) x = plus(x, shape[k], corner[k]);
  return x;
}

/// The distance from a quadrilateral, by Gauss and Newton from nine places in extended precision, and from its sides.
Real distance_from(const std::vector<Point>& nodes, const Quad& quad, const Point& slave) {
  Place corner[4];
  for (int k = 0; k < 4; ++k) corner[k] = extended(nodes[quad[k]]);
  const Place s = extended(slave);
  Real best = 1e300L;
  // No node is dropped farther than 0.18 from the surface, and no face reaches farther than 1.2 from its middle.
  const Place middle = minus(on_quad(corner, 0, 0), s);
  if (dot3(middle, middle) > 2) return best;
  for (int k = 0; k < 4; ++k) {
    const Place way = minus(corner[(k + 1) % 4], corner[k]);
    const Real share = std::min(Real(1), std::max(Real(0), dot3(minus(s, corner[k]), way) / dot3(way, way)));
    const Place off = minus(plus(corner[k], share, way), s);
    best = std::min(best, std::sqrt(dot3(off, off)));
  }
  for (int start = 0; start < 9; ++start) {
    Real xi = start % 3 - 1, eta = start / 3 - 1;
    bool rest = false;
    for (int iteration = 0; iteration < 60 && !rest; ++iteration) {
      const Place r = minus(on_quad(corner, xi, eta), s);
      const Real h = 0.25L;
      Place a{}, b{};
      for (int c = 0; c < 3; ++c) {
        a.x[c] = h * ((1 - eta) * (corner[1].x[c] - corner[0].x[c]) + (1 + eta) * (corner[2].x[c] - corner[3].x[c]));
        b.x[c] = h * ((1 - xi) * (corner[3].x[c] - corner[0].x[c]) + (1 + xi) * (corner[2].x[c] - corner[1].x[c]));
      }
      const Real aa = dot3(a, a), ab = dot3(a, b), bb = dot3(b, b), p = dot3(a, r), q = dot3(b, r),
                 det = aa * bb - ab * ab;
      const Real da = -(bb * p - ab * q) / det, db = -(aa * q - ab * p) / det;
      xi = std::max(Real(-2), std::min(Real(2), xi + da));
      eta = std::max(Real(-2), std::min(Real(2), eta + db));
      rest = std::fabs(da) + std::fabs(db) < 1e-17L;
    }
    if (std::fabs(xi) > 1 || std::fabs(eta) > 1) continue;
    const Place off = minus(on_quad(corner, xi, eta), s);
    best = std::min(best, std::sqrt(dot3(off, off)));
  }
  return best;
}

struct Drop {
  ContactSearch search;
  Array<const double* [3]> slave;
  Array<const int*> start;
  Array<Projection*> found;
  KOKKOS_INLINE_FUNCTION void operator()(const int i) const {
    double beyond;
    found(i) = search.nearest(row(slave, i), start(i), beyond);
  }
};

std::vector<Projection> drop(const ContactSearch& search, const std::vector<Point>& places,
                             const std::vector<int>& start) {
  const Array<Projection*> found("found", places.size());
  Kokkos::parallel_for("drop", Range(0, static_cast<int>(places.size())),
                       Drop{search, to_device("places", places), to_device("start", start), found});
  const auto host = to_host(found);
  return {host.data(), host.data() + places.size()};
}

/// What is found without a search of nodes that have come into a body: 0: nothing for sure; 1: the same as by the
/// search; 2: the same, near a side; 3: the same, in a fold that lies inside neither of its segments; 4: something
/// else.
struct Begin {
  ContactSearch search;
  Array<const double* [3]> slave;
  Array<const Projection*> found;
  Array<int*> verdict;
  KOKKOS_INLINE_FUNCTION void operator()(const int i) const {
    verdict(i) = 0;
    const Projection& by_search = found(i);
    const Vector3 x = row(slave, i);
    const double near = 4 * norm(by_search.offset);
    if (!(by_search.gap < 0) || search.several_sheets(x, by_search, near)) return;
    Projection now = by_search;
    double beyond;
    int other = -1;
    const ContactTrack::Verdict way = ContactTrack::follow(search, x, now, beyond, other);
    if (!(now.gap < 0)) return;
    const bool over = way == ContactTrack::over_segment && ContactTrack::surely_nearest(search, x, now);
    const bool fold = way == ContactTrack::under_fold && ContactTrack::surely_at_side(search, x, now, other);
    if (!over && !fold) return;
    const Projection sure =
        over ? search.nearest(x, now.segment, beyond, true) : search.nearest_of_two(x, now.segment, other, beyond);
    const bool same = sure.segment == by_search.segment && std::fabs(sure.gap - by_search.gap) < 1e-15 &&
                      norm(sure.normal - by_search.normal) < 1e-9;
    const SeenSegment seen = search.see(x, now.segment);
    const double to_side =
        std::fmin((1 - std::fabs(now.place.xi)) * norm(seen.across), (1 - std::fabs(now.place.eta)) * norm(seen.along));
    verdict(i) = !same ? 4 : fold ? 3 : to_side < 8 * -now.gap ? 2 : 1;
  }
};

/// How many have each verdict.
std::array<int, 5> begin(const ContactSearch& search, const std::vector<Point>& places,
                         const std::vector<Projection>& found) {
  const Array<int*> verdict("verdict", places.size());
  const Array<Projection*> by_search("found", places.size());
  const auto host = Kokkos::create_mirror_view(by_search);
  std::copy(found.begin(), found.end(), host.data());
  Kokkos::deep_copy(by_search, host);
  Kokkos::parallel_for("begin", Range(0, static_cast<int>(places.size())),
                       Begin{search, to_device("places", places), by_search, verdict});
  std::array<int, 5> counts{};
  for (const int one : to_vector(verdict)) ++counts[one];
  return counts;
}

/// By how much the springs of nodes in contact are stretched otherwise a step later, m.
struct Follow {
  ContactSearch search;
  Array<const double* [3]> slave;  ///< of each two, before and after
  Array<const Projection*> before;
  Array<double*> turned;
  KOKKOS_INLINE_FUNCTION void operator()(const int i) const {
    const Projection was = before(2 * i);
    turned(i) = 0;
    if (!(was.gap < 0)) return;
    const Projection now =
        ContactTrack::where(search, row(slave, 2 * i + 1), was.segment, was.place, true, near_several_sheets);
    const Vector3 change = now.gap < 0 ? now.gap * now.normal - was.gap * was.normal : -was.gap * was.normal;
    turned(i) = norm(change);
  }
};

/// m, by which each spring is stretched otherwise after a move of its node from the even place to the odd one behind
/// it.
std::vector<double> stretched(const ContactSearch& search, const std::vector<Point>& places,
                              const std::vector<Projection>& found) {
  const Array<double*> turned("turned", places.size() / 2);
  const Array<Projection*> before("before", found.size());
  const auto host = Kokkos::create_mirror_view(before);
  for (std::size_t i = 0; i < found.size(); ++i) host(i) = found[i];
  Kokkos::deep_copy(before, host);
  Kokkos::parallel_for("follow", Range(0, static_cast<int>(places.size() / 2)),
                       Follow{search, to_device("places", places), before, turned});
  const auto result = to_host(turned);
  return {result.data(), result.data() + places.size() / 2};
}

}  // namespace

TEST_CASE(
    "ten thousand nodes dropped on random closed bodies meet the nearest segment, and their gaps and forces move by no "
    "more than they do",
    "[contact]") {
  std::mt19937 random(2026);
  std::uniform_real_distribution<double> within(-1, 1), unit(0, 1);
  constexpr int bodies = 100, of_each = 100;
  int far_segment = 0, wrong_distance = 0, wrong_side = 0, depends_on_start = 0, jumps = 0, asked = 0;
  double worst_jump = 0, worst_stretch = 0;
  int stretches = 0, pressing = 0;
  std::array<int, 5> begun{};
  for (int b = 0; b < bodies; ++b) {
    const Body made = body(random, b % 2 == 0);
    const ContactSearch search = search_on(made.nodes, made.quads);
    std::vector<Point> places;
    std::vector<int> start;
    for (int k = 0; k < of_each; ++k) {
      const Quad& quad = made.quads[random() % made.quads.size()];
      Place corner[4];
      for (int c = 0; c < 4; ++c) corner[c] = extended(made.nodes[quad[c]]);
      // A third on sides, a ninth at corners, and off them by a nanometre to a tenth of a cell.
      const double xi = k % 3 == 0 ? 1 : within(random), eta = k % 9 == 0 ? -1 : within(random),
                   off = 0.1 * std::pow(10.0, -8 * unit(random));
      const Place on = on_quad(corner, xi, eta);
      Point p{};
      for (int c = 0; c < 3; ++c) p[c] = static_cast<double>(on.x[c]) + off * within(random);
      places.push_back(p);
      start.push_back(static_cast<int>(random() % made.quads.size()));
      for (double& c : p) c += 0.577e-9 * within(random);
      places.push_back(p);
      start.push_back(static_cast<int>(random() % made.quads.size()));
    }
    const auto found = drop(search, places, start);
    for (double change : stretched(search, places, found)) {
      pressing += change > 0;
      // Warped segments bend distances. One node, 2.6 nm deep under a corner, comes under another face there.
      stretches += change > (made.flat ? 1.01e-9 : 1.3e-9);
      worst_stretch = std::max(worst_stretch, change);
    }
    const std::array<int, 5> here = begin(search, places, found);
    std::transform(begun.begin(), begun.end(), here.begin(), begun.begin(), std::plus<>());
    const auto again = drop(search, places, std::vector<int>(places.size(), 0));
    for (std::size_t i = 0; i < places.size(); ++i) {
      if (i % 2 == 0) {
        ++asked;
        Real least = 1e300L, there = 1e300L;
        for (std::size_t q = 0; q < made.quads.size(); ++q) {
          const Real d = distance_from(made.nodes, made.quads[q], places[i]);
          least = std::min(least, d);
          if (static_cast<int>(q) == found[i].segment) there = d;
        }
        far_segment += there > least + 1e-12L;
        wrong_distance += std::fabs(std::fabs(static_cast<Real>(found[i].gap)) - least) > 1e-12L;
        if (made.flat && least > 1e-13L) wrong_side += (found[i].gap < 0) != made.inside(places[i]);
      } else {
        const double jump = std::fabs(found[i].gap - found[i - 1].gap);
        jumps += jump > 1.01e-9;
        worst_jump = std::max(worst_jump, jump);
      }
      depends_on_start += found[i].segment != again[i].segment || found[i].gap != again[i].gap;
    }
  }
  INFO("of " << asked << "; worst jump " << worst_jump << "; of " << pressing << " springs, worst change "
             << worst_stretch);
  CHECK(asked == 10000);
  CHECK(far_segment == 0);
  CHECK(wrong_distance == 0);
  CHECK(wrong_side == 0);
  CHECK(depends_on_start == 0);
  CHECK(jumps == 0);
  // The force vector of a node in contact, direction and all: its spring over its stiffness.
  CHECK(pressing > 3000);
  CHECK(stretches <= 1);
  CHECK(worst_stretch < 4e-9);
  // Some are surely over their segment, without a search: also near its sides.
  INFO("without a search " << begun[1] << ", near a side " << begun[2]);
  CHECK(begun[1] > 1000);
  CHECK(begun[2] > 100);
  CHECK(begun[4] == 0);
}

TEST_CASE("a node over the line between two faces does not meet a far one, however the line is turned", "[contact]") {
  // A slab with sharp edges whose top is hollow or raised along its middle by a tenth of a nanometre, as rounding does.
  for (double height : {-1e-10, -1e-16, 0.0, 1e-16, 1e-10}) {
    std::vector<Point> nodes;
    for (double z : {-5e-3, 0.0})
      for (int i = 0; i <= 2; ++i)
        for (int j = 0; j <= 2; ++j) nodes.push_back({1e-3 * i, 1e-3 * j, z < 0 ? z : i == 1 ? height : 0.0});
    std::vector<Quad> quads;
    const auto n = [](int layer, int i, int j) { return 9 * layer + 3 * i + j; };
    for (int i = 0; i < 2; ++i)
      for (int j = 0; j < 2; ++j) {
        quads.push_back({n(1, i, j), n(1, i + 1, j), n(1, i + 1, j + 1), n(1, i, j + 1)});
        quads.push_back({n(0, i, j), n(0, i, j + 1), n(0, i + 1, j + 1), n(0, i + 1, j)});
      }
    for (int i = 0; i < 2; ++i) {
      quads.push_back({n(0, i, 0), n(0, i + 1, 0), n(1, i + 1, 0), n(1, i, 0)});
      quads.push_back({n(0, i + 1, 2), n(0, i, 2), n(1, i, 2), n(1, i + 1, 2)});
      quads.push_back({n(0, 0, i + 1), n(0, 0, i), n(1, 0, i), n(1, 0, i + 1)});
      quads.push_back({n(0, 2, i), n(0, 2, i + 1), n(1, 2, i + 1), n(1, 2, i)});
    }
    std::vector<Point> places;
    for (double aside : {-1e-9, -1e-12, 0.0, 1e-12, 1e-9}) places.push_back({1e-3 + aside, 0.7e-3, -7.5e-6});
    for (const Projection& p : drop(search_on(nodes, quads), places, std::vector<int>(places.size(), 5))) {
      CHECK(std::fabs(p.gap + 7.5e-6) < 2e-10);
      CHECK(p.normal[2] > 1 - 1e-6);
    }
  }
}

TEST_CASE("a node under a valley's line, over neither of its sides, is found without a search as with one",
          "[contact]") {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> within(-1, 1), unit(0, 1);
  std::array<int, 5> found_so{};
  constexpr int valleys = 50, of_each = 40;
  for (int v = 0; v < valleys; ++v) {
    const double slope = 0.5 * std::pow(10.0, -4 * unit(random)), turn = 3 * within(random), tilt = within(random);
    const auto placed = [&](double x, double y, double z) {
      const double x1 = x * std::cos(turn) - y * std::sin(turn), y1 = x * std::sin(turn) + y * std::cos(turn);
      return Point{x1, y1 * std::cos(tilt) - z * std::sin(tilt), y1 * std::sin(tilt) + z * std::cos(tilt)};
    };
    std::vector<Point> nodes;
    std::vector<Quad> quads;
    for (int i = 0; i < 5; ++i)
      for (int j = 0; j < 3; ++j) nodes.push_back(placed(i - 2, j - 1, j == 1 ? 0 : slope));
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j < 2; ++j) quads.push_back({3 * i + j, 3 * i + j + 3, 3 * i + j + 4, 3 * i + j + 1});
    const ContactSearch search = search_on(nodes, quads);
    std::vector<Point> places;
    for (int k = 0; k < of_each; ++k) {
      const double depth = 0.02 * std::pow(10.0, -4 * unit(random));
      places.push_back(placed(2 * within(random), 0.9 * slope * depth * within(random), -depth));
    }
    const std::array<int, 5> here = begin(search, places, drop(search, places, std::vector<int>(of_each, 0)));
    std::transform(found_so.begin(), found_so.end(), here.begin(), found_so.begin(), std::plus<>());
  }
  INFO("in the valley " << found_so[3] << ", left to the search " << found_so[0] << ", over one side " << found_so[1]);
  CHECK(found_so[3] > 1000);
  CHECK(found_so[4] == 0);
}
