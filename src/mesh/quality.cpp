#include "mesh/quality.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "mesh/hexahedron.hpp"
#include "mesh/vectors.hpp"

namespace railwave {

namespace {

double triple(const Vec3& a, const Vec3& b, const Vec3& c) { return dot(a, cross(b, c)); }

constexpr int edges[12][2] = {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {4, 5}, {5, 6},
                              {6, 7}, {7, 4}, {0, 4}, {1, 5}, {2, 6}, {3, 7}};

}  // namespace

MeshQuality mesh_quality(const Mesh& mesh, double dilatational_wave_speed) {
  MeshQuality quality;
  quality.elements = static_cast<int>(mesh.elements.size());
  quality.nodes = static_cast<int>(mesh.nodes.size());
  quality.aspect_ratio.value = 0;
  quality.jacobian_ratio.value = quality.step.value = std::numeric_limits<double>::infinity();
  const auto note = [&](QualityExtreme& extreme, bool worse, double value, int element) {
    if (worse) extreme = {value, element, hexahedron_centre(corners_of(mesh.nodes, mesh.elements[element]))};
  };
  for (int e = 0; e < quality.elements; ++e) {
    const HexahedronCorners x = corners_of(mesh.nodes, mesh.elements[e]);
    double shortest = std::numeric_limits<double>::infinity(), longest = 0;
    for (const auto& edge : edges) {
      const double size = length(difference(x[edge[1]], x[edge[0]]));
      shortest = std::min(shortest, size);
      longest = std::max(longest, size);
    }
    double least = std::numeric_limits<double>::infinity(), greatest = -least;
    for (int c = 0; c < 8; ++c) {
      const auto& next = hexahedron_corner_neighbours[c];
      const double jacobian =
          triple(difference(x[next[0]], x[c]), difference(x[next[1]], x[c]), difference(x[next[2]], x[c]));
      least = std::min(least, jacobian);
      greatest = std::max(greatest, jacobian);
    }
    const double volume = hexahedron_volume(x);
    const double aspect = shortest > 0 ? longest / shortest : std::numeric_limits<double>::infinity();
    const double ratio = greatest > 0 ? least / greatest : -1;
    const double step = hexahedron_length(x) / dilatational_wave_speed;
    if (!(least > 0 && volume > 0)) ++quality.inverted;
    quality.volume += volume;
    note(quality.aspect_ratio, aspect > quality.aspect_ratio.value, aspect, e);
    note(quality.jacobian_ratio, ratio < quality.jacobian_ratio.value, ratio, e);
    note(quality.step, step < quality.step.value, step, e);
  }
  return quality;
}

std::string describe(const MeshQuality& quality) {
  const auto where = [](const QualityExtreme& extreme) {
    return fmt::format("element {} at ({:.4f}, {:.4f}, {:.4f}) m", extreme.element, extreme.centroid[0],
                       extreme.centroid[1], extreme.centroid[2]);
  };
  std::string text =
      fmt::format("{} elements, {} nodes, volume {:.6g} m3", quality.elements, quality.nodes, quality.volume);
  if (quality.elements == 0) return text;
  text += fmt::format("\nsmallest stable step {:.4g} s: {}", quality.step.value, where(quality.step));
  text += fmt::format("\nworst aspect ratio {:.3g}: {}", quality.aspect_ratio.value, where(quality.aspect_ratio));
  text += fmt::format("\nworst Jacobian ratio {:.3g}: {}", quality.jacobian_ratio.value, where(quality.jacobian_ratio));
  if (quality.inverted > 0) text += fmt::format("\n{} inverted elements: the mesh can't be used", quality.inverted);
  return text;
}

}  // namespace railwave
