#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "case/error.hpp"
#include "mesh/build_mesh.hpp"
#include "mesh/generators/wheel.hpp"
#include "mesh/mesh.hpp"
#include "mesh/mesh_checks.hpp"
#include "mesh/mesh_memory.hpp"
#include "mesh/o_grid.hpp"
#include "mesh/sections/profiles.hpp"

/// Two wheels on a solid axle along y, in one mesh: the axle shares the nodes of the bores. The origin is the axle's
/// middle, the tape circles lie in y = +-(flange_back_distance / 2 + 0.070 m), the flanges inside. The half at y > 0 is
/// a wheel as mesh/generators/wheel.hpp makes it; the other is its mirror image. Sets: those of a wheel; element sets
/// wheel and axle; surfaces skin (the axle's beside the hubs), journal, axle_end; node set middle, in y = 0. A half has
/// a surface middle there. With both halves each set covers both, and left_NAME (y > 0), right_NAME one. The wheel's
/// coarse_size is taken as much smaller as makes an even number of cells round the bore, or its zone a few cells
/// longer. Throws InputError if the parameters don't fit.
namespace railwave {
namespace {

void check(const scene::MeshSource& source) {
  const scene::WheelsetMesh& w = source.wheelset;
  MeshChecks checks(source);
  checks.expect(w.axle_size >= 0.005 && w.axle_size <= 0.5, "axle_size", w.axle_size, "0.005 to 0.5 m");
  const double first = tape_circle(w) + w.web_centre - 0.5 * w.hub_width, last = first + w.hub_width;
  checks.expect(first > 0.02, "flange_back_distance", w.flange_back_distance,
                fmt::format("more than {:g} m: the hub ends before the axle's middle",
                            w.flange_back_distance + 2 * (0.02 - first)));
  const auto text = [](const std::array<double, 2>& p) { return fmt::format("[{:g}, {:g}]", p[0], p[1]); };
  for (std::size_t i = 0; i < w.axle.size(); ++i) {
    const auto& p = w.axle[i];
    if (i == 0)
      checks.expect(p[0] == 0, "axle", text(p), "a first pair at y = 0");
    else
      checks.expect(p[0] >= w.axle[i - 1][0] + 0.001, "axle", text(p),
                    fmt::format("a y above that of the pair before, {:g} m", w.axle[i - 1][0]));
    checks.expect(p[1] >= 0.02 && p[1] <= 2 * w.bore_radius, "axle", text(p),
                  fmt::format("a radius from 0.02 m to 2 bore_radius = {:g} m", 2 * w.bore_radius));
    checks.expect(
        p[0] < first - 0.001 || p[0] > last + 0.001, "axle", text(p),
        fmt::format("a y outside the hub, which goes from {:g} to {:g} m and has bore_radius inside", first, last));
  }
  checks.expect(w.axle.size() >= 2 && w.axle.back()[0] > last, "axle",
                w.axle.empty() ? std::string("[]") : text(w.axle.back()),
                fmt::format("a last pair beyond the hub's end, y = {:g} m", last));
  checks.report();
}

/// A section of the axle; within the hub it is ringed by nodes of the bore.
struct Layer {
  double y, radius;
  int bore = -1;  ///< position in the bore's line
};

/// A section beside the hub: bore -1.
void add_stretch(std::vector<Layer>& layers, const Layer& to, double largest) {
  const Layer from = layers.back();
  const int cells = std::max(1, cell_count(std::ceil((to.y - from.y) / largest - 1e-9)));
  for (int i = 1; i < cells; ++i) {
    const double share = static_cast<double>(i) / cells;
    layers.push_back({from.y + share * (to.y - from.y), from.radius + share * (to.radius - from.radius)});
  }
  layers.push_back(to);
}

std::vector<Layer> layers_of(const scene::WheelsetMesh& w, const std::vector<double>& bore) {
  std::vector<Layer> layers{{w.axle[0][0], w.axle[0][1]}};
  std::size_t i = 1;
  for (; i < w.axle.size() && w.axle[i][0] < bore.front(); ++i)
    add_stretch(layers, {w.axle[i][0], w.axle[i][1]}, w.axle_size);
  add_stretch(layers, {bore.front(), w.bore_radius, 0}, w.axle_size);
  for (std::size_t k = 1; k < bore.size(); ++k) layers.push_back({bore[k], w.bore_radius, static_cast<int>(k)});
  for (; i < w.axle.size(); ++i) add_stretch(layers, {w.axle[i][0], w.axle[i][1]}, w.axle_size);
  return layers;
}

/// Nodes of the bore, by line and station.
std::vector<std::vector<int>> bore_nodes(const WheelBody& body) {
  std::vector<std::vector<int>> nodes(body.bore_line.size(), std::vector<int>(body.bore_stations.size(), -1));
  const Extrusion& made = body.extrusion;
  for (std::size_t n = 0; n < made.section_node.size(); ++n) {
    const auto line = std::find(body.bore_line.begin(), body.bore_line.end(), made.section_node[n]);
    if (line == body.bore_line.end()) continue;
    const auto station = std::lower_bound(body.bore_stations.begin(), body.bore_stations.end(), made.station[n]);
    nodes[line - body.bore_line.begin()][station - body.bore_stations.begin()] = static_cast<int>(n);
  }
  return nodes;
}

void add_axle(const scene::WheelsetMesh& w, const WheelBody& body, Mesh& mesh) {
  // Angles of the wheel rise from the lowest point towards +x; in the plane of x and z that is counter-clockwise from
  // -90 degrees.
  std::vector<double> angles = body.bore_angles;
  for (double& angle : angles) angle -= M_PI / 2;
  const auto bore = bore_nodes(body);
  std::vector<double> radii;
  for (int n : bore[0]) radii.push_back(std::hypot(mesh.nodes[n][0], mesh.nodes[n][2]) / w.bore_radius);
  const RingDisc disc = ring_disc(angles, radii);
  std::vector<double> bore_y;
  for (const auto& line : bore) bore_y.push_back(mesh.nodes[line[0]][1]);
  const auto layers = layers_of(w, bore_y);

  std::vector<std::vector<int>> number(layers.size(), std::vector<int>(disc.nodes.size()));
  for (std::size_t l = 0; l < layers.size(); ++l)
    for (int n = 0; n < static_cast<int>(disc.nodes.size()); ++n) {
      if (layers[l].bore >= 0 && n < disc.rim) {
        number[l][n] = bore[layers[l].bore][n];
        continue;
      }
      number[l][n] = static_cast<int>(mesh.nodes.size());
      mesh.nodes.push_back({layers[l].radius * disc.nodes[n][0], layers[l].y, layers[l].radius * disc.nodes[n][1]});
    }
  mesh.node_sets["middle"] = number[0];
  const double journal = w.axle[w.axle.size() - 2][0];
  for (std::size_t l = 0; l + 1 < layers.size(); ++l)
    for (int c = 0; c < static_cast<int>(disc.cells.size()); ++c) {
      // x, z and -y are right-handed: the section's cells rise towards the axle's middle.
      const int element = static_cast<int>(mesh.elements.size());
      CornerNodes corners{};
      for (int i = 0; i < 4; ++i) {
        corners[i] = number[l + 1][disc.cells[c][i]];
        corners[4 + i] = number[l][disc.cells[c][i]];
      }
      mesh.elements.push_back(corners);
      mesh.element_sets["axle"].push_back(element);
      if (l == 0) mesh.surfaces["middle"].push_back({element, 1});
      if (l + 2 == layers.size()) mesh.surfaces["axle_end"].push_back({element, 0});
      const bool in_hub = layers[l].bore >= 0 && layers[l + 1].bore >= 0;
      if (c >= disc.rim || in_hub) continue;
      mesh.surfaces["skin"].push_back({element, 2});
      if (layers[l].y >= journal - 1e-9) mesh.surfaces["journal"].push_back({element, 2});
    }
}

/// The other half is added, with the nodes in y = 0 in common.
Mesh both_halves(const Mesh& left) {
  Mesh right = left;
  mirror(right);
  const auto& middle = left.node_sets.at("middle");
  Mesh whole;
  whole.nodes = left.nodes;
  std::vector<int> number(right.nodes.size(), -1);
  for (int n : middle) number[n] = n;
  for (std::size_t n = 0; n < right.nodes.size(); ++n) {
    if (number[n] >= 0) continue;
    number[n] = static_cast<int>(whole.nodes.size());
    whole.nodes.push_back(right.nodes[n]);
  }
  whole.elements = left.elements;
  const int first = static_cast<int>(left.elements.size());
  for (auto corners : right.elements) {
    for (int& n : corners) n = number[n];
    whole.elements.push_back(corners);
  }
  const auto both = [](auto& sets, const std::string& name, const auto& left_set, auto right_set) {
    auto& all = sets[name] = left_set;
    all.insert(all.end(), right_set.begin(), right_set.end());
    sets["left_" + name] = left_set;
    sets["right_" + name] = std::move(right_set);
  };
  for (const auto& [name, nodes] : left.node_sets) {
    if (name == "middle") continue;
    auto others = nodes;
    for (int& n : others) n = number[n];
    both(whole.node_sets, name, nodes, others);
  }
  whole.node_sets["middle"] = middle;
  for (const auto& [name, elements] : left.element_sets) {
    auto others = elements;
    for (int& e : others) e += first;
    both(whole.element_sets, name, elements, others);
  }
  for (const auto& [name, faces] : left.surfaces) {
    if (name == "middle") continue;
    auto others = right.surfaces.at(name);
    for (Face& face : others) face.element += first;
    both(whole.surfaces, name, faces, others);
  }
  return whole;
}

/// With an even number of cells round the bore: coarse_size somewhat smaller, or else the zone a few cells longer.
scene::WheelMesh with_even_bore(const scene::MeshSource& source) {
  scene::WheelMesh wheel = source.wheelset;
  for (int longer = 0; longer < 9; ++longer)
    for (double share = 1; share > 0.7; share -= 0.01) {
      wheel.coarse_size = std::max(wheel.zone_size, share * source.wheelset.coarse_size);
      wheel.zone_length = source.wheelset.zone_length + longer * wheel.zone_size;
      const std::size_t round = wheel_stations(wheel).levels.back().size();
      if (round % 2 == 0 && round >= 8) return wheel;
    }
  throw InputError(
      fmt::format("{}coarse_size = {:g}; allowed: one that makes at least 8 cells, and an even number, round the bore; "
                  "try another, or "
                  "another zone_length",
                  place_of(source), source.wheelset.coarse_size));
}

double elements(const scene::MeshSource& source) {
  const scene::WheelsetMesh& w = source.wheelset;
  const double wheel = wheel_elements(source, w);
  check(source);
  // As many cells in a disc of the axle as ring_disc() lays on so many round the bore: rings to a core of a quarter of
  // them squared.
  const double round = static_cast<double>(wheel_stations(w).levels.back().size());
  const double disc = round * std::max(2.0, 0.12 * round) + round * round / 16;
  const double layers = w.axle.back()[0] / w.axle_size + static_cast<double>(w.axle.size()) + w.web_columns + 2;
  return (w.half ? 1 : 2) * (wheel + disc * layers);
}

Mesh build(const scene::MeshSource& source, MeshNotes* /*notes*/) {
  const scene::WheelsetMesh& w = source.wheelset;
  check_wheel_mesh(source, w);
  check(source);
  const WheelBody body = wheel_body(source, with_even_bore(source));
  Mesh mesh = body.extrusion.mesh;
  for (Vec3& x : mesh.nodes) x[1] += tape_circle(w);
  auto& wheel = mesh.element_sets["wheel"];
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) wheel.push_back(static_cast<int>(e));
  add_axle(w, body, mesh);
  return w.half ? mesh : both_halves(mesh);
}

double fine_size(const scene::MeshSource& source) { return wheel_fine_size(source.wheelset); }

}  // namespace

double tape_circle(const scene::WheelsetMesh& w) { return 0.5 * w.flange_back_distance - s1002_first; }

MeshGenerator wheelset_generator() { return {build, elements, fine_size}; }

}  // namespace railwave
