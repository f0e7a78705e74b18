// Patches told apart: nodes that touch, and which of them hang together.

#include <catch2/catch_test_macros.hpp>

#include "post/contact_solution.hpp"
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
  press(side, [&](const Vector& p) { return picture[ny - 1 - std::lround(1e3 * p[1])][std::lround(1e3 * p[0])] == 'x' ? 1e8 : 0.0; },
        [](const Vector&) { return Vector(Vector::Zero()); });
  return side;
}

const std::vector<std::string> two_patches_and_strays = {
    "............",  //
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

TEST_CASE("small islands are strays, the rest patches by force") {
  const ContactState state = made_up_state(pressed(two_patches_and_strays), grid(), 0.4);
  const ContactSolution solution = contact_solution(state);
  REQUIRE(solution.patches.size() == 2);
  CHECK(solution.patches[0].touching.size() == 10);
  CHECK(solution.patches[1].touching.size() == 4);
  CHECK(solution.stray_nodes == 3);
  CHECK(solution.whole.touching.size() == 17);
  double in_patches = 0;
  for (const ContactPatch& patch : solution.patches) in_patches += patch.normal_force;
  CHECK(std::fabs(solution.whole.normal_force - in_patches - solution.stray_force) < 1e-9 * solution.whole.normal_force);
  CHECK(solution.stray_force > 0);
}

TEST_CASE("where only a node or two touch, they are the patch") {
  const ContactState state = made_up_state(pressed({"............", "............", "............", "...x........", "............", "............",
                                                    "............", ".......xx...", "............"}),
                                           grid(), 0.4);
  const ContactSolution solution = contact_solution(state);
  REQUIRE(solution.patches.size() == 1);
  CHECK(solution.patches[0].touching.size() == 2);
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
