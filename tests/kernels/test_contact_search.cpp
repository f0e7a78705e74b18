#include <algorithm>
#include <catch2/catch_test_macros.hpp>
#include <catch2/matchers/catch_matchers_floating_point.hpp>
#include <map>
#include <random>

#include "kernels/contact/team_search.hpp"
#include "tests/kernels/master_surface.hpp"

using namespace railwave;
using Catch::Matchers::WithinAbs;

namespace {

struct Question {
  Point slave;
  int start = 0;  ///< segment from which the search begins
};

struct Answer {
  int segment;
  double xi, eta, gap;
  Vector3 point, normal;
  bool comes_within = false, several_sheets = false;  ///< a short way and, of what is found, its distance twice
};

/// Asks on the device: the nearest segment; or one given. A thread for each question, or a team.
struct Ask {
  ContactSearch search;
  Array<const double* [3]> slave;
  Array<const int*> from;
  int only;  ///< segment to project on, -1: locate
  Array<Answer*> answers;
  KOKKOS_INLINE_FUNCTION Projection beyond_its_sides(const Vector3& x) const {
    const SeenSegment seen = search.see(x, only);
    return search.at(seen, search.nearest_place(seen, {0, 0}));
  }
  template <class Search>
  KOKKOS_INLINE_FUNCTION void item(const Search& by, const int i, bool writes) const {
    const Vector3 x = row(slave, i);
    const Projection p = only >= 0 ? beyond_its_sides(x) : by.locate(x, from(i));
    const bool comes_within = by.comes_within(x, 0.05),
               several_sheets = p.segment >= 0 && by.several_sheets(x, p, 2 * norm(p.offset));
    if (!writes) return;
    answers(i) = {p.segment, p.place.xi, p.place.eta, p.gap, x + p.offset, p.normal, comes_within, several_sheets};
  }
};

/// One slave that goes through all the places, each time from where it was; one thread.
struct Travel {
  ContactSearch search;
  Array<const double* [3]> slave;
  Array<Answer*> answers;
  KOKKOS_INLINE_FUNCTION void operator()(const int) const {
    int previous = 0;
    for (int i = 0; i < static_cast<int>(slave.extent(0)); ++i) {
      const Vector3 x = row(slave, i);
      const Projection p = search.locate(x, previous);
      previous = p.segment;
      answers(i) = {p.segment, p.place.xi, p.place.eta, p.gap, x + p.offset, p.normal};
    }
  }
};

std::vector<Answer> travel(const ContactSearch& search, const std::vector<Point>& places) {
  const Array<Answer*> answers("answers", places.size());
  Kokkos::parallel_for("travel", Range(0, 1), Travel{search, to_device("places", places), answers});
  const auto host = to_host(answers);
  return {host.data(), host.data() + places.size()};
}

/// A host's team may have as many threads as run.
int most_threads_of_team() { return on_device ? threads_of_search : std::min(2, ExecutionSpace().concurrency()); }

/// But for how a compiler rounds.
void check_same(const std::vector<Answer>& some, const std::vector<Answer>& others) {
  int differ = 0;
  for (std::size_t i = 0; i < some.size(); ++i) {
    const Answer &a = some[i], &b = others[i];
    const auto apart = [](double x, double y) { return !(std::fabs(x - y) <= 1e-12 * (1 + std::fabs(x))); };
    bool other = a.segment != b.segment || a.comes_within != b.comes_within || a.several_sheets != b.several_sheets ||
                 apart(a.xi, b.xi) || apart(a.eta, b.eta) || apart(a.gap, b.gap);
    for (int k = 0; k < 3; ++k) other = other || apart(a.point[k], b.point[k]) || apart(a.normal[k], b.normal[k]);
    differ += other ? 1 : 0;
  }
  CHECK(differ == 0);
}

std::vector<Answer> ask(const ContactSearch& search, const std::vector<Question>& questions, int only = -1) {
  std::vector<Point> slaves;
  std::vector<int> from;
  for (const Question& q : questions) {
    slaves.push_back(q.slave);
    from.push_back(q.start);
  }
  const int count = static_cast<int>(questions.size());
  const Array<Answer*> answers("answers", count), of_teams("answers of teams", count);
  const auto ask_by = [&](const Array<Answer*>& into) {
    return SearchByTeams<Ask>{{search, to_device("slaves", slaves), to_device("from", from), only, into}};
  };
  Kokkos::parallel_for("ask", Range(0, count), ask_by(answers));
  for (const int threads : {1, most_threads_of_team()}) {
    Kokkos::parallel_for("ask", search_teams(ExecutionSpace(), count, threads), ask_by(of_teams));
    check_same(to_vector(answers), to_vector(of_teams));
  }
  return to_vector(answers);
}

/// A point of a bilinear quadrilateral.
Point surface_point(const std::vector<Point>& nodes, const Quad& quad, double xi, double eta) {
  const double shape[4] = {(1 - xi) * (1 - eta) / 4, (1 + xi) * (1 - eta) / 4, (1 + xi) * (1 + eta) / 4,
                           (1 - xi) * (1 + eta) / 4};
  Point x{};
  for (int k = 0; k < 4; ++k)
    for (int i = 0; i < 3; ++i) x[i] += shape[k] * nodes[quad[k]][i];
  return x;
}

double distance(const Point& a, const Point& b) { return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]); }

