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

}  // namespace railwave
