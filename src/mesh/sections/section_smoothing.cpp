#include <algorithm>
#include <cmath>

#include "mesh/sections/section.hpp"

namespace railwave {

namespace {

struct Matrix2 {
  double a, b, c, d;  // columns (a, c), (b, d)
};

struct Corner {
  int at, next, previous;
  Matrix2 from_ideal;  // inverse of the ideal corner's edges
};

class Smoother {
 public:
  explicit Smoother(SectionMesh& section) : section_(section), corners_of_(section.nodes.size()) {
    for (const SectionQuad& quad : section.quads) {
      for (int c = 0; c < 4; ++c) {
        const Point2 p = quad.ideal[c];
        const Point2 e = quad.ideal[(c + 1) % 4] - p, f = quad.ideal[(c + 3) % 4] - p;
        const double determinant = cross(e, f);
        corners_.push_back({quad.nodes[c],
                            quad.nodes[(c + 1) % 4],
                            quad.nodes[(c + 3) % 4],
                            {f.z / determinant, -f.y / determinant, -e.z / determinant, e.y / determinant}});
        const int number = static_cast<int>(corners_.size()) - 1;
        for (int node : {corners_.back().at, corners_.back().next, corners_.back().previous})
          corners_of_[node].push_back(number);
      }
    }
  }

  /// Smallest corner Jacobian over that of the ideal corner: 1 is ideal, below 0 inverted.
  double worst() const {
    double least = 1e300;
    for (const Corner& corner : corners_) least = std::min(least, determinant(map(corner)));
    return least;
  }

  void regularise(double size) { regularisation_ = size; }

  /// One pass over the nodes; returns the largest move relative to the local size.
  double sweep() {
    double largest = 0;
    for (std::size_t i = 0; i < section_.nodes.size(); ++i) {
      SectionNode& node = section_.nodes[i];
      if (node.fixed || corners_of_[i].empty()) continue;
      largest = std::max(largest, node.curve >= 0 ? slide(static_cast<int>(i)) : move(static_cast<int>(i)));
    }
    return largest;
  }

 private:
  Matrix2 map(const Corner& corner) const {
    const Point2 p = section_.nodes[corner.at].position;
    const Point2 e = section_.nodes[corner.next].position - p, f = section_.nodes[corner.previous].position - p;
    const Matrix2& w = corner.from_ideal;
    return {e.y * w.a + f.y * w.c, e.y * w.b + f.y * w.d, e.z * w.a + f.z * w.c, e.z * w.b + f.z * w.d};
  }

  static double determinant(const Matrix2& t) { return t.a * t.d - t.b * t.c; }

  double energy(int node) const {
    double total = 0;
    for (int number : corners_of_[node]) {
      const Matrix2 t = map(corners_[number]);
      double det = determinant(t);
      if (regularisation_ > 0)
        det = (det + std::sqrt(det * det + 4 * regularisation_ * regularisation_)) / 2;
      else if (det <= 0)
        return 1e300;
      total += (t.a * t.a + t.b * t.b + t.c * t.c + t.d * t.d) / (2 * det) - 1 + (det + 1 / det - 2) / 2;
    }
    return total;
  }

  double local_size(int node) const {
    double size = 1e300;
    for (int number : corners_of_[node]) {
      const Corner& c = corners_[number];
      size = std::min(size, norm(section_.nodes[c.next].position - section_.nodes[c.at].position));
      size = std::min(size, norm(section_.nodes[c.previous].position - section_.nodes[c.at].position));
    }
    return std::max(size, 1e-5);
  }

  /// Newton step by finite differences along y and z, halved until it improves.
  double move(int node) {
    Point2& p = section_.nodes[node].position;
    const Point2 start = p;
    const double size = local_size(node), h = 1e-4 * size, e0 = energy(node);
    const auto at = [&](double dy, double dz) {
      p = {start.y + dy, start.z + dz};
      return energy(node);
    };
    const double py = at(h, 0), my = at(-h, 0), pz = at(0, h), mz = at(0, -h), pp = at(h, h), mm = at(-h, -h);
    const double gy = (py - my) / (2 * h), gz = (pz - mz) / (2 * h);
    double hyy = (py - 2 * e0 + my) / (h * h), hzz = (pz - 2 * e0 + mz) / (h * h);
    const double hyz = (pp - py - pz + 2 * e0 - my - mz + mm) / (2 * h * h);
    double det = hyy * hzz - hyz * hyz;
    Point2 step{-(hzz * gy - hyz * gz) / det, -(hyy * gz - hyz * gy) / det};
    if (!(hyy > 0 && det > 0) || step.y * gy + step.z * gz >= 0) {
      const double slope = std::hypot(gy, gz);
      if (!(slope > 0)) return p = start, 0.0;
      step = {-0.3 * size * gy / slope, -0.3 * size * gz / slope};
    }
    const double length = norm(step), most = 0.5 * size;
    if (length > most) step = (most / length) * step;
    double factor = 1;
    for (int trial = 0; trial < 8; ++trial, factor /= 2)
      if (at(factor * step.y, factor * step.z) < e0) return factor * norm(step) / size;
    p = start;
    return 0;
  }

  double slide(int number) {
    SectionNode& node = section_.nodes[number];
    const Curve& curve = section_.curves[node.curve];
    const double start = node.parameter, size = local_size(number), h = 1e-4 * size, e0 = energy(number);
    const auto at = [&](double shift) {
      node.parameter = std::clamp(start + shift, 0.0, curve.length);
      node.position = curve.at(node.parameter);
      return energy(number);
    };
    const double plus = at(h), minus = at(-h);
    const double slope = (plus - minus) / (2 * h), bend = (plus - 2 * e0 + minus) / (h * h);
    double step = bend > 0 ? -slope / bend : (slope > 0 ? -0.3 : 0.3) * size;
    step = std::clamp(step, -0.3 * size, 0.3 * size);
    double factor = 1;
    for (int trial = 0; trial < 8; ++trial, factor /= 2)
      if (at(factor * step) < e0) return std::abs(factor * step) / size;
    at(0);
    return 0;
  }

  SectionMesh& section_;
  std::vector<Corner> corners_;
  std::vector<std::vector<int>> corners_of_;
  double regularisation_ = 0;
};

}  // namespace

void smooth_section(SectionMesh& section) {
  constexpr int most_sweeps = 400;
  Smoother smoother(section);
  for (int sweep = 0; sweep < most_sweeps; ++sweep) {
    const double worst = smoother.worst();
    smoother.regularise(worst > 0.02 ? 0 : std::max(0.02, 0.1 * std::abs(worst)));
    const double moved = smoother.sweep();
    if (moved < 1e-3 && worst > 0.02) break;
  }
}

}  // namespace railwave
