#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

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

/// Whether two sorted lists share a number.
bool common(const std::vector<int>& a, const std::vector<int>& b) {
  std::vector<int> shared;
  std::set_intersection(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(shared));
  return !shared.empty();
}

/// Cosine of the angle between two segments from which an inner fold counts as sharp: 60 degrees.
constexpr double sharp_fold = 0.5;

Vec3 difference(const Vec3& a, const Vec3& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
double product(const Vec3& a, const Vec3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/// Outward normal, twice the area long, and the centre.
struct Facet {
  Vec3 normal{}, centre{};
  Facet(const std::vector<Vec3>& x, const int (&corner)[4]) {
    const Vec3 p = difference(x[corner[2]], x[corner[0]]), q = difference(x[corner[3]], x[corner[1]]);
    normal = {p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]};
    for (int k = 0; k < 4; ++k)
      for (int i = 0; i < 3; ++i) centre[i] += 0.25 * x[corner[k]][i];
  }
};

bool folded_inwards(const Facet& a, const Facet& b) {
  const double along = product(a.normal, b.normal);
  return product(a.normal, difference(b.centre, a.centre)) > 0 &&
         along < sharp_fold * std::sqrt(product(a.normal, a.normal) * product(b.normal, b.normal));
}

/// The master's segments with their neighbours, and whether sharp inner folds lie between them.
std::vector<Segment> linked_segments(const Assembly& assembly, const std::vector<Face>& master, bool& folded) {
  std::vector<Segment> segments;
  std::map<std::array<int, 2>, std::vector<std::array<int, 2>>> sides;  // of two nodes: segment, its side
  for (const Face& face : master) {
    const auto corner = assembly.face_nodes(face);
    Segment segment{};
    for (int k = 0; k < 4; ++k) {
      segment.node[k] = corner[k];
      segment.neighbour[k] = -1;
      const std::array<int, 2> ends{std::min(corner[k], corner[(k + 1) % 4]), std::max(corner[k], corner[(k + 1) % 4])};
      sides[ends].push_back({static_cast<int>(segments.size()), k});
    }
    segments.push_back(segment);
  }
  folded = false;
  for (const auto& [ends, pair] : sides) {
    // Where more than two segments meet there is no such thing as the neighbour.
    if (pair.size() != 2) continue;
    const auto& [a, b] = std::pair{pair[0], pair[1]};
    segments[a[0]].neighbour[a[1]] = b[0];
    segments[b[0]].neighbour[b[1]] = a[0];
    folded = folded || folded_inwards({assembly.nodes, segments[a[0]].node}, {assembly.nodes, segments[b[0]].node});
  }
  return segments;
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
  arrays.surface = to_device("surface", linked_segments(assembly, master, arrays.folded_inwards));
  arrays.tracked = Array<int*>("tracked", arrays.slave_count);
  arrays.place = Array<double* [2]>("place", arrays.slave_count);
  arrays.gap = Array<double*>("gap", arrays.slave_count);
  arrays.normal_force = Array<double* [3]>("normal force", arrays.slave_count);
  arrays.tangential_force = Array<double* [3]>("tangential force", arrays.slave_count);
  arrays.status = Array<int*>("status", arrays.slave_count);
  arrays.friction_energy = Array<double*>("friction energy", arrays.slave_count);
  if (contact.algorithm == scene::ContactAlgorithm::multiplier)
    pair.multipliers = {Array<MultiplierRow*>("multipliers", arrays.slave_count),
                        Array<std::uint64_t*>("crowd", masters), Array<double* [3]>("way since stuck", arrays.slave_count),
                        Array<double*>("impact energy", arrays.slave_count)};
  pair.missed = Array<int*>("missed", 1);
  model.contacts.push_back(pair);
}

}  // namespace

void build_contacts(Model& model) {
  for (const scene::Contact& contact : model.scene.contacts) build_pair(model, contact);
  for (ContactPair& pair : model.contacts)
    for (const ContactPair& other : model.contacts)
      if (&other != &pair && (common(pair.master_nodes, other.slave_nodes) || common(pair.master_nodes, other.master_nodes)))
        pair.own_master = false;
}

}  // namespace railwave
