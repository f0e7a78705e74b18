#pragma once

#include "solve/observer.hpp"

namespace railwave {

struct EnergyTerm {
  const char* name;
  double EnergyAccount::*value;
};

/// Every term of the energy account under the name that files and tables give it.
inline constexpr EnergyTerm energy_terms[] = {
    {"kinetic", &EnergyAccount::kinetic},
    {"internal", &EnergyAccount::internal},
    {"hourglass", &EnergyAccount::hourglass},
    {"contact", &EnergyAccount::contact},
    {"friction", &EnergyAccount::friction},
    {"connector", &EnergyAccount::connector},
    {"damping", &EnergyAccount::damping},
    {"plastic", &EnergyAccount::plastic},
    {"external_work", &EnergyAccount::external_work},
    {"balance_error", &EnergyAccount::balance_error},
};

}  // namespace railwave
