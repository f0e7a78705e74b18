#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "case/error.hpp"
#include "mesh/vectors.hpp"
#include "model/assembled_scene.hpp"
#include "model/boundaries/held_directions.hpp"
#include "model/build_steps.hpp"
#include "model/checks/inside_bodies.hpp"
#include "model/checks/round_part.hpp"
#include "model/checks/stiff_surfaces.hpp"
#include "model/contact/contact_pair.hpp"
#include "model/loads/load_model.hpp"

// Entries of a scene that cannot all hold, as far as it takes the meshes to see it. What the case file alone shows is
// in case/rules_scene.cpp; what may be meant is reported by model/checks/doubts.cpp.
namespace railwave {
namespace {

template <class Entry>
[[noreturn]] void refuse(const scene::Scene& scene, const char* section, const Entry& entry, const std::string& what) {
  throw InputError(fmt::format("{}:{}: [{}.{}]: {}", scene.path, entry.line, section, entry.name, what));
}

std::string along(const Vec3& d) { return fmt::format("({:.4g}, {:.4g}, {:.4g})", d[0], d[1], d[2]); }

/// A prescribed motion that moves nodes which a constraint holds: one of both would win in silence.
void refuse_moved_constraints(const AssembledScene& assembled) {
  std::multimap<int, std::pair<const scene::PrescribedMotion*, Prescribed>> moved;
  double fastest = 0, farthest = 0;
  for (const scene::PrescribedMotion& motion : assembled.scene.prescribed_motions) {
    const auto& nodes = find_node_set(assembled.scene, assembled.assembly, motion, "target", motion.target);
    const Vec3 centre = centre_of_rotation(assembled, motion, nodes);
    for (int n : nodes) {
      const Prescribed here = prescribed_at(motion, centre, assembled.assembly.nodes[n]);
      fastest = std::max(fastest, length(here.velocity));
      farthest = std::max(farthest, length(here.displacement));
      moved.emplace(n, std::make_pair(&motion, here));
    }
  }
  if (moved.empty()) return;
  constexpr double rounding = 1e-6;
  for (const scene::Constraint& constraint : assembled.scene.constraints)
    for (int n : find_node_set(assembled.scene, assembled.assembly, constraint, "target", constraint.target)) {
      const auto [first, last] = moved.equal_range(n);
      for (auto found = first; found != last; ++found) {
        const auto& [motion, here] = found->second;
        for (int a = 0; a < 3; ++a) {
          if (!constraint.fixed[a]) continue;
          const double speed = dot(here.velocity, constraint.axes[a]), way = dot(here.displacement, constraint.axes[a]);
          const bool fast = std::fabs(speed) > rounding * fastest, far = std::fabs(way) > rounding * farthest;
          if (!fast && !far) continue;
          refuse(assembled.scene, "constraints", constraint,
                 fmt::format("holds the node at {} along {}, in which [prescribed_motion.{}] (line {}) moves it by {}; "
                             "leave the common nodes of '{}' and '{}' out of one of the "
                             "two, or give only the other `directions`",
                             place_text(assembled.assembly.nodes[n]), along(constraint.axes[a]), motion->name,
                             motion->line, fast ? fmt::format("{:.4g} m/s", speed) : fmt::format("{:.4g} m", way),
                             constraint.target, motion->target));
        }
      }
    }
}

/// The faces of one side of a contact or tie, to be compared with those of others.
std::set<std::array<int, 2>> faces_of(const AssembledScene& assembled, const scene::Place& entry, const char* key,
                                      const scene::SurfaceNames& names) {
  std::set<std::array<int, 2>> faces;
  for (const std::string& name : names)
    for (const Face& face : find_surface(assembled.scene, assembled.assembly, entry, key, name))
      faces.insert({face.element, face.side});
  return faces;
}

struct Pair {
  const scene::Place* entry;
  std::string slave_name, master_name;
  std::set<std::array<int, 2>> slave, master;
};

template <class Entry>
std::vector<Pair> pairs_of(const AssembledScene& assembled, const std::vector<Entry>& entries) {
  std::vector<Pair> pairs;
  for (const Entry& entry : entries)
    pairs.push_back({&entry, entry.slave, scene::SurfaceNames(entry.master).text(),
                     faces_of(assembled, entry, "slave", entry.slave),
                     faces_of(assembled, entry, "master", entry.master)});
  return pairs;
}

bool share(const std::set<std::array<int, 2>>& a, const std::set<std::array<int, 2>>& b) {
  return std::any_of(a.begin(), a.end(), [&](const auto& face) { return b.count(face) != 0; });
}

/// Common faces on both sides.
bool meet(const Pair& a, const Pair& b) {
  return (share(a.slave, b.slave) && share(a.master, b.master)) ||
         (share(a.slave, b.master) && share(a.master, b.slave));
}

bool same_names(const Pair& a, const Pair& b) {
  return (a.slave_name == b.slave_name && a.master_name == b.master_name) ||
         (a.slave_name == b.master_name && a.master_name == b.slave_name);
}

void refuse_double_pairs(const AssembledScene& assembled) {
  const auto contacts = pairs_of(assembled, assembled.scene.contacts), ties = pairs_of(assembled, assembled.scene.ties);
  for (std::size_t i = 0; i < contacts.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      // The same two names are refused when the case is read.
      if (!same_names(contacts[i], contacts[j]) && meet(contacts[i], contacts[j]))
        refuse(assembled.scene, "contacts", *contacts[i].entry,
               fmt::format("'{}' and '{}' have faces in common with both surfaces of [contacts.{}] (line {}), where "
                           "their forces would count twice; keep one of them, or name "
                           "surfaces without common faces",
                           contacts[i].slave_name, contacts[i].master_name, contacts[j].entry->name,
                           contacts[j].entry->line));
  for (const Pair& tie : ties)
    for (const Pair& contact : contacts)
      if (meet(tie, contact))
        refuse(assembled.scene, "ties", *tie.entry,
               fmt::format("'{}' and '{}' have faces in common with both surfaces of [contacts.{}] (line {}), but what "
                           "is tied neither opens nor slides; keep one of the two, "
                           "or name surfaces without common faces",
                           tie.slave_name, tie.master_name, contact.entry->name, contact.entry->line));
}

/// Faces inside a body touch nothing and let nothing out.
void refuse_inner_faces(const AssembledScene& assembled) {
  if (assembled.scene.contacts.empty() && assembled.scene.non_reflecting.empty()) return;
  const OutsideFaces outside(assembled.assembly);
  const auto check = [&](const char* section, const scene::Place& entry, const char* key, const std::string& name,
                         const char* why) {
    const auto& surface = find_surface(assembled.scene, assembled.assembly, entry, key, name);
    std::size_t inside = 0;
    Vec3 place{};
    for (const Face& face : surface) {
      if (outside.has(face)) continue;
      if (inside++ > 0) continue;
      for (int n : assembled.assembly.face_nodes(face))
        for (int i = 0; i < 3; ++i) place[i] += 0.25 * assembled.assembly.nodes[n][i];
    }
    if (inside == 0) return;
    throw InputError(fmt::format(
        "{}:{}: [{}.{}] {}: {} of the {} faces of '{}' lie inside the body, between two elements, the first at {}; {}",
        assembled.scene.path, entry.line, section, entry.name, key, inside, surface.size(), name, place_text(place),
        why));
  };
  constexpr const char* no_contact = "nothing can touch them: name a surface on the outside";
  for (const scene::Contact& contact : assembled.scene.contacts) {
    check("contacts", contact, "slave", contact.slave, no_contact);
    for (const std::string& master : contact.master) check("contacts", contact, "master", master, no_contact);
  }
  for (const scene::NonReflecting& end : assembled.scene.non_reflecting)
    check("non_reflecting", end, "target", end.target, "waves leave a body on its outside: name a surface there");
}

/// Both ends are the same nodes under two names.
void refuse_empty_connectors(const AssembledScene& assembled) {
  const auto nodes = [&](const scene::Place& entry, const char* key, const std::string& name) {
    auto result = find_node_set(assembled.scene, assembled.assembly, entry, key, name);
    std::sort(result.begin(), result.end());
    return result;
  };
  for (const scene::Connector& connector : assembled.scene.connectors) {
    if (connector.from == "ground" || connector.to == "ground" ||
        nodes(connector, "from", connector.from) != nodes(connector, "to", connector.to))
      continue;
    refuse(assembled.scene, "connectors", connector,
           fmt::format("'{}' and '{}' are the same nodes, between which nothing is ever stretched; name two ends",
                       connector.from, connector.to));
  }
}

/// One part in the place of another, as copying its section makes it.
void refuse_coincident_parts(const AssembledScene& assembled) {
  for (const PartOverlap& overlap : part_overlaps(assembled.assembly)) {
    if (!overlap.coincident) continue;
    const scene::Part &first = assembled.scene.parts[overlap.first], &second = assembled.scene.parts[overlap.second];
    refuse(assembled.scene, "parts", second,
           fmt::format("lies in the place of [parts.{}] (line {}), node on node; give it another position, or leave "
                       "one of the two out",
                       first.name, first.line));
  }
}

/// A struck place that cannot move answers with nothing.
void refuse_held_hammers(const AssembledScene& assembled) {
  const auto held = held_directions(assembled.scene, assembled.assembly);
  if (held.empty()) return;
  for (const scene::Hammer& hammer : assembled.scene.hammers) {
    const auto& nodes =
        find_node_set(assembled.scene, assembled.assembly, hammer, "position", hammer.part + "." + hammer.name);
    const auto stays = [&](int n) { return force_is_held(held, n, hammer.direction); };
    if (std::all_of(nodes.begin(), nodes.end(), stays))
      refuse(assembled.scene, "hammers", hammer,
             fmt::format("strikes {} along {}, where constraints or prescribed motions hold all that it strikes; "
                         "strike another place, or in another direction",
                         place_text(assembled.assembly.nodes[nodes.front()]), along(hammer.direction)));
  }
}

/// Multipliers find the force that lets surfaces move as far as they must: between two that no force moves there is
/// none, and it grows without end. Springs just press as far as they are pressed in.
void refuse_stiff_multipliers(const AssembledScene& assembled, const std::vector<ContactPair>& contacts) {
  for (const ContactPair& pair : contacts) {
    if (pair.has_springs()) continue;
    if (const auto meeting = stiff_meeting(assembled, pair))
      refuse(assembled.scene, "contacts", *pair.contact,
             fmt::format("algorithm: multipliers press surfaces apart by moving them, but {}: no force moves either, "
                         "and the multipliers would grow without end; set algorithm = \"penalty\", or hold and drive "
                         "one of the two bodies at another surface",
                         *meeting));
  }
}

}  // namespace

void refuse_unknown_methods(const scene::Scene& scene) {
  const scene::Solver& solver = scene.solver;
  const auto refuse_wish = [&](const std::string& wish, const std::string& mend) {
    throw InputError(
        fmt::format("{}: [solver] {}: this version of railwave has no time loop for it; {}", scene.path, wish, mend));
  };
  const bool single = solver.precision == scene::Precision::single_precision;
  if (single && solver.subcycling)
    refuse_wish("precision = \"float\" with subcycling = true",
                "leave one of the two out, or set precision to \"mixed\"");
  if (single && !scene.prescribed_motions.empty())
    refuse_wish("precision = \"float\" with a [prescribed_motion]", "set precision to \"mixed\" or \"double\"");
  if (solver.subcycling && solver.step_estimate == scene::StepEstimate::global)
    refuse_wish("subcycling = true with step_estimate = \"global\"",
                "leave one of the two out: a level's steps rest on its own elements");
}

void refuse_contradictions(const AssembledScene& assembled, const std::vector<ContactPair>& contacts) {
  refuse_moved_constraints(assembled);
  refuse_double_pairs(assembled);
  refuse_inner_faces(assembled);
  refuse_coincident_parts(assembled);
  refuse_empty_connectors(assembled);
  refuse_held_hammers(assembled);
  refuse_stiff_multipliers(assembled, contacts);
}

}  // namespace railwave
