#include "model/checks/stiff_surfaces.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>

#include "mesh/nearest_on_triangle.hpp"
#include "mesh/vectors.hpp"
#include "model/boundaries/held_directions.hpp"
#include "model/checks/round_part.hpp"
#include "model/loads/load_model.hpp"

namespace railwave {
namespace {

/// The entry that holds or drives a node.
std::string holder_of(const AssembledScene& assembled, int node) {
  for (const scene::PrescribedMotion& motion : assembled.scene.prescribed_motions) {
    const auto& nodes = find_node_set(assembled.scene, assembled.assembly, motion, "target", motion.target);
    if (std::find(nodes.begin(), nodes.end(), node) != nodes.end())
      return fmt::format("[prescribed_motion.{}] (line {})", motion.name, motion.line);
  }
  for (const scene::Constraint& constraint : assembled.scene.constraints) {
    const auto& nodes = find_node_set(assembled.scene, assembled.assembly, constraint, "target", constraint.target);
    if (std::find(nodes.begin(), nodes.end(), node) != nodes.end())
      return fmt::format("[constraints.{}] (line {})", constraint.name, constraint.line);
  }
  return "constraints";
}

/// m, no less than any node of that motion goes in the run.
double travel_of(const AssembledScene& assembled, const scene::PrescribedMotion& motion) {
  const auto& nodes = find_node_set(assembled.scene, assembled.assembly, motion, "target", motion.target);
  const Vec3 centre = centre_of_rotation(assembled, motion, nodes);
  double fastest = 0;
  for (int n : nodes)
    fastest = std::max(fastest, length(prescribed_at(motion, centre, assembled.assembly.nodes[n]).velocity));
  const scene::Curve *curve = curve_of(assembled.scene, motion.curve),
                     *displacement = curve_of(assembled.scene, motion.displacement_curve);
  constexpr int instants = 1000;
  double way = 0, most = 0;
  for (int i = 0; i < instants; ++i) {
    const double time = (i + 0.5) * assembled.scene.time.end / instants;
    way += std::fabs(curve_value(curve, time)) * fastest * assembled.scene.time.end / instants;
    most = std::max(most, std::fabs(curve_value(displacement, time)));
  }
  return way + most * length(motion.displacement);
}

using HeldNodes = std::map<int, HeldDirections>;

Vec3 area_normal(const Assembly& assembly, const std::vector<int>& nodes, const std::array<int, 4>& face) {
  return railwave::doubled_area(assembly.nodes, {nodes[face[0]], nodes[face[1]], nodes[face[2]], nodes[face[3]]});
}

/// Slave nodes of a pair that no force along their normals moves.
std::vector<int> stiff_slaves(const Assembly& assembly, const ContactPair& pair, const HeldNodes& held) {
  std::vector<Vec3> normal(pair.slave_nodes.size(), Vec3{0, 0, 0});
  for (const auto& face : pair.slave_facets)
    for (int corner : face)
      for (int i = 0; i < 3; ++i) normal[corner][i] += area_normal(assembly, pair.slave_nodes, face)[i];
  std::vector<int> stiff;
  for (std::size_t s = 0; s < normal.size(); ++s)
    if (length(normal[s]) > 0 && force_is_held(held, pair.slave_nodes[s], normal[s]))
      stiff.push_back(pair.slave_nodes[s]);
  return stiff;
}

/// Faces of a pair's master of which no corner moves under a force along the normal, as nodes of the model.
std::vector<std::array<int, 4>> stiff_faces(const Assembly& assembly, const ContactPair& pair, const HeldNodes& held) {
  std::vector<std::array<int, 4>> stiff;
  for (std::array<int, 4> face : pair.master_segments) {
    const Vec3 normal = area_normal(assembly, pair.master_nodes, face);
    for (int& n : face) n = pair.master_nodes[n];
    if (std::all_of(face.begin(), face.end(), [&](int n) { return force_is_held(held, n, normal); }))
      stiff.push_back(face);
  }
  return stiff;
}

/// Whether a node may come to a face that is so far from it, or lies on it.
bool may_meet(const Assembly& assembly, int node, const std::array<int, 4>& face, double travel) {
  const auto& x = assembly.nodes;
  double away = std::numeric_limits<double>::infinity();
  for (int second : {1, 2})
    away = std::min(
        away,
        length(difference(nearest_on_triangle(x[face[0]], x[face[second]], x[face[second + 1]], x[node]), x[node])));
  return away <= travel + 0.01 * length(difference(x[face[2]], x[face[0]]));
}

}  // namespace

std::optional<std::string> stiff_meeting(const AssembledScene& assembled, const ContactPair& pair) {
  const HeldNodes held = held_directions(assembled.scene, assembled.assembly);
  if (held.empty()) return {};
  const auto slaves = stiff_slaves(assembled.assembly, pair, held);
  const auto faces = stiff_faces(assembled.assembly, pair, held);
  if (slaves.empty() || faces.empty()) return {};
  double travel = 0;
  for (const scene::PrescribedMotion& motion : assembled.scene.prescribed_motions)
    travel += travel_of(assembled, motion);
  const bool wholly = slaves.size() == pair.slave_nodes.size() && faces.size() == pair.master_segments.size();
  for (int n : slaves)
    for (const auto& face : faces)
      if (wholly || may_meet(assembled.assembly, n, face, travel))
        return fmt::format("{} holds or drives '{}' along its normal at {} and {} '{}' at {}", holder_of(assembled, n),
                           pair.contact->slave, place_text(assembled.assembly.nodes[n]), holder_of(assembled, face[0]),
                           pair.contact->master.text(), place_text(assembled.assembly.nodes[face[0]]));
  return {};
}

}  // namespace railwave
