#include "mesh/sections/rail_section.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "mesh/grading.hpp"
#include "mesh/sections/profiles.hpp"
#include "mesh/sections/section.hpp"
#include "mesh/sections/section_columns.hpp"

namespace railwave {
namespace {

constexpr double widest_ring_at_side = 0.016;  // leaves the core and its wings room above the head's underside

/// One half's curves, numbered in the section; the left half's are mirrored, so both run from the crown outwards.
struct Half {
  int underside, web, foot_top, toe;
};

class RailSectionBuilder {
 public:
  explicit RailSectionBuilder(const RailSectionPlan& plan) : plan_(plan), outline_(rail_outline(plan.section)) {
    head_ = joined({reversed(mirrored(outline_.head)), outline_.head});
  }

  SectionMesh build(bool smoothed) {
    for (int side = 0; side < 2; ++side) {
      const auto add = [&](const Curve& curve) { return section_.add_curve(side == 0 ? mirrored(curve) : curve); };
      half_[side] = {add(outline_.underside), add(outline_.web), add(outline_.foot_top), add(outline_.toe)};
    }
    plan_columns();
    add_ring();
    add_core();
    add_web();
    add_foot();
    if (!smoothed) return std::move(section_);
    place_zone();
    set_ideal_shapes(section_, size());
    smooth_section(section_);
    match_outline();
    return std::move(section_);
  }

 private:
  double size() const { return plan_.zone_size; }
  std::vector<int>& fishing_line(int which, int side) {
    return section_.lines[fishing_lines[which] + std::string(side == 0 ? "_left" : "_right")];
  }
  double ring_depth() const { return size() * (plan_.zone_layers + transition_height); }
  double side_depth() const { return std::min(ring_depth(), widest_ring_at_side); }

  /// Arc length from the crown's middle to the point whose inclined lateral coordinate is y.
  double arc_at_inclined(double y) const {
    const double angle = std::atan(plan_.inclination), crown = outline_.head.length;
    double low = -outline_.gauge_corner_end, high = outline_.gauge_corner_end;
    const auto inclined = [&](double arc) {
      const Point2 p = head_.at(crown + arc);
      return p.y * std::cos(angle) - p.z * std::sin(angle);
    };
    if (y < inclined(low) || y > inclined(high))
      throw std::invalid_argument(
          fmt::format("zone_centre = {:g} m is not on the running surface; allowed: {:.4f} to {:.4f} m", y,
                      inclined(low), inclined(high)));
    for (int i = 0; i < 60; ++i) {
      const double middle = (low + high) / 2;
      (inclined(middle) < y ? low : high) = middle;
    }
    return (low + high) / 2;
  }

  void plan_columns() {
    const double crown = outline_.head.length;
    const double centre = arc_at_inclined(plan_.zone_centre);
    const int zone = zone_columns(plan_.zone_width, size());
    const double first = centre - zone * size() / 2, last = centre + zone * size() / 2;
    const double limit = outline_.gauge_corner_end;
    if (first < -limit || last > limit)
      throw std::invalid_argument(fmt::format(
          "the contact band reaches {:.4f} to {:.4f} m along the head's surface from the crown, beyond the gauge "
          "corner; allowed: {:.4f} to {:.4f} m: reduce zone_width or move zone_centre",
          first, last, -limit, limit));
    const double middle = (outline_.crown_end + outline_.gauge_corner_end) / 2;
    const double left = std::max(middle, -first), right = std::max(middle, last);
    columns_ = surface_columns(crown - left, crown + first, crown + last, crown + right, zone, size(), plan_.growth,
                               plan_.section_size, 1);
    core_corner_arc_ = {crown - left, crown + right};
    const double room = outline_.underside.length - side_depth();
    const int wing = std::max(1, static_cast<int>(room / (1.1 * size())));
    merges_ = plan_merges(columns_, 1.6 * plan_.section_size, 2.0 * plan_.section_size, plan_.web_columns + 2,
                          plan_.web_columns + 2 * wing);
  }

