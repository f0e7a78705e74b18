#include "case/complaints.hpp"

#include <algorithm>
#include <limits>

#include "case/error.hpp"

namespace railwave::case_file {
namespace {

constexpr std::size_t most_shown = 50;

int rank(const Where& where) {
  if (where.override_number > 0) return std::numeric_limits<int>::max();
  return where.line > 0 ? where.line : std::numeric_limits<int>::max() - 1;
}

}  // namespace

void Complaints::add(Where where, const std::string& text) { found_.push_back({where, text}); }

void Complaints::throw_if_any() const {
  if (!found_.empty()) throw InputError(lines());
}

std::string Complaints::origin(const Where& where) const {
  const auto number = static_cast<std::size_t>(where.override_number);
  if (number > 0) return number <= origins_.size() ? origins_[number - 1] : "command line";
  return where.line > 0 ? file_ + ":" + std::to_string(where.line) : file_;
}

std::vector<std::string> Complaints::lines() const {
  auto sorted = found_;
  std::stable_sort(sorted.begin(), sorted.end(),
                   [](const Complaint& a, const Complaint& b) { return rank(a.where) < rank(b.where); });
  std::vector<std::string> lines;
  for (const auto& complaint : sorted) {
    if (lines.size() == most_shown) {
      lines.push_back(file_ + ": and " + std::to_string(sorted.size() - most_shown) + " more mistakes");
      break;
    }
    lines.push_back(origin(complaint.where) + ": " + complaint.text);
  }
  return lines;
}

std::string printable(const std::string& text, std::size_t longest) {
  std::string result = text.substr(0, longest);
  for (auto& letter : result) {
    if (static_cast<unsigned char>(letter) < 0x20 || letter == 0x7f) letter = '?';
  }
  // A cut in the middle of a UTF-8 letter would leave half of it.
  while (text.size() > longest && !result.empty() && (static_cast<unsigned char>(result.back()) & 0x80) != 0)
    result.pop_back();
  return text.size() > longest ? result + "..." : result;
}

}  // namespace railwave::case_file
