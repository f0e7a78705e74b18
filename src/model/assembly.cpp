#include "model/assembly.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <utility>

#include "case/activity.hpp"
#include "case/complaints.hpp"
#include "case/error.hpp"
#include "case/suggest.hpp"
#include "mesh/build_mesh.hpp"
#include "mesh/mesh.hpp"
#include "mesh/mesh_memory.hpp"
#include "mesh/seam.hpp"
#include "mesh/vectors.hpp"
#include "model/beams/beams.hpp"
#include "model/sets/place_sets.hpp"
#include "model/sets/point_search.hpp"

namespace railwave {
namespace {

/// "1.2 million", "34 thousand".
std::string rounded_count(double count) {
  if (count >= 1e6) return fmt::format("{:.3g} million", 1e-6 * count);
  return count >= 1e4 ? fmt::format("{:.3g} thousand", 1e-3 * count) : fmt::format("{:.0f}", count);
}

template <class Map>
std::vector<std::string> names_of(const Map& map) {
  std::vector<std::string> names;
  for (const auto& entry : map) names.push_back(entry.first);
  return names;
}

/// The part of a mesh that one element set covers, with a numbering of its own.
Mesh submesh(const Mesh& mesh, const std::vector<int>& kept) {
  Mesh result;
  std::vector<int> new_node(mesh.nodes.size(), -1), new_element(mesh.elements.size(), -1);
  for (int e : kept) {
    new_element[e] = static_cast<int>(result.elements.size());
    auto corners = mesh.elements[e];
    for (int& n : corners) {
      if (new_node[n] < 0) {
        new_node[n] = static_cast<int>(result.nodes.size());
        result.nodes.push_back(mesh.nodes[n]);
      }
      n = new_node[n];
    }
    result.elements.push_back(corners);
  }
  for (const auto& [name, nodes] : mesh.node_sets)
    for (int n : nodes)
      if (new_node[n] >= 0) result.node_sets[name].push_back(new_node[n]);
  for (const auto& [name, elements] : mesh.element_sets)
    for (int e : elements)
      if (new_element[e] >= 0) result.element_sets[name].push_back(new_element[e]);
  for (const auto& [name, faces] : mesh.surfaces)
    for (const Face& face : faces)
      if (new_element[face.element] >= 0) result.surfaces[name].push_back({new_element[face.element], face.side});
  return result;
}

Mesh whole_mesh(const scene::Scene& scene, const scene::Part& part, std::vector<std::string>& notes) {
  const scene::MeshSource* source = find_entry(scene.meshes, part.mesh);
  const Activity making(fmt::format("{} the mesh of part {}, about {} elements",
                                    source->type == scene::MeshType::file ? "reading" : "making", part.name,
                                    rounded_count(expected_elements(*source))));
  std::vector<std::string> own;
  Mesh mesh = build_mesh(*source, &own);
  for (const scene::Seam& seam : scene.seams)
    if (seam.mesh == part.mesh)
      own.push_back(
          describe(seam, open_seam(seam, fmt::format("{}:{}: [seams.{}]", scene.path, seam.line, seam.name), mesh)));
  for (std::string& note : own)
    if (std::find(notes.begin(), notes.end(), note) == notes.end()) notes.push_back(std::move(note));
  return mesh;
}

/// A part's own mesh.
/// @param shared meshes of several element sets, by name: each is read or made once
Mesh mesh_of(const scene::Scene& scene, const scene::Part& part, std::map<std::string, Mesh>& shared,
             std::vector<std::string>& notes) {
  if (part.element_set.empty()) return whole_mesh(scene, part, notes);
  const auto known = shared.find(part.mesh);
  const Mesh& mesh =
      known != shared.end() ? known->second : shared.emplace(part.mesh, whole_mesh(scene, part, notes)).first->second;
  const auto set = mesh.element_sets.find(part.element_set);
  if (set == mesh.element_sets.end())
    throw InputError(unknown_set(scene, part, "element_set", part.element_set, names_of(mesh.element_sets)));
  return submesh(mesh, set->second);
}

/// Puts values behind others, where there are none without a copy.
template <class T>
void put_behind(std::vector<T>& all, std::vector<T>&& more) {
  if (all.empty())
    all = std::move(more);
  else
    all.insert(all.end(), more.begin(), more.end());
}

std::vector<int> numbers_from(int first, std::size_t count) {
  std::vector<int> numbers(count);
  std::iota(numbers.begin(), numbers.end(), first);
  return numbers;
}

void append(Assembly& assembly, Mesh&& mesh, const std::string& part) {
  const int first_node = static_cast<int>(assembly.nodes.size());
  const int first_element = static_cast<int>(assembly.elements.size());
  assembly.node_sets[part] = numbers_from(first_node, mesh.nodes.size());
  assembly.element_sets[part] = numbers_from(first_element, mesh.elements.size());
  for (auto& corners : mesh.elements)
    for (int& n : corners) n += first_node;
  put_behind(assembly.nodes, std::move(mesh.nodes));
  put_behind(assembly.elements, std::move(mesh.elements));
  for (const auto& [name, nodes] : mesh.node_sets)
    for (int n : nodes) assembly.node_sets[part + "." + name].push_back(first_node + n);
  for (const auto& [name, elements] : mesh.element_sets)
    for (int e : elements) assembly.element_sets[part + "." + name].push_back(first_element + e);
  for (const auto& [name, faces] : mesh.surfaces) {
    auto& surface = assembly.surfaces[part + "." + name];
    for (const Face& face : faces) surface.push_back({first_element + face.element, face.side});
    // A surface's nodes are a node set too, unless the mesh has one of that name.
    auto& nodes = assembly.node_sets[part + "." + name];
    if (nodes.empty()) nodes = surface_nodes(assembly, surface);
  }
}

/// How far from `origin` along `direction` the triangle is (Moeller and Trumbore 1997); infinity: missed.
double distance_to_triangle(const Vec3& origin, const Vec3& direction, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 e1 = difference(b, a), e2 = difference(c, a), p = cross(direction, e2);
  const double determinant = dot(e1, p);
  const double missed = std::numeric_limits<double>::infinity();
  if (std::fabs(determinant) < 1e-30) return missed;
  const Vec3 t = difference(origin, a), q = cross(t, e1);
  const double u = dot(t, p) / determinant, v = dot(direction, q) / determinant;
  if (u < -1e-9 || v < -1e-9 || u + v > 1 + 1e-9) return missed;
  return dot(e2, q) / determinant;
}

/// The least way along a direction of unit length on which one of the nodes meets one of the faces; infinity: none
/// does.
double distance_to_faces(const Assembly& assembly, const std::vector<int>& nodes, const Vec3& direction,
                         const std::vector<Face>& faces) {
  // Seen along the direction a node meets only those faces that it lies in.
  const int steepest =
      static_cast<int>(std::max_element(direction.begin(), direction.end(),
                                        [](double a, double b) { return std::fabs(a) < std::fabs(b); }) -
                       direction.begin());
  const auto seen = [&](const Vec3& x) {
    Vec3 y{0, 0, 0};
    for (int i = 0; i < 3; ++i)
      if (i != steepest) y[i] = x[i] - x[steepest] * direction[i] / direction[steepest];
    return y;
  };
  std::vector<Vec3> places;
  std::vector<int> numbers;
  Bounds around = no_bounds;
  for (const int n : nodes) {
    numbers.push_back(static_cast<int>(places.size()));
    places.push_back(seen(assembly.nodes[n]));
    widen(around, places.back());
  }
  const NodeGrid grid(places, numbers, around);
  double nearest = std::numeric_limits<double>::infinity();
  for (const Face& face : faces) {
    const auto corner = assembly.face_nodes(face);
    Bounds of_face = no_bounds;
    for (const int n : corner) widen(of_face, seen(assembly.nodes[n]));
    const double slack = 1e-6 * length(difference(of_face[1], of_face[0]));
    for (int i = 0; i < 3; ++i) {
      if (i == steepest) continue;  // all are at 0 there
      of_face[0][i] -= slack;
      of_face[1][i] += slack;
    }
    grid.within(of_face, [&](int k) {
      for (int second : {1, 2})
        nearest =
            std::min(nearest, distance_to_triangle(assembly.nodes[nodes[k]], direction, assembly.nodes[corner[0]],
                                                   assembly.nodes[corner[second]], assembly.nodes[corner[second + 1]]));
    });
  }
  return nearest;
}

/// Moves the slave's part along the contact's direction until its first node touches the master.
void close_gap(const scene::Scene& scene, const scene::Contact& contact, Assembly& assembly) {
  Vec3 direction = *contact.close_gap;
  const double size = length(direction);
  for (double& d : direction) d /= size;
  const double nearest = distance_to_faces(
      assembly, surface_nodes(assembly, find_surface(scene, assembly, contact, "slave", contact.slave)), direction,
      master_faces(scene, assembly, contact));
  if (!std::isfinite(nearest))
    throw InputError(
        fmt::format("{}:{}: [contacts.{}] close_gap: moved along [{}, {}, {}], no node of '{}' ever meets '{}'; "
                    "turn the direction, or place the part so that the surfaces face each other",
                    scene.path, contact.line, contact.name, direction[0], direction[1], direction[2], contact.slave,
                    contact.master.text()));
  const std::string part = part_of_name(contact.slave);
  for (int n : assembly.node_sets.at(part))
    for (int i = 0; i < 3; ++i) assembly.nodes[n][i] += nearest * direction[i];
  for (Assembly::PartRange& range : assembly.parts)
    for (int i = 0; range.name == part && i < 3; ++i) range.origin[i] += nearest * direction[i];
}

/// Turns parts with an angle of attack about their origins.
void turn_parts(const scene::Scene& scene, Assembly& assembly) {
  for (std::size_t p = 0; p < scene.parts.size(); ++p) {
    const scene::Part& part = scene.parts[p];
    if (part.angle_of_attack == 0) continue;
    const auto& range = assembly.parts[p];
    for (int n = range.first_node; n < range.first_node + range.node_count; ++n) {
      const Vec3 arm = turned_with(part, difference(assembly.nodes[n], part.position));
      for (int i = 0; i < 3; ++i) assembly.nodes[n][i] = part.position[i] + arm[i];
    }
  }
}

}  // namespace

Vec3 turned_with(const scene::Part& part, const Vec3& v) {
  const double c = std::cos(part.angle_of_attack), s = std::sin(part.angle_of_attack);
  return {c * v[0] - s * v[1], s * v[0] + c * v[1], v[2]};
}

Vec3 turned_with_part_of(const scene::Scene& scene, const std::string& name, const Vec3& v) {
  const scene::Part* part = find_entry(scene.parts, part_of_name(name));
  return part != nullptr ? turned_with(*part, v) : v;
}

std::string unknown_set(const scene::Scene& scene, const scene::Place& entry, const std::string& key,
                        const std::string& name, const std::vector<std::string>& known) {
  const std::string hint = known.empty() ? "the mesh has none" : suggestion(name, known);
  const std::string place = entry.line > 0 ? fmt::format("{}:{}", scene.path, entry.line) : scene.path;
  return fmt::format("{}: {}: {}: there is no set '{}'; {}", place, entry.name, key, case_file::printable(name), hint);
}

const std::vector<int>& find_node_set(const scene::Scene& scene, const Assembly& assembly, const scene::Place& entry,
                                      const std::string& key, const std::string& name) {
  const auto found = assembly.node_sets.find(name);
  if (found == assembly.node_sets.end() || found->second.empty())
    throw InputError(unknown_set(scene, entry, key, name, names_of(assembly.node_sets)));
  return found->second;
}

const std::vector<Face>& find_surface(const scene::Scene& scene, const Assembly& assembly, const scene::Place& entry,
                                      const std::string& key, const std::string& name) {
  const auto found = assembly.surfaces.find(name);
  if (found == assembly.surfaces.end() || found->second.empty())
    throw InputError(unknown_set(scene, entry, key, name, names_of(assembly.surfaces)));
  return found->second;
}

std::vector<Face> master_faces(const scene::Scene& scene, const Assembly& assembly, const scene::Contact& contact) {
  std::vector<Face> faces;
  std::map<std::array<int, 2>, const std::string*> owner;  // by element, side
  for (const std::string& name : contact.master)
    for (const Face& face : find_surface(scene, assembly, contact, "master", name)) {
      const auto [known, first] = owner.try_emplace({face.element, face.side}, &name);
      if (!first && known->second != &name)
        throw InputError(
            fmt::format("{}:{}: [contacts.{}] master: '{}' and '{}' have faces in common, which would press twice; "
                        "leave one of the two out, or name surfaces "
                        "without common faces",
                        scene.path, contact.line, contact.name, *known->second, name));
      faces.push_back(face);
    }
  return faces;
}

int part_of_element(const Assembly& assembly, int element) {
  for (std::size_t p = 0; p < assembly.parts.size(); ++p)
    if (const int within = element - assembly.parts[p].first_element;
        within >= 0 && within < assembly.parts[p].element_count)
      return static_cast<int>(p);
  return -1;
}

int part_of_node(const Assembly& assembly, int node) {
  for (std::size_t p = 0; p < assembly.parts.size(); ++p)
    if (const int within = node - assembly.parts[p].first_node; within >= 0 && within < assembly.parts[p].node_count)
      return static_cast<int>(p);
  return -1;
}

std::string part_of_name(const std::string& name) { return name.substr(0, name.find('.')); }

std::string place_text(const Vec3& x) { return fmt::format("({:.6g}, {:.6g}, {:.6g}) m", x[0], x[1], x[2]); }

std::vector<int> surface_nodes(const Assembly& assembly, const std::vector<Face>& surface) {
  std::vector<int> nodes;
  for (const Face& face : surface)
    for (int n : assembly.face_nodes(face)) nodes.push_back(n);
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  return nodes;
}

Assembly assemble(const scene::Scene& scene) {
  std::vector<std::string> notes;
  return assemble(scene, notes);
}

Assembly assemble(const scene::Scene& scene, std::vector<std::string>& notes) {
  const Activity assembling("putting the parts together");
  Assembly assembly;
  expect_memory_for_parts(scene);
  std::map<std::string, Mesh> shared;
  for (const scene::Part& part : scene.parts) {
    Mesh mesh = mesh_of(scene, part, shared, notes);
    if (part.mirror) mirror(mesh);
    for (Vec3& node : mesh.nodes)
      for (int i = 0; i < 3; ++i) node[i] += part.position[i];
    const std::size_t nodes = assembly.nodes.size() + mesh.nodes.size();
    if (nodes > static_cast<std::size_t>(std::numeric_limits<int>::max()))
      throw InputError(
          fmt::format("{}:{}: [parts.{}] is the part with which the scene has {} nodes, more than {} can be numbered; "
                      "make the elements larger",
                      scene.path, part.line, part.name, nodes, std::numeric_limits<int>::max()));
    Assembly::PartRange range;
    range.name = part.name;
    range.origin = part.position;
    range.first_node = static_cast<int>(assembly.nodes.size());
    range.node_count = static_cast<int>(mesh.nodes.size());
    range.first_element = static_cast<int>(assembly.elements.size());
    range.element_count = static_cast<int>(mesh.elements.size());
    range.material = static_cast<int>(find_entry(scene.materials, part.material) - scene.materials.data());
    assembly.parts.push_back(range);
    append(assembly, std::move(mesh), part.name);
  }
  shared.clear();
  for (const scene::PointMass& point : scene.points) {
    assembly.point_nodes.push_back(static_cast<int>(assembly.nodes.size()));
    assembly.node_sets[point.name] = {assembly.point_nodes.back()};
    assembly.nodes.push_back(point.position);
  }
  add_node_sets(scene, assembly);
  add_element_sets(scene, assembly);
  turn_parts(scene, assembly);
  for (const scene::Contact& contact : scene.contacts)
    if (contact.close_gap) {
      const Activity closing("closing the gap of contact " + contact.name);
      close_gap(scene, contact, assembly);
    }
  lay_beams(scene, assembly);
  return assembly;
}

}  // namespace railwave
