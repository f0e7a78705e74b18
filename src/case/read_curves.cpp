#include "case/read_curves.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>

#include "case/memory.hpp"

namespace railwave::case_file {
namespace {

/// The number at the beginning of `text` and what follows it; nothing where there is none, or it isn't finite.
std::optional<double> leading_number(const std::string& text, std::string& rest) {
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  if (end == text.c_str() || !std::isfinite(value)) return std::nullopt;
  rest = end;
  return value;
}

std::string without_blanks(const std::string& text) {
  const auto first = text.find_first_not_of(" \t\r");
  return first == std::string::npos ? "" : text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

/// What is wrong with the line; empty: its pair is added.
std::string read_pair(const std::string& line, std::vector<std::array<double, 2>>& points) {
  std::string rest, end;
  const auto time = leading_number(line, rest);
  if (!time) return points.empty() ? "" : "'" + printable(line, 40) + "' is no pair time,value";
  rest = without_blanks(rest);
  if (!rest.empty() && (rest[0] == ',' || rest[0] == ';')) rest = rest.substr(1);
  const auto value = leading_number(rest, end);
  if (!value) return "'" + printable(line, 40) + "' is no pair time,value";
  if (!points.empty() && !(*time > points.back()[0]))
    return fmt::format("time must increase from line to line, but has {} s after {} s", *time, points.back()[0]);
  points.push_back({*time, *value});
  return "";
}

/// Why a file isn't read at all; empty: it is.
std::string refusal(const std::string& path) {
  constexpr std::uintmax_t largest = 256u << 20;  // about ten million points
  std::error_code failed;
  if (!std::filesystem::is_regular_file(path, failed)) return "'" + path + "' is no regular file";
  const auto size = std::filesystem::file_size(path, failed);
  if (!failed && size > largest)
    return fmt::format("'{}' has {}, at most {} are read; give fewer points, for instance every tenth", path, bytes_text(static_cast<double>(size)),
                       bytes_text(static_cast<double>(largest)));
  return "";
}

}  // namespace

void read_curves(scene::Scene& scene, Complaints& complaints) {
  for (scene::Curve& curve : scene.curves) {
    if (curve.file.empty()) continue;
    const std::string subject = "[curves." + curve.name + "] file: ";
    std::string line, mistake = refusal(curve.file);
    std::ifstream file;
    if (mistake.empty()) file.open(curve.file, std::ios::binary);
    if (mistake.empty() && !file) mistake = "'" + curve.file + "' cannot be opened; check that you may read it";
    for (int number = 1; mistake.empty() && std::getline(file, line); ++number) {
      line = without_blanks(line);
      if (line.empty()) continue;
      mistake = read_pair(line, curve.points);
      if (!mistake.empty()) mistake = fmt::format("{}:{}: {}", curve.file, number, mistake);
    }
    if (mistake.empty() && curve.points.empty()) mistake = "'" + curve.file + "' has no line with a pair time,value";
    if (!mistake.empty()) complaints.add({curve.line}, subject + mistake);
    for (const auto& [time, value] : curve.points)
      scene.static_text += fmt::format(".curves.{} {:.17g} {:.17g}\n", curve.name, time, value);
  }
}

}  // namespace railwave::case_file
