#pragma once

#include <string>
#include <vector>

namespace railwave {

/// What is taken out of a signal before it is looked at.
enum class Trend { none, mean, line };

/// The names above. Throws InputError for another, with a suggestion.
Trend trend_named(const std::string& name);

/// The values without their mean, or without the straight line of least squares.
std::vector<double> without_trend(const std::vector<double>& values, Trend trend);

}  // namespace railwave
