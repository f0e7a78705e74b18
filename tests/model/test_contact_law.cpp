#include <catch2/catch_test_macros.hpp>
#include <catch2/matchers/catch_matchers_floating_point.hpp>

#include <algorithm>
#include <cmath>

#include "model/contact_law.hpp"
#include "model/host_copy.hpp"

using namespace railwave;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace {

struct Ask {
  PenaltyGrowth growth;
  Array<const double*> depth;
  Array<PenaltyGrowth::Spring*> answers;
  KOKKOS_INLINE_FUNCTION void operator()(const int i) const { answers(i) = growth.at(depth(i)); }
};

std::vector<PenaltyGrowth::Spring> ask(const scene::Contact& contact, const std::vector<double>& depths) {
  const Array<PenaltyGrowth::Spring*> answers("answers", depths.size());
  Kokkos::parallel_for("ask", Range(0, depths.size()),
                       Ask{make_contact_law(contact, 1).growth, to_device("depths", depths), answers});
  const auto host = to_host(answers);
  return {host.data(), host.data() + depths.size()};
}

}  // namespace

TEST_CASE("a growing penalty's force and energy are the integrals of its stiffness") {
  scene::Contact contact;
  contact.penalty_growth = {{2e-6, 0.5}, {5e-6, 0.5}, {1e-5, 4}, {1.2e-5, 3}};
  const auto factor = [](double l) {
    if (l < 5e-6) return 0.5;
    if (l < 1e-5) return 0.5 + 3.5 * (l - 5e-6) / 5e-6;
    return l < 1.2e-5 ? 4 - (l - 1e-5) / 2e-6 : 3.0;
  };
  std::vector<double> depths;
  for (int k = 0; k <= 300; ++k) depths.push_back(k * 5e-8);
  const auto springs = ask(contact, depths);
  // Simpson's rule in pieces that the corners of the law do not cut.
  double force = 0, energy = 0;
  for (std::size_t k = 0; k < depths.size(); ++k) {
    if (k > 0) {
      const double a = depths[k - 1], h = depths[k] - a;
      const double half = force + h / 24 * (5 * factor(a) + 8 * factor(a + 0.5 * h) - factor(depths[k] - 1e-15));
      const double whole = force + h / 6 * (factor(a) + 4 * factor(a + 0.5 * h) + factor(depths[k] - 1e-15));
      energy += h / 6 * (force + 4 * half + whole);
      force = whole;
    }
    INFO("penetration " << depths[k]);
    CHECK_THAT(springs[k].stiffness, WithinRel(factor(depths[k]), 1e-9));
    CHECK_THAT(springs[k].force, WithinRel(force, 1e-8) || WithinAbs(0, 1e-20));
    CHECK_THAT(springs[k].energy, WithinRel(energy, 1e-8) || WithinAbs(0, 1e-26));
  }
  CHECK(largest_growth(contact) == 4);
}

TEST_CASE("without points the penalty is linear, and no law is active where a plain one does") {
  scene::Contact contact;
  contact.friction = 0.3;
  CHECK_FALSE(make_contact_law(contact, 5).active);
  contact.damping = 0.1;
  const ContactLawArrays law = make_contact_law(contact, 5);
  CHECK(law.active);
  CHECK(law.damping_force.extent(0) == 5);
  CHECK(law.friction_now.extent(0) == 0);
  for (const auto& spring : ask(contact, {3e-6})) {
    CHECK(spring.stiffness == 1);
    CHECK(spring.force == 3e-6);
    CHECK(spring.energy == 0.5 * 3e-6 * 3e-6);
  }
  CHECK(largest_growth(contact) == 1);
  contact.damping = 0;
  contact.dynamic_friction = 0.2;
  contact.friction_decay = 6;
  CHECK(make_contact_law(contact, 5).friction_now.extent(0) == 5);
}
