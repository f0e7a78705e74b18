#include "mesh/sections/section.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>
#include <utility>

namespace railwave {

int SectionMesh::add_node(Point2 position) {
  SectionNode node;
  node.position = position;
  nodes.push_back(node);
  return static_cast<int>(nodes.size()) - 1;
}

int SectionMesh::add_fixed_node(Point2 position) {
  const int number = add_node(position);
  nodes[number].fixed = true;
  return number;
}

int SectionMesh::add_curve(Curve curve) {
  curves.push_back(std::move(curve));
  return static_cast<int>(curves.size()) - 1;
}

int SectionMesh::add_curve_node(int curve, double parameter) {
  const int number = add_node(curves[curve].at(parameter));
  nodes[number].curve = curve;
  nodes[number].parameter = parameter;
  return number;
}

std::vector<int> SectionMesh::add_curve_line(int first, int curve, int parts, int last) {
  std::vector<int> result{first};
  for (int i = 1; i < parts; ++i) result.push_back(add_curve_node(curve, curves[curve].length * i / parts));
  result.push_back(last);
  return result;
}

std::vector<SectionEdge> SectionMesh::edges_along(const std::vector<int>& line) const {
  std::set<std::pair<int, int>> wanted;
  for (std::size_t i = 0; i + 1 < line.size(); ++i) wanted.insert(std::minmax(line[i], line[i + 1]));
  std::vector<SectionEdge> found;
  for (std::size_t q = 0; q < quads.size(); ++q)
    for (int i = 0; i < 4; ++i)
      if (wanted.count(std::minmax(quads[q].nodes[i], quads[q].nodes[(i + 1) % 4])) != 0)
        found.push_back({static_cast<int>(q), i});
  return found;
}

namespace {

/// A line of nodes with a coordinate 0 to 1 along it.
struct Line {
  std::vector<int> nodes;
  std::vector<double> at;
};

Point2 interpolate(const SectionMesh& section, const Line& line, double at) {
  std::size_t i = 0;
  while (i + 2 < line.at.size() && at > line.at[i + 1]) ++i;
  const double f = (at - line.at[i]) / (line.at[i + 1] - line.at[i]);
  return (1 - f) * section.position(line.nodes[i]) + f * section.position(line.nodes[i + 1]);
}

std::vector<double> chord_fractions(const SectionMesh& section, const std::vector<int>& nodes) {
  std::vector<double> at{0};
  for (std::size_t i = 1; i < nodes.size(); ++i)
    at.push_back(at.back() + norm(section.position(nodes[i]) - section.position(nodes[i - 1])));
  for (double& value : at) value /= at.back();
  at.back() = 1;
  return at;
}

/// Keeps the line's entries at the ends of groups.
template <class T>
std::vector<T> keep_groups(const std::vector<T>& line, const std::vector<int>& groups) {
  std::vector<T> kept{line[0]};
  std::size_t i = 0;
  for (int group : groups) kept.push_back(line[i += group]);
  return kept;
}

void add_quad(SectionMesh& section, std::array<int, 4> nodes, int level, bool transition,
              std::array<Point2, 4> ideal = {}) {
  SectionQuad quad;
  quad.nodes = nodes;
  quad.level = level;
  quad.transition = transition;
  quad.ideal = ideal;
  section.quads.push_back(quad);
}

/// The 3:1 template between two lines of nodes: upper nodes u..u+3 over lower nodes l, l+1.
void add_merged_group(SectionMesh& section, const std::vector<int>& upper, std::size_t u, const std::vector<int>& lower,
                      std::size_t l, int level) {
  const int b0 = lower[l], b3 = lower[l + 1];
  const int t[4] = {upper[u], upper[u + 1], upper[u + 2], upper[u + 3]};
  const auto inner = [&](int side, int top) {  // side 0 left, 1 right
    const double along = side == 0 ? (1 + transition_inset) / 3 : (2 - transition_inset) / 3;
    const Point2 base = (1 - along) * section.position(b0) + along * section.position(b3);
    const int node = section.add_node((1 - transition_depth) * base + transition_depth * section.position(top));
    section.nodes[node].level = level;
    return node;
  };
  const int i1 = inner(0, t[1]), i2 = inner(1, t[2]);
  const double h = transition_height, d = transition_depth * h;
  const Point2 B0{0, 0}, B3{3, 0}, T[4] = {{0, h}, {1, h}, {2, h}, {3, h}};
  const Point2 I1{1 + transition_inset, d}, I2{2 - transition_inset, d};
  add_quad(section, {b0, b3, i2, i1}, level, false, {B0, B3, I2, I1});
  add_quad(section, {b0, i1, t[1], t[0]}, level, false, {B0, I1, T[1], T[0]});
  add_quad(section, {i1, i2, t[2], t[1]}, level, false, {I1, I2, T[2], T[1]});
  add_quad(section, {b3, t[3], t[2], i2}, level, false, {B3, T[3], T[2], I2});
}

}  // namespace

std::vector<BlockRow> fill_block(SectionMesh& section, const std::vector<int>& top, const std::vector<Row>& rows,
                                 const std::vector<std::vector<int>>& merges, const std::vector<int>& left,
                                 const std::vector<int>& right, const std::vector<int>& bottom, int level) {
  Line upper{top, chord_fractions(section, top)};
  Line base{bottom, upper.at};
  for (const auto& groups : merges) base.at = keep_groups(base.at, groups);
  const Line ceiling = upper;
  const Point2 corner[4] = {section.position(top.front()), section.position(top.back()),
                            section.position(bottom.front()), section.position(bottom.back())};
  double total = 0, depth = 0;
  for (const Row& row : rows) total += row.height;

  std::vector<BlockRow> result;
  std::size_t merge = 0;
  for (std::size_t j = 0; j < rows.size(); ++j) {
    depth += rows[j].height;
    const double v = depth / total;
    const auto groups =
        rows[j].kind == RowKind::lateral ? merges[merge++] : std::vector<int>(upper.nodes.size() - 1, 1);
    Line lower{{}, keep_groups(upper.at, groups)};
    if (j + 1 == rows.size()) {
      lower.nodes = bottom;
    } else {
      lower.nodes.push_back(left[j + 1]);
      for (std::size_t i = 1; i + 1 < lower.at.size(); ++i) {
        const double u = lower.at[i];
        const Point2 across = (1 - v) * interpolate(section, ceiling, u) + v * interpolate(section, base, u);
        const Point2 along = (1 - u) * section.position(left[j + 1]) + u * section.position(right[j + 1]);
        const Point2 both = (1 - v) * ((1 - u) * corner[0] + u * corner[1]) + v * ((1 - u) * corner[2] + u * corner[3]);
        lower.nodes.push_back(section.add_node(across + along - both));
      }
      lower.nodes.push_back(right[j + 1]);
    }
    const bool transition = rows[j].kind == RowKind::longitudinal;
    BlockRow record;
    record.top_line = upper.nodes;
    std::size_t u = 0;
    for (std::size_t i = 0; i < groups.size(); ++i) {
      record.first_quads.push_back(static_cast<int>(section.quads.size()));
      if (groups[i] == 1)
        add_quad(section, {lower.nodes[i], lower.nodes[i + 1], upper.nodes[u + 1], upper.nodes[u]}, level, transition);
      else
        add_merged_group(section, upper.nodes, u, lower.nodes, i, level);
      u += groups[i];
    }
    for (int node : upper.nodes) section.nodes[node].level = level;
    if (transition) ++level;
    for (int node : lower.nodes) section.nodes[node].level = level;
    result.push_back(record);
    upper = lower;
  }
  return result;
}

void set_ideal_shapes(SectionMesh& section, double smallest) {
  for (SectionQuad& quad : section.quads) {
    Point2 p[4];
    for (int i = 0; i < 4; ++i) p[i] = section.position(quad.nodes[i]);
    const auto edge = [&](int i) { return norm(p[(i + 1) % 4] - p[i]); };
    if (norm(quad.ideal[2] - quad.ideal[0]) == 0) {
      const double least_height = quad.transition && quad.level == 0 ? transition_height * smallest : smallest;
      const double width = std::max(smallest, (edge(0) + edge(2)) / 2);
      const double height = std::max(least_height, (edge(1) + edge(3)) / 2);
      quad.ideal = {Point2{0, 0}, Point2{width, 0}, Point2{width, height}, Point2{0, height}};
    } else {  // a template's quad, stored for cells of size 1
      double present = 0, ideal = 0;
      for (int i = 0; i < 4; ++i) {
        present += edge(i);
        ideal += norm(quad.ideal[(i + 1) % 4] - quad.ideal[i]);
      }
      const double scale = std::max(smallest, present / ideal);
      for (Point2& corner : quad.ideal) corner = scale * corner;
    }
  }
}

}  // namespace railwave