  void add_ring() {
    const double depth = ring_depth();
    const double side_depth = this->side_depth();
    rows_.assign(plan_.zone_layers, Row{RowKind::plain, size()});
    rows_.push_back({RowKind::longitudinal, transition_height * size()});

    // Ends of the ring on the head's underside.
    const double crown_arc = outline_.head.length;
    for (int side = 0; side < 2; ++side) {
      ring_end_[side] = {section_.add_fixed_node(section_.curves[half_[side].underside].begin())};
      double down = 0;
      for (const Row& row : rows_)
        ring_end_[side].push_back(
            section_.add_curve_node(half_[side].underside, side_depth * (down += row.height) / depth));
    }

    // The crown's columns and, below them, the core's upper line.
    std::vector<int> top, inner;
    for (double arc : columns_.boundaries) {
      top.push_back(section_.add_fixed_node(head_.at(arc)));
      inner.push_back(section_.add_node(head_.at(arc) - depth * head_.left_normal(arc)));
    }
    // head_ runs clockwise: its left normal points outwards. The core's corners lie well out, so that the columns
    // keep their width.
    for (int side = 0; side < 2; ++side) {
      Point2& corner = section_.nodes[side == 0 ? inner.front() : inner.back()].position;
      const Point2 outside = head_.at(core_corner_arc_[side]);
      const double y = std::abs(outside.y) - 0.65 * side_depth;
      const double above = head_.at(crown_arc + y).z - depth;
      corner = {side == 0 ? -y : y, std::min(above, outside.z - 0.5 * depth)};
    }
    core_top_ = inner;

    const double core_height = section_.position(inner.front()).z - section_.position(ring_end_[0].back()).z;
    core_rows_ = lateral_rows(static_cast<int>(merges_.size()), size());
    double used = 0;
    for (const Row& row : core_rows_) used += row.height;
    const int plain = std::max(1, static_cast<int>(std::ceil((core_height - used) / (1.15 * plan_.section_size))));
    for (int i = 0; i < plain; ++i)
      core_rows_.push_back({RowKind::plain, std::max(core_height - used, 0.3 * core_height) / plain});
    const int side_columns = static_cast<int>(core_rows_.size());

    std::vector<int> diagonal[2];
    for (int side = 0; side < 2; ++side) {
      const int outside = side == 0 ? top.front() : top.back(), inside = side == 0 ? inner.front() : inner.back();
      diagonal[side] = straight_line(section_, outside, inside, row_fractions(rows_));
      // Side columns, from the diagonal downwards.
      std::vector<int> outer{outside};
      for (int i = 1; i < side_columns; ++i) {
        const double f = static_cast<double>(i) / side_columns, corner = core_corner_arc_[side];
        const double arc = side == 0 ? corner * (1 - f) : corner + (head_.length - corner) * f;
        outer.push_back(section_.add_fixed_node(head_.at(arc)));
      }
      outer.push_back(ring_end_[side].front());
      core_side_[side] = straight_line(section_, inside, ring_end_[side].back(), row_fractions(core_rows_));
      outer_[side] = outer;
    }
    std::reverse(outer_[0].begin(), outer_[0].end());
    std::vector<int> left_core = core_side_[0];
    std::reverse(left_core.begin(), left_core.end());

    const auto left = fill_block(section_, outer_[0], rows_, {}, ring_end_[0], diagonal[0], left_core, 0);
    ring_ = fill_block(section_, top, rows_, {}, diagonal[0], diagonal[1], inner, 0);
    const auto right = fill_block(section_, outer_[1], rows_, {}, diagonal[1], ring_end_[1], core_side_[1], 0);
    for (const std::vector<BlockRow>* block : {&left, &std::as_const(ring_), &right})
      for (int quad : block->front().first_quads) section_.edges["running_surface"].push_back({quad, 2});
    const int count = static_cast<int>(ring_[0].first_quads.size());
    for (int c = std::max(0, columns_.zone_first - 2); c < std::min(count, columns_.zone_last + 2); ++c)
      section_.edges["head"].push_back({ring_[0].first_quads[c], 2});
  }

