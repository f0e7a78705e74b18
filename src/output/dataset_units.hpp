#pragma once

#include <string>

namespace railwave {

/// SI unit of a dataset in results, model, mode and fault files, which each gets as its attribute `unit`; "1" of
/// numbers, counts and shares. Empty for a dataset that is none of these, as in checkpoints. Files of columns (contact
/// solutions, signals, responses, decay rates) have units of their own.
/// @param path in the file, e.g. /history/set/rail.middle/stress
std::string unit_of(const std::string& path);

}  // namespace railwave
