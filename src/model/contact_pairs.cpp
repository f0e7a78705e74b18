#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "case/error.hpp"
#include "mesh/hexahedron.hpp"
#include "model/build_steps.hpp"
#include "model/host_copy.hpp"

namespace railwave {
namespace {

/// Facets of a surface as positions in its sorted list of nodes.
std::vector<std::array<int, 4>> local_facets(const Assembly& assembly, const std::vector<Face>& surface,
                                             const std::vector<int>& nodes) {
  std::vector<std::array<int, 4>> facets;
  for (const Face& face : surface) {
    auto corner = assembly.face_nodes(face);
    for (int& n : corner) n = static_cast<int>(std::lower_bound(nodes.begin(), nodes.end(), n) - nodes.begin());
    facets.push_back(corner);
  }
  return facets;
}

const scene::Material& material_of(const Model& model, int element) {
  for (const auto& part : model.assembly.parts)
    if (element < part.first_element + part.element_count) return model.scene.materials[part.material];
  return model.scene.materials.front();
}

/// k = f_SI K A^2 / V of the element under the segment, thesis eq. 2.26d.
double penalty_stiffness(const Model& model, const Face& face, double scale) {
  const Assembly& assembly = model.assembly;
  const auto corner = assembly.face_nodes(face);
  const auto& x = assembly.nodes;
  const double area = facet_area(x[corner[0]], x[corner[1]], x[corner[2]], x[corner[3]]);
  const double volume = hexahedron_volume(corners_of(x, assembly.elements[face.element]));
  return scale * material_of(model, face.element).bulk_modulus() * area * area / volume;
}

void build_pair(Model& model, const scene::Contact& contact) {
  const Assembly& assembly = model.assembly;
  ContactPair pair;
  pair.contact = &contact;
  const auto& slave = find_surface(model.scene, assembly, contact, "slave", contact.slave);
  const auto& master = find_surface(model.scene, assembly, contact, "master", contact.master);
  pair.slave_nodes = surface_nodes(assembly, slave);
  pair.master_nodes = surface_nodes(assembly, master);
  std::vector<int> shared;
  std::set_intersection(pair.slave_nodes.begin(), pair.slave_nodes.end(), pair.master_nodes.begin(), pair.master_nodes.end(),
                        std::back_inserter(shared));
  if (!shared.empty())
    throw InputError(fmt::format("{}:{}: [contacts.{}]: '{}' and '{}' share {} nodes, so they cannot press on each other; "
                                 "choose surfaces without common nodes",
                                 model.scene.path, contact.line, contact.name, contact.slave, contact.master, shared.size()));
  pair.slave_facets = local_facets(assembly, slave, pair.slave_nodes);
  pair.master_segments = local_facets(assembly, master, pair.master_nodes);
  for (const Face& face : master) {
    pair.segment_stiffness.push_back(penalty_stiffness(model, face, contact.penalty_scale));
    const auto corner = assembly.face_nodes(face);
    for (int k : {0, 1}) {
      const Vec3 &a = assembly.nodes[corner[k]], &b = assembly.nodes[corner[k + 2]];
      pair.segment_size = std::max(pair.segment_size, std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]));
    }
  }

  const int masters = static_cast<int>(pair.master_nodes.size());
  std::vector<int> first(masters + 1, 0);
  for (const auto& segment : pair.master_segments)
    for (int m : segment) ++first[m + 1];
  for (int m = 0; m < masters; ++m) first[m + 1] += first[m];
  std::vector<int> filled(first.begin(), first.end() - 1), around(first.back());
  for (std::size_t s = 0; s < pair.master_segments.size(); ++s)
    for (int m : pair.master_segments[s]) around[filled[m]++] = static_cast<int>(s);

  ContactArrays& arrays = pair.arrays;
  arrays.slave_count = static_cast<int>(pair.slave_nodes.size());
  arrays.master_count = masters;
  arrays.segment_count = static_cast<int>(pair.master_segments.size());
  arrays.friction = contact.friction;
  arrays.slave_nodes = to_device("slave nodes", pair.slave_nodes);
  arrays.master_nodes = to_device("master nodes", pair.master_nodes);
  arrays.segments = to_device("segments", pair.master_segments);
  arrays.first_segment = to_device("first segment", first);
  arrays.segment_of_node = to_device("segment of node", around);
  arrays.segment_stiffness = to_device("segment stiffness", pair.segment_stiffness);
  arrays.closest = Array<int*>("closest", arrays.slave_count);
  arrays.segment = Array<int*>("segment", arrays.slave_count);
  arrays.place = Array<double* [2]>("place", arrays.slave_count);
  arrays.gap = Array<double*>("gap", arrays.slave_count);
  arrays.normal_force = Array<double* [3]>("normal force", arrays.slave_count);
  arrays.tangential_force = Array<double* [3]>("tangential force", arrays.slave_count);
  arrays.status = Array<int*>("status", arrays.slave_count);
  arrays.friction_energy = Array<double*>("friction energy", arrays.slave_count);
  arrays.master_force = Array<double* [3]>("master force", masters);
  model.contacts.push_back(pair);
}

}  // namespace

void build_contacts(Model& model) {
  for (const scene::Contact& contact : model.scene.contacts) build_pair(model, contact);
}

}  // namespace railwave
