#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "case/error.hpp"
#include "mesh/hexahedron.hpp"
#include "mesh/vectors.hpp"
#include "model/build_steps.hpp"
#include "model/contact/contact_law.hpp"
#include "model/contact/link_segments.hpp"
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

const scene::Material& material_of(const AssembledScene& assembled, int element) {
  return assembled.scene.materials[assembled.assembly.parts[part_of_element(assembled.assembly, element)].material];
}

/// m, the longer of a face's diagonals.
double diagonal_of(const Assembly& assembly, const Face& face) {
  const auto corner = assembly.face_nodes(face);
  double longest = 0;
  for (int k : {0, 1}) {
    const Vec3 &a = assembly.nodes[corner[k]], &b = assembly.nodes[corner[k + 2]];
    longest = std::max(longest, std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]));
  }
  return longest;
}

/// k = f_SI K A^2 / V of the element under the segment, thesis eq. 2.26d.
double penalty_stiffness(const AssembledScene& assembled, const Face& face, double scale) {
  const Assembly& assembly = assembled.assembly;
  const auto corner = assembly.face_nodes(face);
  const auto& x = assembly.nodes;
  const double area = facet_area(x[corner[0]], x[corner[1]], x[corner[2]], x[corner[3]]);
  const double volume = hexahedron_volume(corners_of(x, assembly.elements[face.element]));
  return scale * material_of(assembled, face.element).bulk_modulus() * area * area / volume;
}

/// Whether two sorted lists share a number.
bool common(const std::vector<int>& a, const std::vector<int>& b) {
  std::vector<int> shared;
  std::set_intersection(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(shared));
  return !shared.empty();
}

/// Sum of the normals of a surface's facets around each of its nodes.
std::map<int, Vec3> normals_at_nodes(const Assembly& assembly, const std::vector<Face>& surface) {
  std::map<int, Vec3> normals;
  for (const Face& face : surface) {
    const auto corner = assembly.face_nodes(face);
    const Vec3 normal = doubled_area(assembly.nodes, corner);
    for (int n : corner)
      for (int i = 0; i < 3; ++i) normals[n][i] += normal[i];
  }
  return normals;
}

/// m: a crack, slot or gap in the master as wide as that is crossed: what slides there is not let down between.
double widest_mouth(const Assembly& assembly, const scene::Contact& contact, const std::vector<Face>& slave) {
  if (contact.bridged_gap) return *contact.bridged_gap;
  double smallest = 1e300;
  for (const Face& face : slave) {
    const auto corner = assembly.face_nodes(face);
    double longest = 0;
    for (int k = 0; k < 4; ++k)
      longest = std::max(longest, length(difference(assembly.nodes[corner[k]], assembly.nodes[corner[(k + 1) % 4]])));
    smallest = std::min(smallest, longest);
  }
  return std::max(smallest, std::min(scene::usual_bridged_gap, 4 * smallest));
}

/// Cosine of the angle between the two surfaces' normals up to which a common node is the end of a seam: 120 degrees.
constexpr double facing = -0.5;

/// Which slaves are nodes of the master too. Only the ends of a seam may be: there the surfaces face each other.
std::vector<char> nodes_on_both(const AssembledScene& assembled, const scene::Contact& contact,
                                const std::vector<Face>& slave, const std::vector<Face>& master,
                                const std::vector<int>& slave_nodes) {
  const auto of_slave = normals_at_nodes(assembled.assembly, slave),
             of_master = normals_at_nodes(assembled.assembly, master);
  std::vector<char> on_both(slave_nodes.size(), 0);
  std::size_t shared = 0, no_seam = 0;
  for (std::size_t s = 0; s < slave_nodes.size(); ++s) {
    const auto there = of_master.find(slave_nodes[s]);
    if (there == of_master.end()) continue;
    const Vec3 &a = of_slave.at(slave_nodes[s]), &b = there->second;
    on_both[s] = 1;
    ++shared;
    if (dot(a, b) > facing * std::sqrt(dot(a, a) * dot(b, b))) ++no_seam;
  }
  if (no_seam > 0 || shared == slave_nodes.size())
    throw InputError(
        fmt::format("{}:{}: [contacts.{}]: '{}' and '{}' share {} nodes, so they cannot press on each other; "
                    "choose surfaces without common nodes (but for the ends of a seam, whose two sides face each "
                    "other and have nodes of their own)",
                    assembled.scene.path, contact.line, contact.name, contact.slave, contact.master.text(), shared));
  return on_both;
}

