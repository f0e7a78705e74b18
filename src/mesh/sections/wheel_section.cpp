#include "mesh/sections/wheel_section.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "mesh/grading.hpp"
#include "mesh/sections/profiles.hpp"
#include "mesh/sections/section.hpp"
#include "mesh/sections/section_columns.hpp"

namespace railwave {

namespace {

constexpr double inner_side = s1002_first;  // lateral position of the rim's inner face
constexpr double tread_from = -0.020;       // flange root: inside of it the layers' base runs level
constexpr int hub_rows = 4;

bool has_flange(const scene::WheelMesh& wheel) { return wheel.profile == "S1002"; }

double field_side(const scene::WheelMesh& wheel) { return inner_side + wheel.rim_width; }

class WheelSectionBuilder {
 public:
  WheelSectionBuilder(const scene::WheelMesh& wheel, bool lower_transition)
      : wheel_(wheel), lower_transition_(lower_transition), surface_(wheel_running_surface(wheel)) {}

  SectionMesh build(bool smoothed) {
    plan_columns();
    add_layers();
    add_rim();
    add_web();
    add_hub();
    if (!smoothed) return std::move(section_);
    fix_zone(section_, layers_, columns_, surface_, wheel_.zone_layers, size());
    set_ideal_shapes(section_, size());
    smooth_section(section_);
    return std::move(section_);
  }

 private:
  double size() const { return wheel_.zone_size; }
  double layer_depth() const { return size() * (wheel_.zone_layers + transition_height); }

  void plan_columns() {
    const double centre = arc_at(wheel_.zone_centre);
    const int zone = zone_columns(wheel_.zone_width, size());
    const double first = centre - zone * size() / 2, last = centre + zone * size() / 2;
    if (first < -1e-9 || last > surface_.length + 1e-9)
      throw std::invalid_argument(
          fmt::format("the contact band of zone_width = {:g} m about zone_centre = {:g} m does not lie on the running "
                      "surface; allowed: "
                      "lateral positions {:.4f} to {:.4f} m",
                      wheel_.zone_width, wheel_.zone_centre, surface_.begin().y, surface_.end().y));
    columns_ = surface_columns(0, first, last, surface_.length, zone, size(), wheel_.growth, wheel_.section_size, 3);
    merges_ =
        plan_merges(columns_, 1.6 * wheel_.section_size, 3.3 * wheel_.section_size, wheel_.web_columns + 2, 1 << 20);
  }

  Point2 base_point(double y) const {
    return {y, wheel_surface_radius(wheel_, std::clamp(y, tread_from, std::min(s1002_last, field_side(wheel_)))) -
                   layer_depth()};
  }

  void add_layers() {
    rows_.assign(wheel_.zone_layers, Row{RowKind::plain, size()});
    rows_.push_back({RowKind::longitudinal, transition_height * size()});
    const auto fractions = row_fractions(rows_);

    const Point2 foot{inner_side, wheel_.rim_inner_radius};
    Curve inner = line(surface_.begin(), foot);
    if (has_flange(wheel_)) {
      const Point2 side{inner_side, wheel_.radius + s1002_flange_back_centre.z};
      inner = joined({arc(surface_.begin(), side, s1002_flange_back_radius), line(side, foot)});
    }
    inner_curve_ = section_.add_curve(inner);
    field_curve_ = section_.add_curve(field_side_curve());

    std::vector<int> top;
    for (double arc_length : columns_.boundaries) top.push_back(section_.add_fixed_node(surface_.at(arc_length)));
    const double inner_depth = inner.length - (base_point(inner_side).z - foot.z);
    std::vector<int> left{top.front()}, right{top.back()};
    for (std::size_t i = 1; i < fractions.size(); ++i) {
      left.push_back(section_.add_curve_node(inner_curve_, inner_depth * fractions[i]));
      right.push_back(section_.add_curve_node(field_curve_, field_depth(static_cast<int>(i), fractions)));
    }
    if (chamfer_ > 0) section_.nodes[right[wheel_.zone_layers]].fixed = true;
    // Base line: below the tread straight down, below the flange drawn together to its foot's width.
    std::vector<int> base{left.back()};
    const double root_arc = arc_at(tread_from);
    for (std::size_t i = 1; i + 1 < columns_.boundaries.size(); ++i) {
      const double arc_length = columns_.boundaries[i];
      const double y = arc_length < root_arc ? inner_side + (tread_from - inner_side) * arc_length / root_arc
                                             : surface_.at(arc_length).y;
      base.push_back(section_.add_node(base_point(y)));
    }
    base.push_back(right.back());
    layers_ = fill_block(section_, top, rows_, {}, left, right, base, 0);
    rim_line_ = base;
    const int count = static_cast<int>(layers_[0].first_quads.size());
    for (int quad : layers_[0].first_quads) section_.edges["running_surface"].push_back({quad, 2});
    for (int c = std::max(0, columns_.zone_first - 2); c < std::min(count, columns_.zone_last + 2); ++c)
      section_.edges["tread"].push_back({layers_[0].first_quads[c], 2});
  }