  void add_core() {
    std::vector<double> widths = columns_.sizes;
    for (const auto& groups : merges_) widths = merged_sizes(widths, groups);
    const int columns = static_cast<int>(widths.size()), web = plan_.web_columns;
    if (columns < web + 2)
      throw std::invalid_argument(
          fmt::format("web_columns = {} is too many for the {} columns that zone_size and section_size leave in the "
                      "head; allowed: up to {}",
                      web, columns, columns - 2));
    const int wing[2] = {(columns - web) / 2, columns - web - (columns - web) / 2};
    const int start[2] = {core_side_[0].back(), core_side_[1].back()};
    std::vector<int> under[2];
    for (int side = 0; side < 2; ++side) {
      const Curve& curve = section_.curves[half_[side].underside];
      const double from = section_.nodes[start[side]].parameter;
      under[side] = {start[side]};
      for (int i = 1; i < wing[side]; ++i)
        under[side].push_back(
            section_.add_curve_node(half_[side].underside, from + (curve.length - from) * i / wing[side]));
      under[side].push_back(section_.add_fixed_node(curve.end()));
    }
    for (int side = 0; side < 2; ++side) {
      auto& line = fishing_line(0, side) = ring_end_[side];
      line.insert(line.end(), under[side].begin() + 1, under[side].end());
    }
    web_line_ = straight_line(section_, under[0].back(), under[1].back(), even_fractions(web));
    std::vector<int> bottom = under[0];
    bottom.insert(bottom.end(), web_line_.begin() + 1, web_line_.end());
    bottom.insert(bottom.end(), under[1].rbegin() + 1, under[1].rend());
    fill_block(section_, core_top_, core_rows_, merges_, core_side_[0], core_side_[1], bottom, 1);
  }

  void add_web() {
    const double length = section_.curves[half_[0].web].length, row = 1.4 * plan_.section_size;
    std::vector<Row> rows;
    double used = 0;
    if (plan_.lower_transition) {
      rows = {{RowKind::plain, row}, {RowKind::longitudinal, 3 * transition_height * size()}};
      used = rows[0].height + rows[1].height;
    }
    const int plain = std::max(2, static_cast<int>(std::round((length - used) / row)));
    for (int i = 0; i < plain; ++i) rows.push_back({RowKind::plain, std::max(length - used, 0.2 * length) / plain});
    const auto fractions = row_fractions(rows);
    std::vector<int> sides[2];
    for (int side = 0; side < 2; ++side) {
      sides[side] = {side == 0 ? web_line_.front() : web_line_.back()};
      for (std::size_t i = 1; i + 1 < fractions.size(); ++i)
        sides[side].push_back(section_.add_curve_node(half_[side].web, length * fractions[i]));
      sides[side].push_back(section_.add_fixed_node(section_.curves[half_[side].web].end()));
      fishing_line(1, side) = sides[side];
    }
    const auto bottom = straight_line(section_, sides[0].back(), sides[1].back(), even_fractions(plan_.web_columns));
    fill_block(section_, web_line_, rows, {}, sides[0], sides[1], bottom, 1);
    web_line_ = bottom;
  }

