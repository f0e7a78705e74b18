#pragma once

#include <stdexcept>
#include <string>

#include "model/fields.hpp"

namespace railwave {

/// The field of nodes that a case calls displacement, velocity or acceleration.
inline NodeField node_field_named(const std::string& name) {
  if (name == "displacement") return NodeField::displacement;
  if (name == "velocity") return NodeField::velocity;
  if (name == "acceleration") return NodeField::acceleration;
  throw std::logic_error("there is no field " + name);
}

}  // namespace railwave