  /// The rim's outer side: chamfer, if the rim is wider than the profile, and field face.
  Curve field_side_curve() {
    const Point2 top = surface_.end(), foot{field_side(wheel_), wheel_.rim_inner_radius};
    const double width = foot.y - top.y;
    if (width < 1e-6) return line(top, foot);
    const Point2 edge{foot.y, top.z - width};
    chamfer_ = norm(edge - top);
    return joined({line(top, edge), line(edge, foot)});
  }

  /// Arc length on the rim's outer side of the i-th line of layers; the zone's layers end at the chamfer's edge.
  double field_depth(int i, const std::vector<double>& fractions) const {
    const double level = surface_.end().z - base_point(field_side(wheel_)).z;
    if (chamfer_ == 0) return level * fractions[i];
    const int layers = wheel_.zone_layers;
    if (i <= layers) return chamfer_ * i / layers;
    return chamfer_ + std::max(level - chamfer_ / std::sqrt(2.0), size());
  }

  /// Arc length on the running surface at a lateral position.
  double arc_at(double y) const {
    double low = 0, high = surface_.length;
    for (int i = 0; i < 60; ++i) {
      const double middle = (low + high) / 2;
      (surface_.at(middle).y < y ? low : high) = middle;
    }
    return low;
  }

  /// Rim below the layers: its under side is two flares and, between them, the web's outer end.
  void add_rim() {
    std::vector<Row> rows = lateral_rows(static_cast<int>(merges_.size()), size());
    const double depth = section_.position(rim_line_.front()).z - wheel_.rim_inner_radius;
    double used = 0, last = 2 * size();
    for (const Row& row : rows) used += last = row.height;
    const double rest = std::max(depth - used, 0.3 * depth);
    for (double height : graded_cells(rest, std::min(last, 1.6 * wheel_.section_size), 1.4, 1.8 * wheel_.section_size))
      rows.push_back({RowKind::plain, height});
    const auto fractions = row_fractions(rows);

    const std::array<int, 2> side_curve{inner_curve_, field_curve_};
    std::vector<int> side[2];
    for (int s = 0; s < 2; ++s) {
      const int first = s == 0 ? rim_line_.front() : rim_line_.back();
      const double from = section_.nodes[first].parameter, length = section_.curves[side_curve[s]].length;
      side[s] = {first};
      for (std::size_t i = 1; i + 1 < fractions.size(); ++i)
        side[s].push_back(section_.add_curve_node(side_curve[s], from + (length - from) * fractions[i]));
      side[s].push_back(section_.add_fixed_node(section_.curves[side_curve[s]].end()));
    }

    std::vector<double> widths = columns_.sizes;
    for (const auto& groups : merges_) widths = merged_sizes(widths, groups);
    const int columns = static_cast<int>(widths.size()), web = wheel_.web_columns;
    if (columns < web + 2)
      throw std::invalid_argument(fmt::format(
          "web_columns = {} is too many for the rim's {} columns; allowed: up to {}", web, columns, columns - 2));
    const int wing = wing_columns(widths, web);
    const double half = wheel_.web_outer_thickness / 2;
    const int web_left = section_.add_fixed_node({wheel_.web_centre - half, wheel_.web_outer_radius});
    const int web_right = section_.add_fixed_node({wheel_.web_centre + half, wheel_.web_outer_radius});
    const auto flare = [&](int from, int to, int parts) {
      const int curve = section_.add_curve(line(section_.position(from), section_.position(to)));
      return section_.add_curve_line(from, curve, parts, to);
    };
    std::vector<int> bottom = flare(side[0].back(), web_left, wing);
    web_line_ = straight_line(section_, web_left, web_right, even_fractions(web));
    bottom.insert(bottom.end(), web_line_.begin() + 1, web_line_.end());
    const auto field = flare(web_right, side[1].back(), columns - wing - web);
    bottom.insert(bottom.end(), field.begin() + 1, field.end());
    fill_block(section_, rim_line_, rows, merges_, side[0], side[1], bottom, 1);
  }

  /// How many of the rim's columns lie inside of the web, so that the web's columns start nearest below their own.
  int wing_columns(const std::vector<double>& widths, int web) const {
    std::vector<int> kept(columns_.boundaries.size());  // surface column boundaries that all merges keep
    for (std::size_t i = 0; i < kept.size(); ++i) kept[i] = static_cast<int>(i);
    for (const auto& groups : merges_) {
      std::vector<int> next{kept[0]};
      std::size_t i = 0;
      for (int group : groups) next.push_back(kept[i += group]);
      kept = next;
    }
    int best = 1;
    double least = 1e300;
    for (int wing = 1; wing + web < static_cast<int>(widths.size()); ++wing) {
      const double middle =
          (section_.position(rim_line_[kept[wing]]).y + section_.position(rim_line_[kept[wing + web]]).y) / 2;
      if (std::abs(middle - wheel_.web_centre) < least) {
        least = std::abs(middle - wheel_.web_centre);
        best = wing;
      }
    }
    return best;
  }

