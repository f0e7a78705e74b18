#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace railwave {

/// Number of letters to insert, drop, change or swap with their neighbour to make `b` of `a`; capitals count as small
/// letters (optimal string alignment).
std::size_t edit_distance(const std::string& a, const std::string& b);

/// The candidate most like `word`, or "" when none is near: at most a third of the letters differ, or one is a part of
/// the other.
std::string nearest_name(const std::string& word, const std::vector<std::string>& candidates);

/// What to say after "there is no such name": "did you mean 'steel'?", or else all candidates ("known are: a, b"), or
/// "" without any.
std::string suggestion(const std::string& word, const std::vector<std::string>& candidates);

/// "a, b, c".
std::string joined(const std::vector<std::string>& words, const std::string& between = ", ");

}  // namespace railwave
