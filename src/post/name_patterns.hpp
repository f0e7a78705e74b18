#pragma once

#include <string>

namespace railwave {

/// Whether `name` is `pattern`, whose stars stand for any letters.
bool matches_pattern(const std::string& pattern, const std::string& name);

/// By alphabet, but numbers by their value: row_2 comes before row_10.
bool in_number_order(const std::string& a, const std::string& b);

}  // namespace railwave