  void add_web() {
    const double length = wheel_.web_outer_radius - wheel_.web_inner_radius, row = 2.3 * wheel_.section_size;
    std::vector<Row> rows;
    double used = 0;
    if (lower_transition_) {
      const double shrink = (wheel_.web_outer_radius - row) / wheel_.radius;
      rows = {{RowKind::plain, row}, {RowKind::longitudinal, 3 * transition_height * size() * shrink}};
      used = rows[0].height + rows[1].height;
    }
    const double rest = std::max(length - used, 0.3 * length);
    const int plain = std::max(1, static_cast<int>(std::round(rest / row)));
    for (int i = 0; i < plain; ++i) rows.push_back({RowKind::plain, rest / plain});
    const auto fractions = row_fractions(rows);
    std::vector<int> side[2];
    for (int s = 0; s < 2; ++s) {
      const int first = s == 0 ? web_line_.front() : web_line_.back();
      const double half = (s == 0 ? -0.5 : 0.5) * wheel_.web_inner_thickness;
      const int last = section_.add_fixed_node({wheel_.web_centre + half, wheel_.web_inner_radius});
      const int curve = section_.add_curve(line(section_.position(first), section_.position(last)));
      side[s] = {first};
      for (std::size_t i = 1; i + 1 < fractions.size(); ++i)
        side[s].push_back(section_.add_curve_node(curve, section_.curves[curve].length * fractions[i]));
      side[s].push_back(last);
    }
    const auto bottom = straight_line(section_, side[0].back(), side[1].back(), even_fractions(wheel_.web_columns));
    fill_block(section_, web_line_, rows, {}, side[0], side[1], bottom, 1);
    web_line_ = bottom;
  }

  void add_hub() {
    const int level = lower_transition_ ? 2 : 1;
    const double half = wheel_.hub_width / 2, wing_width = half - wheel_.web_inner_thickness / 2;
    const int wing = std::max(1, static_cast<int>(std::round(wing_width / (3 * wheel_.section_size))));
    std::vector<int> top_corner, bottom_corner;
    for (double y : {wheel_.web_centre - half, wheel_.web_centre + half}) {
      top_corner.push_back(section_.add_fixed_node({y, wheel_.hub_radius}));
      bottom_corner.push_back(section_.add_fixed_node({y, wheel_.bore_radius}));
    }
    const auto on_line = [&](int from, int to, int parts) {
      const int curve = section_.add_curve(line(section_.position(from), section_.position(to)));
      return section_.add_curve_line(from, curve, parts, to);
    };
    std::vector<int> top = on_line(top_corner[0], web_line_.front(), wing);
    top.insert(top.end(), web_line_.begin() + 1, web_line_.end());
    const auto right = on_line(web_line_.back(), top_corner[1], wing);
    top.insert(top.end(), right.begin() + 1, right.end());
    const auto bore = on_line(bottom_corner[0], bottom_corner[1], 2 * wing + wheel_.web_columns);
    fill_block(section_, top, std::vector<Row>(hub_rows, Row{RowKind::plain, 1}), {},
               on_line(top_corner[0], bottom_corner[0], hub_rows), on_line(top_corner[1], bottom_corner[1], hub_rows),
               bore, level);
    section_.node_sets["bore"] = bore;
  }

  const scene::WheelMesh& wheel_;
  bool lower_transition_;
  Curve surface_;
  SectionMesh section_;
  SurfaceColumns columns_;
  std::vector<std::vector<int>> merges_;
  std::vector<Row> rows_;
  std::vector<BlockRow> layers_;
  std::vector<int> rim_line_, web_line_;
  int inner_curve_ = -1, field_curve_ = -1;
  double chamfer_ = 0;  ///< its length along the outline
};

}  // namespace

double wheel_surface_radius(const scene::WheelMesh& wheel, double y) {
  return wheel.radius + (has_flange(wheel) ? s1002_height(y) : -wheel.conicity * y);
}

Curve wheel_running_surface(const scene::WheelMesh& wheel) {
  const double field = field_side(wheel);
  if (!has_flange(wheel))
    return line({inner_side, wheel_surface_radius(wheel, inner_side)}, {field, wheel_surface_radius(wheel, field)});
  return s1002_curve(wheel.radius, std::min(s1002_last, field));
}

SectionMesh wheel_section(const scene::WheelMesh& wheel, bool lower_transition, bool smoothed) {
  return WheelSectionBuilder(wheel, lower_transition).build(smoothed);
}

}  // namespace railwave