/// Shortest distance to a quadrilateral by nested grids, which knows no derivative.
double shortest_distance(const std::vector<Point>& nodes, const Quad& quad, const Point& slave) {
  double best = 1e300, at[2] = {0, 0};
  for (double reach = 1; reach > 1e-9; reach *= 0.3) {
    const double centre[2] = {at[0], at[1]};
    for (int i = -10; i <= 10; ++i)
      for (int j = -10; j <= 10; ++j) {
        const double xi = std::fmax(-1, std::fmin(1, centre[0] + 0.1 * i * reach));
        const double eta = std::fmax(-1, std::fmin(1, centre[1] + 0.1 * j * reach));
        const double d = distance(surface_point(nodes, quad, xi, eta), slave);
        if (d >= best) continue;
        best = d;
        at[0] = xi;
        at[1] = eta;
      }
  }
  return best;
}

/// n x n segments over the unit square, inner nodes moved in the plane at random; z by `height`.
template <class Height>
void grid(int n, double disorder, const Height& height, std::vector<Point>& nodes, std::vector<Quad>& quads) {
  std::mt19937 generator(11);
  std::uniform_real_distribution<double> shift(-disorder / n, disorder / n);
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i) {
      double x = 1.0 * i / n, y = 1.0 * j / n;
      if (i > 0 && i < n) x += shift(generator);
      if (j > 0 && j < n) y += shift(generator);
      nodes.push_back({x, y, height(x, y)});
    }
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const int k = j * (n + 1) + i;
      quads.push_back({k, k + 1, k + n + 2, k + n + 1});
    }
}

/// A ridge (slope > 0) or a valley (slope < 0) along y: two rows of segments of unit size that meet at x = 0, z = 0.
void fold(double slope, std::vector<Point>& nodes, std::vector<Quad>& quads) {
  for (int j = 0; j <= 3; ++j)
    for (int i = -1; i <= 1; ++i) nodes.push_back({1.0 * i, 1.0 * j, -slope * std::fabs(1.0 * i)});
  for (int j = 0; j < 3; ++j)
    for (int i = 0; i < 2; ++i) quads.push_back({3 * j + i, 3 * j + i + 1, 3 * j + i + 4, 3 * j + i + 3});
}

}  // namespace

