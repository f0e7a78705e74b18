#include <fmt/format.h>

#include <array>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "case/error.hpp"
#include "case/expand.hpp"
#include "case/memory.hpp"
#include "case/number_table.hpp"

namespace railwave::case_file {
namespace {

/// Why a file isn't read at all; empty: it is.
std::string refusal(const std::string& path) {
  constexpr std::uintmax_t largest = 256u << 20;  // about ten million points
  std::error_code failed;
  if (!std::filesystem::is_regular_file(path, failed)) return "'" + path + "' is no regular file";
  const auto size = std::filesystem::file_size(path, failed);
  if (!failed && size > largest)
    return fmt::format("'{}' has {}, at most {} are read; give fewer points, for instance every tenth", path,
                       bytes_text(static_cast<double>(size)), bytes_text(static_cast<double>(largest)));
  return "";
}

/// The pairs of a file that may be read. Throws InputError with its line.
std::vector<std::array<double, 2>> read_pairs(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw InputError("'" + path + "' cannot be opened; check that you may read it");
  const std::string text{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  std::vector<std::array<double, 2>> points;
  parse_number_table(
      text, path, {time_column("time"), {"value", "", {}}}, TableNames::may_stand,
      [&](int line, const std::vector<double>& pair) {
        if (!points.empty() && !(pair[0] > points.back()[0]))
          throw InputError(fmt::format("{}:{}: time must increase from line to line, but has {} s after {} s", path,
                                       line, pair[0], points.back()[0]));
        points.push_back({pair[0], pair[1]});
      });
  if (points.empty()) throw InputError("'" + path + "' has no line with a pair time,value");
  return points;
}

}  // namespace

void read_curves(scene::Scene& scene, Complaints& complaints) {
  for (scene::Curve& curve : scene.curves) {
    if (curve.file.empty()) continue;
    std::string mistake = refusal(curve.file);
    try {
      if (mistake.empty()) curve.points = read_pairs(curve.file);
    } catch (const InputError& error) {
      mistake = error.what();
    }
    if (!mistake.empty()) complaints.add({curve.line}, "[curves." + curve.name + "] file: " + mistake);
    for (const auto& [time, value] : curve.points)
      scene.static_text += fmt::format(".curves.{} {:.17g} {:.17g}\n", curve.name, time, value);
  }
}

}  // namespace railwave::case_file
