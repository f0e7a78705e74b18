#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <vector>

#include "model/contact/contact_state.hpp"

namespace railwave {

using Vector = Eigen::Vector3d;

/// Entry `i` of an array of vectors, three components each.
inline Vector entry(const std::vector<double>& vectors, std::size_t i) { return Vector(vectors.data() + 3 * i); }

}  // namespace railwave
