#include "model/contact/contact_law.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "model/host_copy.hpp"

namespace railwave {
namespace {

/// See PenaltyGrowth. The first point is moved or copied to no penetration: the factor is constant before it.
std::vector<PenaltyGrowth::Point> growth_points(std::vector<std::array<double, 2>> given) {
  if (given.empty()) given.push_back({0, 1});
  if (given.front()[0] > 0) given.insert(given.begin(), {0, given.front()[1]});
  std::vector<PenaltyGrowth::Point> points;
  double force = 0, energy = 0;
  for (std::size_t k = 0; k < given.size(); ++k) {
    const auto [depth, factor] = given[k];
    const bool last = k + 1 == given.size();
    const double d = last ? 0 : given[k + 1][0] - depth;
    const double slope = last ? 0 : (given[k + 1][1] - factor) / d;
    points.push_back({depth, factor, slope, force, energy});
    energy += d * (force + d * (0.5 * factor + d * slope / 6));
    force += d * (factor + 0.5 * d * slope);
  }
  return points;
}

/// The state's values at which the coefficient of friction lies; none where it is constant.
std::pair<int, int> friction_values(const scene::Contact& contact, const ContactLawArrays& law) {
  int value = -1, slaves = 0;
  with_type(ContactLaws{}, law.number, [&](auto type) {
    using Law = typename decltype(type)::type;
    if constexpr (ContactLawTrait<Law>::friction_now >= 0) {
      if (!contact.falling_friction()) return;
      value = ContactLawTrait<Law>::friction_now;
      slaves = static_cast<int>(law.state.extent(0)) / Law::state_values;
    }
  });
  return {value * slaves, (value + 1) * slaves};
}

}  // namespace

ContactLawArrays make_contact_law(const scene::Contact& contact, int slaves) {
  ContactLawArrays law;
  law.number = first_type(ContactLaws{},
                          [&](auto type) { return ContactLawTrait<typename decltype(type)::type>::is_of(contact); });
  with_type(ContactLaws{}, law.number, [&](auto type) {
    constexpr int values = decltype(type)::type::state_values;
    if (values == 0) return;
    law.growth = to_device("penalty growth", growth_points(contact.penalty_growth));
    law.state = Array<double*>("contact law state", static_cast<std::size_t>(values) * slaves);
  });
  return law;
}

std::vector<double> friction_now(const scene::Contact& contact, const ContactLawArrays& law) {
  const auto values = friction_values(contact, law);
  return to_vector(Array<double*>(Kokkos::subview(law.state, values)));
}

void reset_contact_law(const scene::Contact& contact, const ContactLawArrays& law) {
  const auto values = friction_values(contact, law);
  if (values.second > values.first) Kokkos::deep_copy(Kokkos::subview(law.state, values), contact.friction);
}

double largest_growth(const scene::Contact& contact) {
  double largest = 1;
  for (const auto& point : contact.penalty_growth) largest = std::max(largest, point[1]);
  return largest;
}

std::string describe_contact(const scene::Contact& contact) {
  return contact.name + (contact.master.size() > 1 ? " on " + contact.master.text() : "");
}

std::string describe_algorithm(const scene::Contact& contact) {
  const bool springs = contact.algorithm == scene::ContactAlgorithm::penalty;
  const std::string name = springs ? "penalty springs" : "multipliers";
  if (!contact.algorithm_reason) return name;
  return name + (springs ? ", as " + *contact.algorithm_reason : ", the default");
}

std::string chosen_algorithms(const scene::Scene& scene) {
  std::string text = "algorithms";
  for (const scene::Contact& contact : scene.contacts)
    if (contact.algorithm_reason) text += fmt::format(" {} {}", contact.name, static_cast<int>(contact.algorithm));
  return text;
}

std::string describe_contact_law(const scene::Contact& contact) {
  std::string words = contact.friction > 0 ? ", friction" : ", frictionless";
  if (contact.falling_friction()) words += " that falls with speed";
  if (!contact.penalty_growth.empty()) words += ", growing penalty";
  if (contact.normals != scene::ContactNormals::facet) words += ", smooth normals";
  if (contact.damping > 0) words += ", damping";
  return words;
}

}  // namespace railwave