ContactPair build_pair(const AssembledScene& assembled, const scene::Contact& contact, bool reversed) {
  const Assembly& assembly = assembled.assembly;
  ContactPair pair;
  pair.contact = &contact;
  pair.reversed = reversed;
  std::vector<Face> slave = find_surface(assembled.scene, assembly, contact, "slave", contact.slave);
  std::vector<Face> master = master_faces(assembled.scene, assembly, contact);
  if (reversed) std::swap(slave, master);
  pair.slave_nodes = surface_nodes(assembly, slave);
  pair.master_nodes = surface_nodes(assembly, master);
  pair.on_both = nodes_on_both(assembled, contact, slave, master, pair.slave_nodes);
  pair.slave_facets = local_facets(assembly, slave, pair.slave_nodes);
  pair.master_segments = local_facets(assembly, master, pair.master_nodes);
  for (const Face& face : master) {
    pair.segment_stiffness.push_back(
        penalty_stiffness(assembled, face, (contact.symmetric ? 0.5 : 1.0) * contact.penalty_scale));
    pair.segment_size = std::max(pair.segment_size, diagonal_of(assembly, face));
  }
  for (const Face& face : slave)
    pair.slave_strength =
        std::max(pair.slave_strength, 0.1 * diagonal_of(assembly, face) * penalty_stiffness(assembled, face, 1));

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
  std::vector<std::array<int, 4>> corners;
  for (const Face& face : master) {
    const auto corner = assembly.face_nodes(face);
    corners.push_back({corner[0], corner[1], corner[2], corner[3]});
  }
  const LinkedSegments linked = link_segments(assembly.nodes, corners, widest_mouth(assembly, contact, slave));
  arrays.surface = to_device("surface", linked.segments);
  arrays.mouth_corners = to_device("mouth corners", linked.mouth_corners);
  arrays.boxes = make_boxes(assembly.nodes, corners);
  arrays.tracked = Array<int*>("tracked", arrays.slave_count);
  arrays.place = Array<double* [2]>("place", arrays.slave_count);
  arrays.gap = Array<double*>("gap", arrays.slave_count);
  arrays.entry_depth = Array<double*>("entry depth", arrays.slave_count);
  arrays.normal_force = Array<double* [3]>("normal force", arrays.slave_count);
  arrays.tangential_force = Array<double* [3]>("tangential force", arrays.slave_count);
  arrays.status = Array<int*>("status", arrays.slave_count);
  arrays.friction_energy = Array<double*>("friction energy", arrays.slave_count);
  set_algorithm(pair);
  pair.growth = largest_growth(contact);
  pair.missed = Array<int*>("missed", 1);
  pair.uncounted = Array<int*>("uncounted", 1);
  pair.uncounted_sent = PinnedArray<int*>("uncounted, sent", 1);
  return pair;
}

}  // namespace

void set_algorithm(ContactPair& pair) {
  const ContactArrays& arrays = pair.arrays;
  pair.multipliers = {};
  if (pair.contact->algorithm == scene::ContactAlgorithm::multiplier)
    pair.multipliers = {Array<MultiplierRow*>("multipliers", arrays.slave_count),
                        Array<double* [3]>("way since stuck", arrays.slave_count),
                        arrays.mouth_corners.extent(0) == 0 ? nodes_of_multiplier : most_nodes_of_multiplier,
                        Array<double*>("impact energy", arrays.slave_count)};
  pair.law = make_contact_law(*pair.contact, arrays.slave_count);
}

void build_contacts(const AssembledScene& assembled, std::vector<ContactPair>& contacts) {
  for (const scene::Contact& contact : assembled.scene.contacts)
    contacts.push_back(build_pair(assembled, contact, false));
  for (std::size_t c = 0; c < assembled.scene.contacts.size(); ++c) {
    if (!assembled.scene.contacts[c].symmetric) continue;
    contacts[c].partner = static_cast<int>(contacts.size());
    contacts.push_back(build_pair(assembled, assembled.scene.contacts[c], true));
    contacts.back().partner = static_cast<int>(c);
  }
  for (ContactPair& pair : contacts) {
    pair.own_master = !common(pair.master_nodes, pair.slave_nodes);
    for (const ContactPair& other : contacts)
      if (&other != &pair &&
          (common(pair.master_nodes, other.slave_nodes) || common(pair.master_nodes, other.master_nodes)))
        pair.own_master = false;
  }
}

}  // namespace railwave