  void add_foot() {
    const int level = plan_.lower_transition ? 2 : 1;
    const std::vector<Row> rows(2, Row{RowKind::plain, 1});
    const Point2 corner{section_.curves[half_[1].toe].end().y, 0};  // on the underside, below the rounding's middle
    const int base = section_.add_curve(line({-corner.y, corner.z}, corner));
    std::vector<int> side_line[2];
    for (int side = 0; side < 2; ++side) {
      const int above = side == 0 ? web_line_.front() : web_line_.back();
      const Point2 p = section_.position(above);
      const int below = section_.add_curve_node(base, corner.y + 1.1 * p.y);
      side_line[side] = straight_line(section_, above, below, even_fractions(2));
    }
    std::vector<int> base_nodes;
    const auto along_base = [&](int from, int to, int parts) {
      const double a = section_.position(from).y, b = section_.position(to).y;
      std::vector<int> nodes{from};
      for (int i = 1; i < parts; ++i)
        nodes.push_back(section_.add_curve_node(base, corner.y + a + (b - a) * i / parts));
      nodes.push_back(to);
      base_nodes.insert(base_nodes.end(), nodes.begin(), nodes.end());
      return nodes;
    };
    const auto bottom = along_base(side_line[0].back(), side_line[1].back(), plan_.web_columns);
    fill_block(section_, web_line_, rows, {}, side_line[0], side_line[1], bottom, level);
    for (int side = 0; side < 2; ++side) {
      const Curve& top_curve = section_.curves[half_[side].foot_top];
      const Curve& toe = section_.curves[half_[side].toe];
      const int columns = std::max(2, static_cast<int>(std::round(top_curve.length / (1.3 * plan_.section_size))));
      const int upper = section_.add_fixed_node(toe.begin()), lower = section_.add_fixed_node({toe.end().y, 0});
      std::vector<int> top = section_.add_curve_line(side_line[side].front(), half_[side].foot_top, columns, upper);
      fishing_line(2, side) = top;
      const std::vector<int> toe_line{upper, section_.add_curve_node(half_[side].toe, toe.length / 2), lower};
      if (side == 0) {
        std::reverse(top.begin(), top.end());
        fill_block(section_, top, rows, {}, toe_line, side_line[0], along_base(lower, side_line[0].back(), columns),
                   level);
      } else {
        fill_block(section_, top, rows, {}, side_line[1], toe_line, along_base(side_line[1].back(), lower, columns),
                   level);
      }
    }
    std::sort(base_nodes.begin(), base_nodes.end());
    base_nodes.erase(std::unique(base_nodes.begin(), base_nodes.end()), base_nodes.end());
    section_.node_sets["foot"] = base_nodes;
  }

  /// The zone's layers lie exactly below the surface, along its normals.
  void place_zone() { fix_zone(section_, ring_, columns_, head_, plan_.zone_layers, size()); }

  /// The running surface stays exact; elsewhere area and second moments count for more than the nodes' own places.
  void match_outline() {
    const Curve half =
        joined({outline_.head, outline_.underside, outline_.web, outline_.foot_top, outline_.toe, outline_.base});
    std::vector<char> kept(section_.nodes.size(), 0);
    for (int node : ring_.front().top_line) kept[node] = 1;
    for (const auto& line : outer_)
      for (int node : line) kept[node] = node != ring_end_[0].front() && node != ring_end_[1].front();
    for (int node : section_.node_sets["foot"]) kept[node] = 1;
    match_outline_area(section_, sample_closed(joined({reversed(half), mirrored(half)}), 5e-5), kept);
  }

  RailSectionPlan plan_;
  RailOutline outline_;
  Curve head_;  ///< from the head's lower left corner over the crown to the lower right one
  SectionMesh section_;
  Half half_[2];
  SurfaceColumns columns_;
  std::vector<std::vector<int>> merges_;
  std::array<double, 2> core_corner_arc_{};
  std::vector<Row> rows_, core_rows_;
  std::vector<BlockRow> ring_;
  std::vector<int> ring_end_[2], outer_[2], core_side_[2], core_top_, web_line_;
};

}  // namespace

SectionMesh rail_section(const RailSectionPlan& plan, bool smoothed) {
  return RailSectionBuilder(plan).build(smoothed);
}

}  // namespace railwave
