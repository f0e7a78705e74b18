#pragma once

#include "case/field_table.hpp"
#include "solve/observer.hpp"

namespace railwave {

/// Where in the means of a set's nodes, or of its elements, the values of a row of the table begin: as many as it has
/// components. Both functions throw std::logic_error for a row that has no entry; rows that serve `histories` all have
/// one.
using MotionValues = const double* (*)(const MeanMotion&);
using ElementValues = const double* (*)(const ElementMeans&);

MotionValues motion_values(const FieldRow& row);
ElementValues element_values(const FieldRow& row);

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
