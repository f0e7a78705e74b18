#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <set>
#include <tuple>

#include "deck/conversion.hpp"
#include "mesh/nearest_on_triangle.hpp"
#include "mesh/vectors.hpp"

namespace railwave::deck {
namespace {

constexpr double near = 0.05;  // of the shorter diagonal

using Cell = std::tuple<std::int64_t, std::int64_t, std::int64_t>;

/// The master's faces by the cells of a grid that their boxes touch.
class FaceGrid {
 public:
  FaceGrid(const Mesh& mesh, const std::vector<Face>& faces) : mesh_(mesh), faces_(faces) {
    for (const Face& face : faces) size_ = std::fmax(size_, reach(face));
    for (std::size_t f = 0; f < faces.size(); ++f) {
      Vec3 low = corner(faces[f], 0), high = low;
      for (int k = 1; k < 4; ++k)
        for (int i = 0; i < 3; ++i) {
          low[i] = std::fmin(low[i], corner(faces[f], k)[i]);
          high[i] = std::fmax(high[i], corner(faces[f], k)[i]);
        }
      const double slack = near * reach(faces[f]);
      const auto [x0, y0, z0] = cell_of({low[0] - slack, low[1] - slack, low[2] - slack});
      const auto [x1, y1, z1] = cell_of({high[0] + slack, high[1] + slack, high[2] + slack});
      for (auto x = x0; x <= x1; ++x)
        for (auto y = y0; y <= y1; ++y)
          for (auto z = z0; z <= z1; ++z) cells_[{x, y, z}].push_back(static_cast<int>(f));
    }
  }

  bool is_near(const Vec3& place) const {
    const auto found = cells_.find(cell_of(place));
    return found != cells_.end() && std::any_of(found->second.begin(), found->second.end(), [&](int f) {
             const Face& face = faces_[f];
             const double shorter = std::fmin(length(difference(corner(face, 2), corner(face, 0))),
                                              length(difference(corner(face, 3), corner(face, 1))));
             return distance(face, place) <= near * shorter;
           });
  }

 private:
  Vec3 corner(const Face& face, int k) const { return mesh_.nodes[mesh_.face_nodes(face)[k]]; }
  double reach(const Face& face) const {
    return std::fmax(length(difference(corner(face, 2), corner(face, 0))),
                     length(difference(corner(face, 3), corner(face, 1))));
  }
  Cell cell_of(const Vec3& place) const {
    // Cells are as large as the largest face, so that a face touches a few.
    const auto index = [&](double x) {
      return static_cast<std::int64_t>(std::floor(std::clamp(x / size_, -1e15, 1e15)));
    };
    return {index(place[0]), index(place[1]), index(place[2])};
  }
  double distance(const Face& face, const Vec3& place) const {
    double least = 1e300;
    for (const int k : {1, 2}) {
      const Vec3 nearest = nearest_on_triangle(corner(face, 0), corner(face, k), corner(face, k + 1), place);
      least = std::fmin(least, length(difference(nearest, place)));
    }
    return least;
  }

  const Mesh& mesh_;
  const std::vector<Face>& faces_;
  double size_ = 1e-300;
  std::map<Cell, std::vector<int>> cells_;
};

}  // namespace

std::vector<Face> faces_on(const Mesh& mesh, const std::vector<Face>& slave, const std::vector<Face>& master,
                           std::size_t& left_out) {
  const FaceGrid grid(mesh, master);
  std::map<int, bool> is_near;
  for (const Face& face : slave)
    for (const int node : mesh.face_nodes(face))
      if (is_near.count(node) == 0) is_near[node] = grid.is_near(mesh.nodes[node]);
  std::vector<Face> faces;
  std::set<int> taken;
  for (const Face& face : slave) {
    const auto nodes = mesh.face_nodes(face);
    if (!std::all_of(nodes.begin(), nodes.end(), [&](int n) { return is_near[n]; })) continue;
    faces.push_back(face);
    taken.insert(nodes.begin(), nodes.end());
  }
  left_out = 0;
  for (const auto& [node, close] : is_near)
    if (close && taken.count(node) == 0) ++left_out;
  return faces;
}

}  // namespace railwave::deck
