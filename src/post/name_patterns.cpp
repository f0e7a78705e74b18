#include <algorithm>
#include <string_view>

#include "case/number_text.hpp"
#include "post/channel_name.hpp"

namespace railwave {
namespace {

bool matches(const char* pattern, const char* name) {
  if (*pattern == '\0') return *name == '\0';
  if (*pattern == '*') return matches(pattern + 1, name) || (*name != '\0' && matches(pattern, name + 1));
  return *pattern == *name && matches(pattern + 1, name + 1);
}

}  // namespace

bool matches_pattern(const std::string& pattern, const std::string& name) {
  return matches(pattern.c_str(), name.c_str());
}

bool in_number_order(const std::string& a, const std::string& b) {
  const auto digit = [](char c) { return c >= '0' && c <= '9'; };
  std::size_t i = 0, j = 0;
  while (i < a.size() && j < b.size()) {
    if (digit(a[i]) && digit(b[j])) {
      const std::size_t end_a = std::min(a.size(), a.find_first_not_of("0123456789", i)),
                        end_b = std::min(b.size(), b.find_first_not_of("0123456789", j));
      const double number_a = leading_real(std::string_view(a).substr(i, end_a - i)),
                   number_b = leading_real(std::string_view(b).substr(j, end_b - j));
      if (number_a != number_b) return number_a < number_b;
      i = end_a;
      j = end_b;
    } else if (a[i] != b[j]) {
      return a[i] < b[j];
    } else {
      ++i;
      ++j;
    }
  }
  return a.size() - i < b.size() - j;
}

}  // namespace railwave
