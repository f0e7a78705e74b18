// Patches told apart: nodes that touch, and which of them hang together.

#include <catch2/catch_test_macros.hpp>

#include "post/contact_patch.hpp"
#include "tests/post/made_up_surfaces.hpp"

using namespace railwave;

namespace {

constexpr int nx = 12, ny = 9;

ContactSide grid() {
  return made_up_side(nx, ny, false, [](int i, int j) { return Vector(1e-3 * i, 1e-3 * j, 0); });
}

/// Presses with 100 MPa on the nodes of the picture that are marked by 'x'; its first line has the largest y.
ContactSide pressed(const std::vector<std::string>& picture) {
  ContactSide side = grid();
  press(
      side,
      [&](const Vector& p) {
        return picture[ny - 1 - std::lround(1e3 * p[1])][std::lround(1e3 * p[0])] == 'x' ? 1e8 : 0.0;
      },
      [](const Vector&) { return Vector(Vector::Zero()); });
  return side;
}

const std::vector<std::string> two_patches_and_strays = {"............",  //
                                                         ".xxx........",  //
                                                         ".xxxx......x",  //
                                                         ".xxx........",  //
                                                         "............",  //
                                                         "......xx....",  //
                                                         ".......xx...",  //
                                                         "xx..........",  //
                                                         "............"};

}  // namespace

TEST_CASE("touching nodes that share a facet hang together") {
  const ContactSide side = pressed(two_patches_and_strays);
  const auto parts = connected_nodes(side, FacetsAroundNodes(side), touching_nodes(side));
  std::vector<std::size_t> sizes;
  for (const auto& part : parts) sizes.push_back(part.size());
  std::sort(sizes.begin(), sizes.end());
  CHECK(sizes == std::vector<std::size_t>{1, 2, 4, 10});
}

TEST_CASE("all islands are patches by force, those of few nodes small ones") {
  const ContactState state = made_up_state(pressed(two_patches_and_strays), grid(), 0.4);
  const ContactSolution solution = contact_solution(state);
  REQUIRE(solution.patches.size() == 4);
  const int sizes[] = {10, 4, 2, 1};
  for (int p = 0; p < 4; ++p) {
    CHECK(solution.patches[p].touching.size() == static_cast<std::size_t>(sizes[p]));
    CHECK(solution.patches[p].small() == (p > 1));
    CHECK(solution.patches[p].size() > 0);
  }
  CHECK(solution.stray_nodes == 3);
  CHECK(solution.whole.touching.size() == 17);
  double in_patches = 0;
  double in_small = 0;
  for (const ContactPatch& patch : solution.patches) (patch.small() ? in_small : in_patches) += patch.normal_force;
  CHECK(std::fabs(solution.whole.normal_force - in_patches - in_small) < 1e-9 * solution.whole.normal_force);
  CHECK(std::fabs(solution.stray_force - in_small) < 1e-9 * in_small);
}

TEST_CASE("where only a node or two touch, the largest island is the patch, the others are strays") {
  const ContactState state =
      made_up_state(pressed({"............", "............", "............", "...x........", "............",
                             "............", "............", ".......xx...", "............"}),
                    grid(), 0.4);
  const ContactSolution solution = contact_solution(state);
  REQUIRE(solution.patches.size() == 2);
  CHECK(solution.patches[0].touching.size() == 2);
  CHECK(solution.patches[1].touching.size() == 1);
  CHECK(solution.stray_nodes == 1);
}

TEST_CASE("without contact there is no patch") {
  const ContactSolution solution = contact_solution(made_up_state(grid(), grid(), 0.4));
  CHECK(solution.patches.empty());
  CHECK(solution.whole.touching.empty());
  CHECK(solution.whole.area == 0);
}

TEST_CASE("facets around nodes, and their corners") {
  const ContactSide side = grid();
  const FacetsAroundNodes around(side);
  CHECK(facets_around(around, {0}) == std::vector<int>{0});
  CHECK(facets_around(around, {0, 1}) == std::vector<int>{0, 1});
  CHECK(nodes_of_facets(side, {0, 1}) == std::vector<int>{0, 1, 2, nx, nx + 1, nx + 2});
}
