#pragma once

#include <vector>

#include "solve/observer.hpp"

namespace railwave::verify {

inline void add_components(std::vector<double>& numbers, const Vec3& v) {
  numbers.insert(numbers.end(), v.begin(), v.end());
}

/// All that a sample has.
inline std::vector<double> numbers_of(const HistorySample& sample) {
  const EnergyAccount& e = sample.energy;
  std::vector<double> numbers{sample.time,    static_cast<double>(sample.step),
                              e.kinetic,      e.internal,
                              e.hourglass,    e.contact,
                              e.friction,     e.connector,
                              e.damping,      e.plastic,
                              e.impacts,      e.external_work,
                              e.balance_error};
  for (const ContactTotals& contact : sample.contacts) {
    add_components(numbers, contact.normal_force);
    add_components(numbers, contact.tangential_force);
    add_components(numbers, contact.master_force);
    numbers.push_back(contact.nodes_in_contact);
    numbers.push_back(contact.nodes_slipping);
  }
  for (const MeanMotion& set : sample.sets) {
    add_components(numbers, set.displacement);
    add_components(numbers, set.velocity);
    add_components(numbers, set.acceleration);
  }
  for (const LoadTotals& load : sample.loads) {
    add_components(numbers, load.force);
    numbers.push_back(load.work);
  }
  for (const ReactionTotals& reaction : sample.reactions) {
    add_components(numbers, reaction.force);
    numbers.push_back(reaction.work);
  }
  for (const BeamResultants& beam : sample.beams)
    for (const auto* values : {&beam.force, &beam.moment})
      numbers.insert(numbers.end(), values->begin(), values->end());
  return numbers;
}

}  // namespace railwave::verify
