#include <catch2/catch_test_macros.hpp>
#include <catch2/generators/catch_generators.hpp>
#include <catch2/matchers/catch_matchers_floating_point.hpp>

#include <algorithm>
#include <cmath>

#include "kernels/contact/laws/augmented_penalty.hpp"
#include "model/contact/contact_law.hpp"
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
  const ContactLawArrays law = make_contact_law(contact, 1);
  Kokkos::parallel_for(
      "ask", Range(0, depths.size()),
      Ask{{law.growth.data(), static_cast<int>(law.growth.extent(0))}, to_device("depths", depths), answers});
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

TEST_CASE("without points the penalty is linear, and a pair has the simplest law that does") {
  scene::Contact contact;
  contact.friction = 0.3;
  CHECK(make_contact_law(contact, 5).number == 0);
  CHECK(make_contact_law(contact, 5).state.extent(0) == 0);
  CHECK(friction_now(contact, make_contact_law(contact, 5)).empty());
  contact.damping = 0.1;
  const ContactLawArrays law = make_contact_law(contact, 5);
  CHECK(law.number > 0);
  CHECK(law.state.extent(0) == 5 * GrowingPenalty::state_values);
  CHECK(friction_now(contact, law).empty());
  for (const auto& spring : ask(contact, {3e-6})) {
    CHECK(spring.stiffness == 1);
    CHECK(spring.force == 3e-6);
    CHECK(spring.energy == 0.5 * 3e-6 * 3e-6);
  }
  CHECK(largest_growth(contact) == 1);
  contact.damping = 0;
  contact.dynamic_friction = 0.2;
  contact.friction_decay = 6;
  const ContactLawArrays falling = make_contact_law(contact, 5);
  reset_contact_law(contact, falling);
  CHECK(friction_now(contact, falling) == std::vector<double>(5, 0.3));
}

TEST_CASE("laws are functions of numbers: force and energy of a linear penalty, a growing one, an augmented one") {
  const LinearPenalty linear{0.4};
  const ContactPoint in{-2e-6, 5e8}, out{1e-9, 5e8};
  CHECK(linear.touches(in, nullptr));
  CHECK_FALSE(linear.touches(out, nullptr));
  CHECK(linear.pressing(in, nullptr) == 2e-6 * 5e8);
  CHECK(linear.friction({{{3e-9, 0, 0}}, 1e-9}, nullptr) == 0.4);
  CHECK(linear.stored(in, 1e6, 9e4) == 0.5 * 1.09e6 / 5e8);

  const PenaltyGrowth::Point points[] = {{0, 1, 0, 0, 0}};
  GrowingPenalty growing{{points, 1}, {0.4, 0.1, 2, 0}, true, 0};
  double state[GrowingPenalty::state_values] = {};
  CHECK(growing.pressing(in, state) == linear.pressing(in, nullptr));
  CHECK(growing.stored(in, 1e6, 9e4) == linear.stored(in, 1e6, 9e4));
  const Sliding half_a_metre{{{3e-9, 4e-9, 0}}, 1e-8};  // a second
  CHECK_THAT(growing.friction(half_a_metre, state), WithinRel(0.1 + 0.3 * std::exp(-1.0), 1e-14));
  CHECK(state[ContactLawTrait<GrowingPenalty>::friction_now] == growing.friction(half_a_metre, state));
  growing.part(out, state);
  CHECK(state[ContactLawTrait<GrowingPenalty>::friction_now] == 0.4);

  AugmentedPenalty augmented{{0.4}, 4};
  double multiplier[] = {1500};
  CHECK(augmented.spring(5e8) == 2e9);
  CHECK(augmented.touches(out, multiplier));
  CHECK(augmented.pressing(out, multiplier) == 1500 - 5e8 * 1e-9);
  CHECK_FALSE(augmented.touches({1e-5, 5e8}, multiplier));
}

TEST_CASE("what the dashpot of a growing penalty takes is what it has done over the way") {
  // A mass meets a damped spring: the sum of its own energy, the spring's and what is dissipated stays.
  const PenaltyGrowth::Point points[] = {{0, 1, 2e5, 0, 0}};
  const double damping = GENERATE(0.05, 0.5, 1.5), mass = 0.02, stiffness = 3e8;
  const GrowingPenalty law{{points, 1}, {0, 0, 0, 0}, false, damping};
  double state[GrowingPenalty::state_values] = {};
  const double step = 1e-9;
  double gap = 1e-9, speed = 0.1, stored = 0;
  const double given = 0.5 * mass * speed * speed;
  for (int k = 0; k < 400000 && !(gap > 0 && speed < 0); ++k) {
    ContactPoint point{gap, stiffness};
    point.approach = speed;
    point.inverse_mass = 1 / mass;
    point.elapsed = step;
    double force = 0;
    if (law.touches(point, state)) {
      force = law.pressing(point, state);
      stored = law.stored(point, force * force, 0);
    } else {
      law.part(point, state);
      stored = 0;
    }
    CHECK(law.dissipated(state) >= 0);
    const double held = 0.5 * mass * speed * speed + stored + law.dissipated(state);
    if (k % 1000 == 0) CHECK_THAT(held, WithinRel(given, 2e-3));
    speed -= step * force / mass;
    gap -= step * speed;
  }
  CHECK(law.dissipated(state) > 0.1 * given);
}

TEST_CASE("falling friction sees the mean velocity of the past, not how nodes vibrate about it") {
  const double memory = 4e-5, step = 1e-7, speed = 0.3;
  const FallingFriction law{0.5, 0.32, 6, memory};
  const auto after = [&](double time, double vibration) {
    double state[FallingFriction::state_values] = {0.5, 0, 0, 0};
    const int steps = static_cast<int>(std::lround(time / step));
    for (int k = 0; k < steps; ++k) {
      const double now = speed + (k % 2 == 0 ? vibration : -vibration);
      law.coefficient({{{0, step * now, 0}}, step}, state);
    }
    return state[FallingFriction::now];
  };
  for (const double time : {1e-5, 4e-5, 2e-4}) {
    const double seen = speed * (1 - std::exp(-time / memory));
    CHECK_THAT(after(time, 0), WithinRel(0.32 + 0.18 * std::exp(-6 * seen), 1e-9));
    // To and fro at 5 MHz, faster than it slides.
    CHECK_THAT(after(time, 0.4), WithinRel(after(time, 0), 1e-3));
  }
  double state[FallingFriction::state_values] = {0.5, 0, 0, 0};
  law.coefficient({{{1, 0, 0}}, 0}, state);  // no time has passed: while a scene settles
  CHECK(state[FallingFriction::now] == 0.5);
  FallingFriction at_once = law;
  at_once.memory = 0;
  at_once.coefficient({{{step * speed, 0, 0}}, step}, state);
  CHECK_THAT(state[FallingFriction::now], WithinRel(0.32 + 0.18 * std::exp(-6 * speed), 1e-14));
  law.forget(state);
  CHECK(state[FallingFriction::now] == 0.5);
  CHECK(state[FallingFriction::remembered] == 0);
}