TEST_CASE("the contact point on a warped segment is the nearest one") {
  std::mt19937 generator(3);
  std::uniform_real_distribution<double> shift(-0.15, 0.15), inside(-0.85, 0.85), depth(-0.2, 0.2);
  for (int trial = 0; trial < 20; ++trial) {
    std::vector<Point> nodes{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    for (Point& x : nodes)
      for (double& c : x) c += shift(generator);
    const Quad quad{0, 1, 2, 3};
    std::vector<Question> questions;
    std::vector<double> sign;
    for (int k = 0; k < 20; ++k) {
      Point slave = surface_point(nodes, quad, inside(generator), inside(generator));
      const double d = depth(generator);
      slave[2] += d;
      questions.push_back({slave});
      sign.push_back(d);
    }
    const auto answers = ask(search_on(nodes, {quad}), questions, 0);
    for (std::size_t k = 0; k < answers.size(); ++k) {
      const Answer& a = answers[k];
      if (std::fabs(a.xi) > 1 || std::fabs(a.eta) > 1) continue;  // nearest beyond the edge, which project() allows
      const double shortest = shortest_distance(nodes, quad, questions[k].slave);
      CHECK_THAT(std::fabs(a.gap), WithinAbs(shortest, 1e-12));
      CHECK(a.gap * sign[k] > 0);
      const Point there = surface_point(nodes, quad, a.xi, a.eta);
      for (int i = 0; i < 3; ++i) {
        CHECK_THAT(a.point[i], WithinAbs(there[i], 1e-14));
        // The slave stands on the normal.
        CHECK_THAT(questions[k].slave[i], WithinAbs(there[i] + a.gap * a.normal[i], 1e-12));
      }
    }
  }
}

TEST_CASE("a slave over a disordered plane is found on the segment under it, over edges and corners too") {
  std::vector<Point> nodes;
  std::vector<Quad> quads;
  grid(
      6, 0.3, [](double, double) { return 0.0; }, nodes, quads);
  const ContactSearch search = search_on(nodes, quads);
  std::mt19937 generator(5);
  std::uniform_real_distribution<double> place(0.02, 0.98), coordinate(-1, 1);
  std::vector<Question> questions;
  const auto put = [&](Point x) {
    for (double z : {-0.01, 0.02}) {
      x[2] = z;
      questions.push_back({x, static_cast<int>(generator() % quads.size())});
    }
  };
  for (int k = 0; k < 2000; ++k) put({place(generator), place(generator), 0});
  for (const Quad& q : quads)
    for (int k = 0; k < 4; ++k) {
      put(surface_point(nodes, q, k % 2 == 0 ? 1.0 : coordinate(generator), k % 2 == 0 ? coordinate(generator) : 1.0));
      put(nodes[q[k]]);
    }
  const auto answers = ask(search, questions);
  int missed = 0, wrong_gap = 0, wrong_place = 0;
  for (std::size_t k = 0; k < answers.size(); ++k) {
    const Answer& a = answers[k];
    const Point& slave = questions[k].slave;
    if (a.segment < 0) {
      ++missed;
      continue;
    }
    wrong_gap += std::fabs(a.gap - slave[2]) > 1e-14;
    wrong_place += std::fabs(a.xi) > 1 + 1e-9 || std::fabs(a.eta) > 1 + 1e-9 ||
                   std::hypot(a.point[0] - slave[0], a.point[1] - slave[1]) > 1e-12;
  }
  INFO("of " << answers.size());
  CHECK(missed == 0);
  CHECK(wrong_gap == 0);
  CHECK(wrong_place == 0);
}

TEST_CASE(
    "a slave that crosses from segment to segment of a disordered plane keeps its penetration and its point moves on") {
  std::vector<Point> nodes;
  std::vector<Quad> quads;
  grid(
      6, 0.3, [](double, double) { return 0.0; }, nodes, quads);
  const ContactSearch search = search_on(nodes, quads);
  const int steps = 1000;
  const double step[2] = {0.94 / steps, 0.85 / steps};
  std::vector<Point> path;
  for (int k = 0; k <= steps; ++k) path.push_back({0.03 + k * step[0], 0.05 + k * step[1], -0.01});
  const auto answers = travel(search, path);
  int crossings = 0;
  double worst_gap = 0, worst_move = 0;
  for (int k = 0; k <= steps; ++k) {
    const Answer& a = answers[k];
    REQUIRE(a.segment >= 0);
    worst_gap = std::max({worst_gap, std::fabs(a.gap + 0.01), std::fabs(a.normal[2] - 1)});
    if (k == 0) continue;
    crossings += a.segment != answers[k - 1].segment;
    for (int i = 0; i < 2; ++i)
      worst_move = std::max(worst_move, std::fabs(a.point[i] - answers[k - 1].point[i] - step[i]));
  }
  CHECK(crossings >= 6);
  CHECK(worst_gap < 1e-14);
  CHECK(worst_move < 1e-13);
}

TEST_CASE("beside the surface nothing is found") {
  std::vector<Point> nodes;
  std::vector<Quad> quads;
  grid(
      4, 0.2, [](double, double) { return 0.0; }, nodes, quads);
  std::vector<Question> questions;
  for (double along : {-0.2, 0.1, 0.5, 0.77, 1.3})
    for (double beside : {-0.05, -0.3, 1.05, 1.4}) {
      questions.push_back({{beside, along, -0.01}});
      questions.push_back({{along, beside, -0.01}});
    }
  for (const Answer& a : ask(search_on(nodes, quads), questions)) CHECK(a.segment == -1);
}

TEST_CASE("over a ridge and in a valley a shallow penetration is found, with the depth under one of the two faces") {
  std::mt19937 generator(8);
  std::uniform_real_distribution<double> across(-0.3, 0.3), along(0.1, 2.9), depth(1e-4, 5e-3);
  for (double slope : {-0.6, -0.2, 0.2, 0.6}) {
    std::vector<Point> nodes;
    std::vector<Quad> quads;
    fold(slope, nodes, quads);
    const ContactSearch search = search_on(nodes, quads);
    std::vector<Question> questions;
    std::vector<double> vertical;  // above the surface
    for (int k = 0; k < 500; ++k) {
      // Every fourth one right over the fold, where it belongs to both sides or to none.
      const double x = k % 4 == 0 ? 0.0 : k % 4 == 1 ? 1e-3 * across(generator) : across(generator);
      const double d = (k % 2 == 0 ? -1 : 1) * depth(generator);
      questions.push_back(
          {{x, along(generator), -slope * std::fabs(x) + d}, static_cast<int>(generator() % quads.size())});
      vertical.push_back(d);
    }
    const auto answers = ask(search, questions);
    for (std::size_t k = 0; k < answers.size(); ++k) {
      INFO("slope " << slope << ", slave at x " << questions[k].slave[0] << ", " << vertical[k] << " above");
      const double to_plane = vertical[k] / std::hypot(1.0, slope);
      if (vertical[k] < 0) {
        REQUIRE(answers[k].segment >= 0);
        CHECK(answers[k].gap < 0);
        // The nearer face's depth at least; at most the other face's (ridge) or the way to the fold itself (valley).
        const double other = (vertical[k] - 2 * std::fabs(slope * questions[k].slave[0])) / std::hypot(1.0, slope);
        CHECK(answers[k].gap <= to_plane + 1e-12);
        CHECK(answers[k].gap >= std::min(vertical[k], other) - 1e-12);
      } else if (answers[k].segment >= 0) {
        CHECK(answers[k].gap > 0);
      }
    }
  }
}

TEST_CASE("beside the surface's end only what is shallow belongs to it") {
  std::vector<Point> nodes;
  std::vector<Quad> quads;
  grid(
      4, 0.0, [](double, double) { return 0.0; }, nodes, quads);
  const ContactSearch search = search_on(nodes, quads);
  // A quarter wide, so 0.35 from corner to corner; a hundredth outside.
  const auto answers =
      ask(search, {{{-0.0025, 0.4, -0.001}}, {{-0.0025, 0.4, -0.1}}, {{0.6, 1.0025, -0.001}}, {{0.6, 1.0025, -0.2}}});
  CHECK(answers[0].segment >= 0);
  CHECK(answers[1].segment == -1);
  CHECK(answers[2].segment >= 0);
  CHECK(answers[3].segment == -1);
}

TEST_CASE("near a cube's edges and corner what has entered is as deep as it is under the nearest face") {
  // Three faces of a cube of side 3 that meet in the corner (3, 3, 3).
  std::vector<Point> nodes;
  std::map<std::array<int, 3>, int> number;
  const auto node = [&](int x, int y, int z) {
    const auto [at, isnew] = number.try_emplace({x, y, z}, static_cast<int>(nodes.size()));
    if (isnew) nodes.push_back({1.0 * x, 1.0 * y, 1.0 * z});
    return at->second;
  };
  std::vector<Quad> quads;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      quads.push_back({node(i, j, 3), node(i + 1, j, 3), node(i + 1, j + 1, 3), node(i, j + 1, 3)});
      quads.push_back({node(3, i, j), node(3, i + 1, j), node(3, i + 1, j + 1), node(3, i, j + 1)});
      quads.push_back({node(j, 3, i), node(j, 3, i + 1), node(j + 1, 3, i + 1), node(j + 1, 3, i)});
    }
  const ContactSearch search = search_on(nodes, quads);
  std::mt19937 generator(11);
  std::uniform_real_distribution<double> depth(1e-4, 5e-3), away(0, 2.9);
  std::vector<Question> questions;
  std::vector<double> expected;
  for (int k = 0; k < 2000; ++k) {
    const double d = depth(generator);
    Point below{3 * d + away(generator) * (k % 2 == 0 ? 1 : 0.05), 3 * d + away(generator) * (k % 3 == 0 ? 1 : 0.05),
                0};
    below[2] = d;
    std::rotate(below.begin(), below.begin() + k % 3, below.end());
    questions.push_back({{3 - below[0], 3 - below[1], 3 - below[2]}, static_cast<int>(generator() % quads.size())});
    expected.push_back(-d);
  }
  const auto answers = ask(search, questions);
  int wrong = 0;
  for (std::size_t k = 0; k < answers.size(); ++k)
    wrong += answers[k].segment < 0 || !(std::fabs(answers[k].gap - expected[k]) < 1e-12);
  CHECK(wrong == 0);
}

