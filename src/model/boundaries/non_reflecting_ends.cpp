#include "model/boundaries/absorbing_boundaries.hpp"

#include <fmt/format.h>

#include <map>
#include <set>

#include "case/error.hpp"
#include "mesh/hexahedron.hpp"
#include "mesh/vectors.hpp"
#include "model/boundaries/held_directions.hpp"
#include "model/build_steps.hpp"
#include "model/contact/contact_pair.hpp"
#include "model/host_copy.hpp"

namespace railwave {
namespace {

using Matrix = std::array<std::array<double, 3>, 3>;

const scene::Material& material_under(const AssembledScene& assembled, const Face& face) {
  return assembled.scene
      .materials[assembled.assembly.parts[part_of_element(assembled.assembly, face.element)].material];
}

/// Adds a face's dashpots, rho A (C_s I + (C_d - C_s) n n^T), a quarter on each corner.
void add_face(const AssembledScene& assembled, const Face& face, std::map<int, Matrix>& dashpots) {
  const auto corner = assembled.assembly.face_nodes(face);
  const auto& x = assembled.assembly.nodes;
  const double area = facet_area(x[corner[0]], x[corner[1]], x[corner[2]], x[corner[3]]);
  const Vec3 n = scaled(0.5 / area, doubled_area(x, corner));
  const scene::Material& material = material_under(assembled, face);
  const double across = material.shear_speed(), more = material.dilatational_speed() - across;
  for (int node : corner)
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        dashpots[node][i][j] += 0.25 * material.density * area * ((i == j ? across : 0.0) + more * n[i] * n[j]);
}

/// P C P with P = I - sum d d^T: a dashpot does nothing in a direction that is held.
void take_out(Matrix& c, const std::vector<Vec3>& held) {
  for (const Vec3& d : held)
    for (int side = 0; side < 2; ++side)
      for (int i = 0; i < 3; ++i) {
        const auto entry = [&](int j) -> double& { return side == 0 ? c[j][i] : c[i][j]; };
        const double along = d[0] * entry(0) + d[1] * entry(1) + d[2] * entry(2);
        for (int j = 0; j < 3; ++j) entry(j) -= along * d[j];
      }
}

[[noreturn]] void refuse(const AssembledScene& assembled, const scene::NonReflecting& end, int node,
                         const std::string& why) {
  throw InputError(fmt::format("{}:{}: [non_reflecting.{}]: the node at {} {}", assembled.scene.path, end.line,
                               end.name, place_text(assembled.assembly.nodes[node]), why));
}

void check_nodes(const AssembledScene& assembled, const std::vector<ContactPair>& contacts,
                 const scene::NonReflecting& end, const std::vector<Face>& surface) {
  std::set<int> own;
  for (int n : surface_nodes(assembled.assembly, surface)) own.insert(n);
  for (const scene::PrescribedMotion& motion : assembled.scene.prescribed_motions)
    for (int n : find_node_set(assembled.scene, assembled.assembly, motion, "target", motion.target))
      if (own.count(n) != 0)
        refuse(assembled, end, n,
               fmt::format("moves as [prescribed_motion.{}] says; leave it out of one of the two", motion.name));
  for (const ContactPair& pair : contacts)
    for (const auto* nodes : {&pair.slave_nodes, &pair.master_nodes})
      for (int n : *nodes)
        if (!pair.has_springs() && own.count(n) != 0)
          refuse(
              assembled, end, n,
              fmt::format(
                  "belongs to [contacts.{}], whose algorithm \"multiplier\" cannot predict dashpots; set algorithm = "
                  "\"penalty\", or end that surface before the end",
                  pair.contact->name));
}

}  // namespace

void build_non_reflecting(const AssembledScene& assembled, const std::vector<ContactPair>& contacts,
                          NonReflectingEnds& ends) {
  ends = {};
  if (assembled.scene.non_reflecting.empty()) return;
  std::map<int, Matrix> dashpots;
  std::map<std::array<int, 2>, const scene::NonReflecting*> taken;
  for (const scene::NonReflecting& end : assembled.scene.non_reflecting) {
    const auto& surface = find_surface(assembled.scene, assembled.assembly, end, "target", end.target);
    check_nodes(assembled, contacts, end, surface);
    for (const Face& face : surface) {
      const auto [known, first] = taken.try_emplace({face.element, face.side}, &end);
      if (!first)
        refuse(assembled, end, assembled.assembly.face_nodes(face)[0],
               fmt::format("is of a face that [non_reflecting.{}] has already; name surfaces without common faces",
                           known->second->name));
      add_face(assembled, face, dashpots);
    }
  }
  const auto held = held_directions(assembled.scene, assembled.assembly);
  std::vector<std::array<double, 6>> rows;
  for (auto& [node, c] : dashpots) {
    const auto directions = held.find(node);
    if (directions != held.end()) take_out(c, directions->second);
    ends.nodes.push_back(node);
    rows.push_back({c[0][0], c[1][1], c[2][2], c[1][2], c[2][0], c[0][1]});
  }
  NonReflectingArrays& arrays = ends.arrays;
  arrays.count = static_cast<int>(rows.size());
  arrays.nodes = to_device("nodes of ends", ends.nodes);
  arrays.dashpot = to_device("dashpots of ends", rows);
  arrays.support = Array<double* [3]>("supports of ends", rows.size());
  arrays.start = Array<double* [3]>("start of ends", rows.size());
  arrays.force = Array<double* [3]>("dashpot forces of ends", rows.size());
  arrays.dissipated = Array<double*>("dissipated by ends", rows.size());
}

void hold_ends(const NonReflectingEnds& ends, const Array<double* [3]>& position,
               const Array<double* [3]>& unbalanced) {
  if (ends.arrays.count > 0)
    Kokkos::parallel_for("hold_ends", Range(0, ends.arrays.count), HoldEnds{ends.arrays, position, unbalanced});
}

}  // namespace railwave
