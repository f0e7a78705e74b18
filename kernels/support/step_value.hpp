#pragma once

#include "kernels/support/spaces.hpp"

namespace railwave {

/// What a kernel is given of a step's time, such as the value of a curve: with its launch, or, where launches are
/// recorded once for many steps, at a place on the device that is filled before each step.
template <class Value>
struct StepValue {
  Value given{};
  const Value* recorded = nullptr;

  KOKKOS_INLINE_FUNCTION const Value& operator()() const { return recorded != nullptr ? *recorded : given; }
};

}  // namespace railwave