TEST_CASE(
    "on a wavy surface graded one to fifteen both ways, with slender and warped segments, each is found from "
    "anywhere") {
  constexpr int count = 14;
  std::vector<double> line{0};
  for (int i = 0; i < count; ++i) line.push_back(line.back() + 0.05 * std::pow(15.0, i / (count - 1.0)));
  const auto height = [](double x, double y) { return 0.05 * std::sin(0.9 * x) * std::cos(0.7 * y) - 0.01 * x * y; };
  std::vector<Point> nodes;
  std::vector<Quad> quads;
  for (int j = 0; j <= count; ++j)
    for (int i = 0; i <= count; ++i) {
      // Fine and coarse meet crosswise, and the lines are not straight.
      const double x = line[i] + 0.02 * std::sin(1.7 * j), y = line[j] + 0.02 * std::sin(2.3 * i);
      nodes.push_back({x, y, height(x, y)});
    }
  for (int j = 0; j < count; ++j)
    for (int i = 0; i < count; ++i) {
      const int corner = j * (count + 1) + i;
      quads.push_back({corner, corner + 1, corner + count + 2, corner + count + 1});
    }
  const ContactSearch search = search_on(nodes, quads);
  std::mt19937 generator(5);
  std::uniform_real_distribution<double> within(-0.97, 0.97);
  std::vector<Question> questions;
  std::vector<int> over;
  std::vector<double> expected;
  for (int k = 0; k < 6000; ++k) {
    const int q = static_cast<int>(generator() % quads.size());
    const double xi = within(generator), eta = within(generator), d = (k % 2 == 0 ? -1 : 1) * 2e-4;
    const Point p = surface_point(nodes, quads[q], xi, eta), px = surface_point(nodes, quads[q], xi + 1e-4, eta),
                pe = surface_point(nodes, quads[q], xi, eta + 1e-4);
    const double a[3] = {px[0] - p[0], px[1] - p[1], px[2] - p[2]}, b[3] = {pe[0] - p[0], pe[1] - p[1], pe[2] - p[2]};
    Point n{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
    const double size = std::hypot(n[0], n[1], n[2]);
    questions.push_back({{p[0] + d * n[0] / size, p[1] + d * n[1] / size, p[2] + d * n[2] / size},
                         static_cast<int>(generator() % quads.size())});
    over.push_back(q);
    expected.push_back(d);
  }
  const auto answers = ask(search, questions);
  int lost = 0, wrong = 0;
  for (std::size_t k = 0; k < answers.size(); ++k) {
    lost += answers[k].segment != over[k];
    wrong += !(std::fabs(answers[k].gap - expected[k]) < 1e-9);
  }
  INFO("of " << answers.size() << ": on another segment " << lost << ", another gap " << wrong);
  CHECK(lost == 0);
  CHECK(wrong == 0);
}
