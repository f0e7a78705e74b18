#pragma once

#include <fmt/format.h>

#include <string>
#include <vector>

#include "case/error.hpp"
#include "case/scene.hpp"

namespace railwave {

/// "[meshes.NAME] (line N): ", the beginning of each complaint about a mesh's parameters.
inline std::string place_of(const scene::MeshSource& source) {
  return fmt::format("[meshes.{}] (line {}): ", source.name, source.line);
}

/// Collects complaints about parameters that do not fit each other.
class MeshChecks {
 public:
  explicit MeshChecks(const scene::MeshSource& source) : place_(place_of(source)) {}

  template <class Value>
  void expect(bool good, const char* key, const Value& value, const std::string& allowed) {
    if (!good) complaints_.push_back(fmt::format("{}{} = {}; allowed: {}", place_, key, value, allowed));
  }

  /// A path of finer cells: it holds the zone, and lies between two limits.
  void path(double path_start, double path_end, double zone_start, double zone_end, double first, double last,
            double path_size, double zone_size, double coarse_size) {
    expect(path_start >= first - 1e-9 && path_start <= zone_start, "path_start", path_start,
           fmt::format("{:g} m to zone_start = {:g} m", first, zone_start));
    expect(path_end >= zone_end && path_end <= last + 1e-9, "the path's end", path_end,
           fmt::format("the zone's end = {:g} m to {:g} m", zone_end, last));
    expect(path_size >= zone_size && path_size <= coarse_size, "path_size", path_size,
           fmt::format("zone_size = {:g} to coarse_size = {:g} m", zone_size, coarse_size));
  }

  /// What wheel and rail share.
  void grading(double zone_size, double growth, double coarse_size, double core_size, double section_size,
               int zone_layers, int web_columns) {
    expect(zone_size >= 1e-4 && zone_size <= 0.01, "zone_size", zone_size, "0.0001 to 0.01 m");
    expect(growth >= 1.05 && growth <= 2, "growth", growth, "1.05 to 2");
    expect(coarse_size >= zone_size && coarse_size <= 0.2, "coarse_size", coarse_size,
           fmt::format("zone_size = {:g} to 0.2 m", zone_size));
    expect(core_size >= 3 * zone_size && core_size <= 0.5, "core_size", core_size,
           fmt::format("3 zone_size = {:g} to 0.5 m", 3 * zone_size));
    expect(section_size >= zone_size && section_size >= 0.002 && section_size <= 0.012, "section_size", section_size,
           fmt::format("zone_size = {:g} m, at least 0.002, to 0.012 m", zone_size));
    expect(zone_layers >= 1 && zone_layers <= 20, "zone_layers", zone_layers, "1 to 20");
    expect(web_columns >= 1 && web_columns <= 9, "web_columns", web_columns, "1 to 9");
  }

  /// Throws InputError with all complaints, if there are any.
  void report() const {
    if (!complaints_.empty()) throw InputError(complaints_);
  }

 private:
  std::string place_;
  std::vector<std::string> complaints_;
};

}  // namespace railwave
