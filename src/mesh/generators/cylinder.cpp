#include <cmath>

#include "mesh/build_mesh.hpp"
#include "mesh/mesh_checks.hpp"
#include "mesh/mesh_memory.hpp"
#include "mesh/o_grid.hpp"

/// A solid round bar along z from z = 0, its axis through the origin: a square-like core of core_divisions x
/// core_divisions columns of elements, its sides bulged, within four blocks of ring_divisions that reach the skin (an
/// O-grid); exact at every node of the skin. Layers along z grow by a constant factor, so that the last is end_ratio
/// times the first. Node sets and surfaces: skin, z_min, z_max. Throws InputError if the parameters don't fit.
namespace railwave {
namespace {

void check(const scene::MeshSource& source) {
  const scene::CylinderMesh& c = source.cylinder;
  MeshChecks checks(source);
  checks.expect(c.radius > 0, "radius", c.radius, "above 0");
  checks.expect(c.length > 0, "length", c.length, "above 0");
  checks.expect(c.core_divisions >= 1, "core_divisions", c.core_divisions, "at least 1");
  checks.expect(c.ring_divisions >= 1, "ring_divisions", c.ring_divisions, "at least 1");
  checks.expect(c.length_divisions >= 1, "length_divisions", c.length_divisions, "at least 1");
  checks.expect(c.end_ratio >= 0.01 && c.end_ratio <= 100, "end_ratio", c.end_ratio, "0.01 to 100");
  checks.expect(c.core_share >= 0.2 && c.core_share <= 0.8, "core_share", c.core_share, "0.2 to 0.8");
  checks.report();
}

/// Nodes and quadrilaterals of the cross-section, counter-clockwise; the second and third corners of those at the skin
/// lie on it.
struct Disc {
  std::vector<RoundPoint> nodes;
  std::vector<std::array<int, 4>> cells;
  int first_skin_node = 0, first_skin_cell = 0;
};

Disc disc(const scene::CylinderMesh& c) {
  const int n = c.core_divisions, around = 4 * n;
  const auto number = [n](int i, int j) { return j * (n + 1) + i; };
  const auto place = [n](int i) { return 2.0 * i / n - 1; };
  Disc disc;
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i) disc.nodes.push_back(in_round_core(place(i), place(j), c.core_share * c.radius));
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i)
      disc.cells.push_back({number(i, j), number(i + 1, j), number(i + 1, j + 1), number(i, j + 1)});

  const auto side = core_outline(n, n);
  std::vector<int> inner;
  for (const auto& [i, j] : side) inner.push_back(number(i, j));
  for (int ring = 1; ring <= c.ring_divisions; ++ring) {
    const double share = static_cast<double>(ring) / c.ring_divisions;
    std::vector<int> outer;
    disc.first_skin_node = static_cast<int>(disc.nodes.size());
    disc.first_skin_cell = static_cast<int>(disc.cells.size());
    for (int k = 0; k < around; ++k) {
      const double u = place(side[k][0]), v = place(side[k][1]);
      const RoundPoint from = in_round_core(u, v, c.core_share * c.radius), to = on_disc(u, v, c.radius);
      outer.push_back(static_cast<int>(disc.nodes.size()));
      disc.nodes.push_back(ring == c.ring_divisions ? to
                                                    : RoundPoint{(1 - share) * from[0] + share * to[0],
                                                                 (1 - share) * from[1] + share * to[1]});
    }
    for (int k = 0; k < around; ++k)
      disc.cells.push_back({inner[k], outer[k], outer[(k + 1) % around], inner[(k + 1) % around]});
    inner = outer;
  }
  return disc;
}

std::vector<double> heights(const scene::CylinderMesh& c) {
  const int n = c.length_divisions;
  const double ratio = n > 1 ? std::pow(c.end_ratio, 1.0 / (n - 1)) : 1;
  std::vector<double> z{0};
  double cell = 1;
  for (int k = 0; k < n; ++k, cell *= ratio) z.push_back(z.back() + cell);
  const double scale = c.length / z.back();
  for (double& height : z) height *= scale;
  z.back() = c.length;
  return z;
}

Mesh build(const scene::MeshSource& source, MeshNotes* /*notes*/) {
  check(source);
  const double core = source.cylinder.core_divisions, rings = source.cylinder.ring_divisions,
               layers_wanted = source.cylinder.length_divisions;
  expect_mesh_memory((core + 4 * rings) * core * layers_wanted,
                     ((core + 1) * (core + 1) + 4 * core * rings) * (layers_wanted + 1));
  const Disc section = disc(source.cylinder);
  const auto z = heights(source.cylinder);
  const int nodes = static_cast<int>(section.nodes.size()), cells = static_cast<int>(section.cells.size());
  const int layers = static_cast<int>(z.size()) - 1;
  Mesh mesh;
  for (int k = 0; k <= layers; ++k)
    for (int n = 0; n < nodes; ++n) {
      const int number = static_cast<int>(mesh.nodes.size());
      if (k == 0) mesh.node_sets["z_min"].push_back(number);
      if (k == layers) mesh.node_sets["z_max"].push_back(number);
      if (n >= section.first_skin_node) mesh.node_sets["skin"].push_back(number);
      mesh.nodes.push_back({section.nodes[n][0], section.nodes[n][1], z[k]});
    }
  for (int k = 0; k < layers; ++k)
    for (int c = 0; c < cells; ++c) {
      const int element = static_cast<int>(mesh.elements.size());
      CornerNodes corners{};
      for (int i = 0; i < 4; ++i) {
        corners[i] = k * nodes + section.cells[c][i];
        corners[4 + i] = (k + 1) * nodes + section.cells[c][i];
      }
      mesh.elements.push_back(corners);
      if (k == 0) mesh.surfaces["z_min"].push_back({element, 0});
      if (k == layers - 1) mesh.surfaces["z_max"].push_back({element, 1});
      if (c >= section.first_skin_cell) mesh.surfaces["skin"].push_back({element, 3});
    }
  return mesh;
}

double elements(const scene::MeshSource& source) {
  const scene::CylinderMesh& c = source.cylinder;
  return (static_cast<double>(c.core_divisions) + 4.0 * c.ring_divisions) * c.core_divisions * c.length_divisions;
}

}  // namespace

MeshGenerator cylinder_generator() { return {build, elements}; }

}  // namespace railwave
