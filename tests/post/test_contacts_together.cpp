// Contacts that are one contact solution: a patch cut in two contacts is the patch again.

#include <catch2/catch_test_macros.hpp>
#include <catch2/matchers/catch_matchers_floating_point.hpp>

#include <algorithm>
#include <cmath>

#include "post/contact_patch.hpp"
#include "post/contact_reader.hpp"
#include "tests/post/hertz_contact.hpp"

using namespace railwave;
using Catch::Matchers::WithinRel;

namespace {

/// The contact as it is with the master's facets of which the middle is at x < 0, or with the others: the slave's nodes
/// there have their forces, the others none.
ContactState half(const ContactState& whole, bool first) {
  ContactState state = whole;
  state.name = first ? "first" : "second";
  for (std::size_t n = 0; n < whole.slave.nodes.size(); ++n) {
    if ((whole.slave.position[3 * n] < 0) == first) continue;
    for (int i = 0; i < 3; ++i) {
      state.slave.normal_force[3 * n + i] = state.slave.tangential_force[3 * n + i] = 0;
      state.slip_velocity[3 * n + i] = 0;
    }
    state.slipping[n] = 0;
  }
  auto& facets = state.master.facets;
  facets.erase(std::remove_if(facets.begin(), facets.end(),
                              [&](const std::array<int, 4>& facet) {
                                double middle = 0;
                                for (const int corner : facet) middle += whole.master.position[3 * corner];
                                return (middle < 0) != first;
                              }),
               facets.end());
  return state;
}

}  // namespace

TEST_CASE("a patch that two contacts share is one patch") {
  const ContactState whole = hertz_contact_state({}, {}, HertzForces::sampled);
  const ContactState first = half(whole, true), second = half(whole, false);
  const ContactState together = contacts_together({first, second});
  CHECK(together.name == "first+second");
  CHECK(together.slave.nodes == whole.slave.nodes);
  CHECK(together.slave.normal_force == whole.slave.normal_force);
  CHECK(together.slave.tangential_force == whole.slave.tangential_force);
  CHECK(together.slave.facets == whole.slave.facets);
  CHECK(together.master.facets.size() == whole.master.facets.size());
  CHECK(together.slipping == whole.slipping);
  CHECK(together.slip_velocity == whole.slip_velocity);

  const ContactSolution one = contact_solution(whole), joined = contact_solution(together);
  REQUIRE(joined.patches.size() == 1);
  CHECK(joined.whole.touching == one.whole.touching);
  CHECK(joined.whole.area == one.whole.area);
  CHECK(joined.whole.normal_force == one.whole.normal_force);
  CHECK_THAT(joined.whole.peak_micro_slip, WithinRel(one.whole.peak_micro_slip, 1e-12));
  CHECK(joined.whole.regions.by_force == one.whole.regions.by_force);
  CHECK(contact_solution(first).patches.size() == 1);
  CHECK(contact_solution(first).whole.area < 0.7 * one.whole.area);
}

TEST_CASE("friction of contacts that are together is that of the one in which a node touches") {
  const ContactState whole = hertz_contact_state({}, {}, HertzForces::sampled);
  ContactState first = half(whole, true), second = half(whole, false);
  second.friction = 2 * first.friction;
  const ContactState together = contacts_together({first, second});
  for (const int node : contact_solution(whole).whole.touching) {
    const bool of_first = whole.slave.position[3 * node] < 0;
    CHECK(together.friction_at(node) == (of_first ? first.friction : second.friction));
  }
}

TEST_CASE("what one of the contacts lacks the whole lacks") {
  const ContactState whole = hertz_contact_state({}, {}, HertzForces::sampled);
  ContactState first = half(whole, true), second = half(whole, false);
  second.gap.clear();
  second.master = {};
  const ContactState together = contacts_together({first, second});
  CHECK(together.gap.empty());
  CHECK(together.slave.velocity == whole.slave.velocity);
  CHECK(together.master.nodes == whole.master.nodes);
}
