#include "model/contact_law.hpp"

#include <algorithm>

#include "model/host_copy.hpp"

namespace railwave {
namespace {

/// See PenaltyGrowth. The first point is moved or copied to no penetration: the factor is constant before it.
std::vector<std::array<double, 5>> growth_points(std::vector<std::array<double, 2>> given) {
  if (given.empty()) given.push_back({0, 1});
  if (given.front()[0] > 0) given.insert(given.begin(), {0, given.front()[1]});
  std::vector<std::array<double, 5>> points;
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

}  // namespace

ContactLawArrays make_contact_law(const scene::Contact& contact, int slaves) {
  ContactLawArrays law;
  law.active =
      contact.falling_friction() || !contact.penalty_growth.empty() || contact.damping > 0 ||
      (contact.normals != scene::ContactNormals::facet && contact.algorithm == scene::ContactAlgorithm::penalty);
  if (!law.active) return law;
  law.growth.points = to_device("penalty growth", growth_points(contact.penalty_growth));
  law.damping = contact.damping;
  if (contact.damping > 0) {
    law.damping_force = Array<double*>("contact damping force", slaves);
    law.damping_energy = Array<double*>("contact damping energy", slaves);
  }
  if (contact.falling_friction()) {
    law.dynamic_friction = *contact.dynamic_friction;
    law.friction_decay = contact.friction_decay;
    law.friction_now = Array<double*>("friction now", slaves);
  }
  return law;
}

void reset_contact_law(const ContactLawArrays& law, double static_friction) {
  if (law.friction_now.extent(0) > 0) Kokkos::deep_copy(law.friction_now, static_friction);
}

double largest_growth(const scene::Contact& contact) {
  double largest = 1;
  for (const auto& point : contact.penalty_growth) largest = std::max(largest, point[1]);
  return largest;
}

std::string describe_contact(const scene::Contact& contact) {
  return contact.name + (contact.master.size() > 1 ? " on " + contact.master.text() : "");
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
