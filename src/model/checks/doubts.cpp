#include "model/checks/doubts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "mesh/vectors.hpp"
#include "model/assembled_scene.hpp"
#include "model/boundaries/absorbing_boundaries.hpp"
#include "model/boundaries/held_directions.hpp"
#include "model/checks/inside_bodies.hpp"
#include "model/checks/round_part.hpp"
#include "model/contact/initial_overlap.hpp"
#include "model/contact/rolling.hpp"
#include "model/loads/load_model.hpp"

namespace railwave {
namespace {

using Doubts = std::vector<std::string>;

/// By a contact or a tie.
bool joined(const scene::Scene& scene, const std::string& a, const std::string& b) {
  const auto joins = [&](const auto& pair) {
    const std::string slave = part_of_name(pair.slave);
    const scene::SurfaceNames masters(pair.master);
    return std::any_of(masters.begin(), masters.end(), [&](const std::string& name) {
      const std::string master = part_of_name(name);
      return (slave == a && master == b) || (slave == b && master == a);
    });
  };
  return std::any_of(scene.contacts.begin(), scene.contacts.end(), joins) ||
         std::any_of(scene.ties.begin(), scene.ties.end(), joins);
}

void overlapping_parts(const AssembledScene& assembled, Doubts& doubts) {
  // Of the smaller part's nodes; surfaces that are joined may cut into each other a little, as a leaning pad into the
  // sleeper under it.
  constexpr double least = 0.005, least_joined = 0.1;
  for (const PartOverlap& overlap : part_overlaps(assembled.assembly)) {
    const scene::Part &first = assembled.scene.parts[overlap.first], &second = assembled.scene.parts[overlap.second];
    if (overlap.inside < (joined(assembled.scene, first.name, second.name) ? least_joined : least) * overlap.nodes)
      continue;
    doubts.push_back(
        fmt::format("[parts.{}] (line {}) and [parts.{}] (line {}) overlap: {} nodes of one lie inside elements of the "
                    "other, the first at {}; see their positions",
                    first.name, first.line, second.name, second.line, overlap.inside, place_text(overlap.place)));
  }
}

/// By a contact, a tie, a connector or a beam.
bool linked(const scene::Scene& scene, const std::string& a, const std::string& b) {
  const auto links = [&](const auto& one) {
    const std::string from = part_of_name(one.from), to = part_of_name(one.to);
    return (from == a && to == b) || (from == b && to == a);
  };
  return joined(scene, a, b) || std::any_of(scene.connectors.begin(), scene.connectors.end(), links) ||
         std::any_of(scene.beams.begin(), scene.beams.end(), links);
}

/// Element sets of one mesh have nodes of their own as parts: where they meet nothing joins them by itself.
void parts_of_one_mesh(const AssembledScene& assembled, Doubts& doubts) {
  const Assembly& assembly = assembled.assembly;
  const auto& parts = assembled.scene.parts;
  const auto of_one_mesh = [&](std::size_t a, std::size_t b) {
    return parts[a].mesh == parts[b].mesh && !parts[a].element_set.empty() && !parts[b].element_set.empty();
  };
  std::vector<std::pair<Vec3, int>> places;  // with the part
  for (std::size_t p = 0; p < assembly.parts.size(); ++p)
    for (std::size_t q = 0; q < assembly.parts.size(); ++q)
      if (q != p && of_one_mesh(p, q)) {
        const int first = assembly.parts[p].first_node;
        for (int n = first; n < first + assembly.parts[p].node_count; ++n)
          places.emplace_back(assembly.nodes[n], static_cast<int>(p));
        break;
      }
  std::sort(places.begin(), places.end());
  std::map<std::pair<int, int>, std::set<Vec3>> common;  // of pairs of parts
  for (std::size_t i = 0; i < places.size(); ++i)
    for (std::size_t k = i + 1; k < places.size() && places[k].first == places[i].first; ++k)
      if (of_one_mesh(places[i].second, places[k].second) && places[i].second != places[k].second)
        common[{places[i].second, places[k].second}].insert(places[i].first);
  for (const auto& [pair, nodes] : common) {
    const scene::Part &first = parts[pair.first], &second = parts[pair.second];
    if (linked(assembled.scene, first.name, second.name)) continue;
    const auto is_common = [&, &these = nodes](int n) { return these.count(assembly.nodes[n]) != 0; };
    const Assembly::PartRange& range = assembly.parts[pair.first];
    int faces = 0;
    for (int e = range.first_element; e < range.first_element + range.element_count; ++e)
      for (int side = 0; side < 6; ++side) {
        const auto corners = assembly.face_nodes({e, side});
        faces += std::all_of(corners.begin(), corners.end(), is_common) ? 1 : 0;
      }
    if (faces == 0) continue;
    doubts.push_back(
        fmt::format("[parts.{}] (line {}) and [parts.{}] (line {}) are of one mesh and have {} in common, one of "
                    "their corners at {}, but nothing joins them: they are bodies of their own and come apart there; "
                    "tie surfaces of theirs by [ties], or let them touch by [contacts]",
                    first.name, first.line, second.name, second.line,
                    faces == 1 ? "a face" : fmt::format("{} faces", faces), place_text(*nodes.begin())));
  }
}

/// Whose forces constraints and prescribed motions take up before they move anything.
void loads_on_held_nodes(const AssembledScene& assembled, Doubts& doubts) {
  const auto held = held_directions(assembled.scene, assembled.assembly);
  if (held.empty()) return;
  for (const scene::Load& load : assembled.scene.loads) {
    const bool surface = load.type == scene::LoadType::pressure || load.type == scene::LoadType::traction;
    const std::vector<int> nodes =
        surface ? surface_nodes(assembled.assembly,
                                find_surface(assembled.scene, assembled.assembly, load, "target", load.target))
                : find_node_set(assembled.scene, assembled.assembly, load, "target", load.target);
    const Vec3 force = load.type == scene::LoadType::nodal_force ? load.force : load.traction;
    const bool directed = load.type == scene::LoadType::nodal_force || load.type == scene::LoadType::traction;
    // Of a beam's end constraints know the rotations too: its torque is no matter of nodes.
    if (load.type == scene::LoadType::torque && nodes.size() < 2) continue;
    if (directed && length(force) == 0) continue;
    const auto stays = [&](int n) { return directed ? force_is_held(held, n, force) : wholly_held(held, n); };
    const auto count = std::count_if(nodes.begin(), nodes.end(), stays);
    if (count == 0 || (count < static_cast<long>(nodes.size()) && load.type != scene::LoadType::nodal_force)) continue;
    const bool all = count == static_cast<long>(nodes.size());
    doubts.push_back(
        fmt::format("[loads.{}] (line {}) acts on '{}', of whose {} nodes {} {} held where it pushes by constraints or "
                    "prescribed motions, which take {} up{}; load or hold other "
                    "nodes",
                    load.name, load.line, load.target, nodes.size(), all ? "all" : std::to_string(count),
                    count == 1 && !all ? "is" : "are", all ? "it" : "their share",
                    all ? ": it moves nothing and does no work" : ""));
  }
}

/// Where a body begins with one velocity and its driven nodes with another.
void unlike_starts(const AssembledScene& assembled, Doubts& doubts) {
  for (const scene::PrescribedMotion& motion : assembled.scene.prescribed_motions) {
    const std::string part = part_of_name(motion.target);
    const auto own = std::find_if(
        assembled.scene.initial_motions.begin(), assembled.scene.initial_motions.end(), [&](const auto& initial) {
          return std::find(initial.parts.begin(), initial.parts.end(), part) != initial.parts.end();
        });
    if (own == assembled.scene.initial_motions.end()) continue;
    const auto& nodes = find_node_set(assembled.scene, assembled.assembly, motion, "target", motion.target);
    const Vec3 centre = centre_of_rotation(assembled, motion, nodes);
    const double factor = curve_value(curve_of(assembled.scene, motion.curve), 0);
    double most = 0, fastest = 0, prescribed_speed = 0, initial_speed = 0;
    for (int n : nodes) {
      const Vec3 turning = cross(motion.angular_velocity, difference(assembled.assembly.nodes[n], centre)),
                 initial = initial_velocity(assembled, part, assembled.assembly.nodes[n]);
      Vec3 prescribed, jump{0, 0, 0};
      for (int i = 0; i < 3; ++i) prescribed[i] = factor * (motion.velocity[i] + turning[i]);
      for (int a = 0; a < 3; ++a)
        for (int i = 0; motion.directions[a] && i < 3; ++i)
          jump[i] += dot(difference(prescribed, initial), motion.axes[a]) * motion.axes[a][i];
      fastest = std::max({fastest, length(prescribed), length(initial)});
      if (length(jump) <= most) continue;
      most = length(jump);
      prescribed_speed = length(prescribed);
      initial_speed = length(initial);
    }
    if (!(most > 0.01 * fastest)) continue;
    doubts.push_back(fmt::format(
        "[prescribed_motion.{}] (line {}) moves '{}' at {:.4g} m/s when the run begins, where [initial_motion.{}] "
        "(line {}) gives it {:.4g} m/s: the nodes jump by {:.4g} m/s "
        "in the first step; give both the same velocities and centre",
        motion.name, motion.line, motion.target, prescribed_speed, own->name, own->line, initial_speed, most));
  }
}

/// Ends that are held, springs between held nodes: they do nothing.
void entries_without_effect(const AssembledScene& assembled, Doubts& doubts) {
  const auto held = held_directions(assembled.scene, assembled.assembly);
  if (held.empty()) return;
  const auto all_held = [&](const std::vector<int>& nodes) {
    return std::all_of(nodes.begin(), nodes.end(), [&](int n) { return wholly_held(held, n); });
  };
  for (const scene::NonReflecting& end : assembled.scene.non_reflecting)
    if (all_held(surface_nodes(assembled.assembly,
                               find_surface(assembled.scene, assembled.assembly, end, "target", end.target))))
      doubts.push_back(
          fmt::format("[non_reflecting.{}] (line {}): constraints hold all nodes of '{}', so that it reflects as a "
                      "fixed end; leave one of the two out",
                      end.name, end.line, end.target));
  for (const scene::Connector& connector : assembled.scene.connectors) {
    const auto stays = [&](const char* key, const std::string& name) {
      return name == "ground" || all_held(find_node_set(assembled.scene, assembled.assembly, connector, key, name));
    };
    const bool driven = !assembled.scene.prescribed_motions.empty();  // held nodes may move then
    if (!driven && stays("from", connector.from) && stays("to", connector.to))
      doubts.push_back(
          fmt::format("[connectors.{}] (line {}): '{}' and '{}' are held, so that it is never stretched; leave it out, "
                      "or let one of its ends go",
                      connector.name, connector.line, connector.from, connector.to));
  }
}

/// Pressure between two elements, and ties to faces inside a body, are computed as they are written.
void inner_faces(const AssembledScene& assembled, Doubts& doubts) {
  if (assembled.scene.loads.empty() && assembled.scene.ties.empty()) return;
  const OutsideFaces outside(assembled.assembly);
  const auto check = [&](const char* section, const scene::Place& entry, const char* key, const std::string& name) {
    const auto& surface = find_surface(assembled.scene, assembled.assembly, entry, key, name);
    const auto inside =
        std::count_if(surface.begin(), surface.end(), [&](const Face& face) { return !outside.has(face); });
    if (inside > 0)
      doubts.push_back(
          fmt::format("[{}.{}] (line {}) {}: {} of the {} faces of '{}' lie inside the body, between two elements; see "
                      "whether a surface on the outside is meant",
                      section, entry.name, entry.line, key, inside, surface.size(), name));
  };
  for (const scene::Load& load : assembled.scene.loads)
    if (load.type == scene::LoadType::pressure || load.type == scene::LoadType::traction)
      check("loads", load, "target", load.target);
  for (const scene::Tie& tie : assembled.scene.ties) {
    check("ties", tie, "slave", tie.slave);
    check("ties", tie, "master", tie.master);
  }
}

void overlapping_contacts(const AssembledScene& assembled, const std::vector<ContactPair>& contacts, double step_size,
                          Doubts& doubts) {
  for (const InitialOverlap& overlap : initial_overlaps(assembled, contacts, step_size))
    if (overlap.deep) doubts.push_back(describe(assembled.scene, overlap));
}

}  // namespace

std::vector<std::string> mesh_doubts(const AssembledScene& assembled, const std::vector<ContactPair>& contacts,
                                     double step_size) {
  Doubts doubts;
  overlapping_parts(assembled, doubts);
  parts_of_one_mesh(assembled, doubts);
  overlapping_contacts(assembled, contacts, step_size, doubts);
  inner_faces(assembled, doubts);
  entries_without_effect(assembled, doubts);
  return doubts;
}

std::vector<std::string> scene_doubts(const AssembledScene& assembled, const std::vector<ContactPair>& contacts,
                                      const AbsorbingLayers& absorbing, double step_size) {
  Doubts doubts = rolling_doubts(assembled);
  unlike_starts(assembled, doubts);
  overlapping_parts(assembled, doubts);
  parts_of_one_mesh(assembled, doubts);
  overlapping_contacts(assembled, contacts, step_size, doubts);
  loads_on_held_nodes(assembled, doubts);
  inner_faces(assembled, doubts);
  entries_without_effect(assembled, doubts);
  for (std::string& path : path_doubts(assembled, contacts)) doubts.push_back(std::move(path));
  for (std::string& doubt : absorbing_doubts(assembled, absorbing)) doubts.push_back(std::move(doubt));
  return doubts;
}

}  // namespace railwave
