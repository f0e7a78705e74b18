#include "case/suggest.hpp"

#include <algorithm>
#include <cctype>

namespace railwave {
namespace {

std::string small_letters(std::string word) {
  for (auto& letter : word) letter = static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
  return word;
}

bool contains(const std::string& longer, const std::string& shorter) {
  return shorter.size() >= 3 && longer.find(shorter) != std::string::npos;
}

}  // namespace

std::size_t edit_distance(const std::string& first, const std::string& second) {
  const auto a = small_letters(first), b = small_letters(second);
  std::vector<std::size_t> before, last(b.size() + 1), row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) last[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1)});
      const bool swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
      if (swapped) row[j] = std::min(row[j], before[j - 2] + 1);
    }
    before = last;
    last = row;
  }
  return last[b.size()];
}

std::string nearest_name(const std::string& word, const std::vector<std::string>& candidates) {
  if (word.size() > 100) return "";
  std::string nearest;
  std::size_t least = 0;
  for (const auto& candidate : candidates) {
    const auto distance = edit_distance(word, candidate);
    const auto allowed = std::max<std::size_t>(1, std::max(word.size(), candidate.size()) / 3);
    const bool similar = distance <= allowed && distance < std::max(word.size(), candidate.size());
    const bool part = contains(small_letters(candidate), small_letters(word)) ||
                      contains(small_letters(word), small_letters(candidate));
    if (!similar && !part) continue;
    if (nearest.empty() || distance < least) {
      nearest = candidate;
      least = distance;
    }
  }
  return nearest;
}

std::string suggestion(const std::string& word, const std::vector<std::string>& candidates) {
  if (candidates.empty()) return "";
  const auto near = nearest_name(word, candidates);
  if (!near.empty()) return "did you mean '" + near + "'?";
  // As many as fit into a message.
  constexpr std::size_t longest = 300;
  std::vector<std::string> shown;
  std::size_t letters = 0;
  for (const auto& candidate : candidates) {
    letters += candidate.size() + 2;
    if (letters > longest && !shown.empty()) break;
    shown.push_back(candidate);
  }
  const std::size_t others = candidates.size() - shown.size();
  return "known are: " + joined(shown) + (others == 0 ? "" : " and " + std::to_string(others) + " more");
}

std::string joined(const std::vector<std::string>& words, const std::string& between) {
  std::string text;
  for (const auto& word : words) text += (text.empty() ? "" : between) + word;
  return text;
}

}  // namespace railwave
