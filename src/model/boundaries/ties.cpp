#include "model/boundaries/ties.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "case/error.hpp"
#include "kernels/contact/contact_projection.hpp"
#include "model/boundaries/held_directions.hpp"
#include "model/build_steps.hpp"
#include "model/contact/contact_pair.hpp"
#include "model/host_copy.hpp"

namespace railwave {
namespace {

/// How far beyond a face's sides, in its own coordinates, a node may lie: facets of a curved edge do not meet exactly.
constexpr double most_outside = 0.25;
constexpr double default_distance = 0.1;  // of the shorter diagonal
/// Share of its mass that a slave node keeps.
constexpr double trace_of_mass = 1.0 / (1ull << 40);
/// A master node with less of all slaves' weights is tied to none.
constexpr double least_weight = 0.01;
/// Distances below this share of the face are rounding: the node lies on the face.
constexpr double on_face = 1e-9;

Vector3 vector(const Vec3& a) { return {{a[0], a[1], a[2]}}; }

/// A face of the master, ready for projections.
struct MasterFace {
  std::array<int, 4> node{};
  Vector3 corner[4], centre{{0, 0, 0}};
  double radius = 0, diagonal = 0;

  MasterFace(const Assembly& assembly, const Face& face) : node(assembly.face_nodes(face)) {
    for (int k = 0; k < 4; ++k) {
      corner[k] = vector(assembly.nodes[node[k]]);
      centre = centre + 0.25 * corner[k];
    }
    for (const Vector3& c : corner) radius = std::fmax(radius, norm(c - centre));
    diagonal = std::fmin(norm(corner[2] - corner[0]), norm(corner[3] - corner[1]));
  }

  SeenSegment seen_from(const Vector3& x) const {
    const Vector3 a = corner[0] - x, b = corner[1] - x, c = corner[2] - x, d = corner[3] - x;
    return {0, 0.25 * (a + b + c + d), 0.25 * (b - a + (c - d)), 0.25 * (c + d - (a + b)), 0.25 * (c - d - (b - a))};
  }
};

/// The nearest face to a slave node, and how far it is.
struct Nearest {
  int face = -1;
  SegmentPlace place{0, 0};
  double distance = 1e300;  ///< m, from the face itself, within its sides
};

/// @param guess a face that may be near: it saves looking closely at most of the others
Nearest nearest_face(const std::vector<MasterFace>& faces, const Vector3& x, int guess) {
  Nearest nearest;
  double within = norm(x - faces[guess].centre) + faces[guess].radius;
  for (std::size_t f = 0; f < faces.size(); ++f) {
    within = std::fmin(within, nearest.distance);
    if (norm(x - faces[f].centre) - faces[f].radius > within) continue;
    const SeenSegment seen = faces[f].seen_from(x);
    const SegmentPlace place = ContactProjection::nearest_place(seen, {0, 0});
    const double distance = norm(seen.point(place.clamped()));
    if (!(distance < nearest.distance)) continue;
    nearest = {static_cast<int>(f), place, distance};
  }
  return nearest;
}

TiedPlace tied_place(int slave, const Vector3& x, const MasterFace& face, const SegmentPlace& place) {
  TiedPlace tied{};
  tied.slave = slave;
  const double xi = place.xi, eta = place.eta;
  for (int k = 0; k < 4; ++k) {
    tied.face[k] = face.node[k];
    tied.weight[k] = segment_shape(k, xi, eta);
    tied.slope_xi[k] = 0.5 * (segment_shape(k, 1, eta) - segment_shape(k, -1, eta));
    tied.slope_eta[k] = 0.5 * (segment_shape(k, xi, 1) - segment_shape(k, xi, -1));
  }
  const Projection projection = ContactProjection::at(face.seen_from(x), place);
  tied.distance = std::fabs(projection.gap) > on_face * face.diagonal ? projection.gap : 0;
  return tied;
}

/// Why a node cannot be a slave of a tie: something else moves it already, or reads its own motion.
class Conflicts {
 public:
  Conflicts(const AssembledScene& assembled, const std::vector<ContactPair>& contacts)
      : held_(held_directions(assembled.scene, assembled.assembly)), why_(assembled.mass.size()) {
    for (const ContactPair& pair : contacts) {
      if (pair.has_springs()) continue;
      for (const auto* nodes : {&pair.slave_nodes, &pair.master_nodes})
        for (int n : *nodes)
          why_[n] = fmt::format(
              "belongs to [contacts.{}], whose algorithm \"multiplier\" cannot predict how a tied node moves; set "
              "algorithm = \"penalty\", or end that surface before the tie",
              pair.contact->name);
    }
    for (const scene::PrescribedMotion& motion : assembled.scene.prescribed_motions)
      for (int n : find_node_set(assembled.scene, assembled.assembly, motion, "target", motion.target))
        why_[n] = fmt::format("moves as [prescribed_motion.{}] says; tie other nodes", motion.name);
    for (const scene::NonReflecting& end : assembled.scene.non_reflecting)
      for (int n : surface_nodes(assembled.assembly,
                                 find_surface(assembled.scene, assembled.assembly, end, "target", end.target)))
        why_[n] = fmt::format(
            "belongs to [non_reflecting.{}]; make its surface the tie's master, or end it before the tie", end.name);
  }

  /// Why a node cannot be a slave; empty: it can.
  std::string of(const TiedPlace& tied) const {
    if (!why_[tied.slave].empty()) return why_[tied.slave];
    const auto held = held_.find(tied.slave);
    if (held == held_.end()) return {};
    // On a plane of symmetry, say, the master's nodes are held as well, and the slave with them.
    for (int k = 0; k < 4; ++k)
      if (std::fabs(tied.weight[k]) > 1e-9 && !all_held(tied.face[k], held->second))
        return "is held by a constraint that does not hold the face under it; leave it out of the constraint's set, or "
               "hold the "
               "master's nodes there in the same directions";
    return {};
  }

  void take(int slave, const scene::Tie& tie) {
    why_[slave] = fmt::format("is tied by [ties.{}] already; name surfaces without common nodes", tie.name);
  }

 private:
  bool all_held(int n, const std::vector<Vec3>& directions) const {
    const auto held = held_.find(n);
    if (held == held_.end()) return false;
    for (const Vec3& d : directions) {
      Vector3 rest = vector(d);
      for (const Vec3& known : held->second) rest = rest - dot(rest, vector(known)) * vector(known);
      if (norm(rest) > 1e-9) return false;
    }
    return true;
  }

  std::map<int, std::vector<Vec3>> held_;
  std::vector<std::string> why_;
};

[[noreturn]] void refuse(const scene::Scene& scene, const scene::Tie& tie, const std::string& what) {
  throw InputError(fmt::format("{}:{}: [ties.{}]: {}", scene.path, tie.line, tie.name, what));
}

void refuse_far(const scene::Scene& scene, const scene::Tie& tie, const std::vector<std::string>& far,
                std::size_t slaves) {
  if (far.empty()) return;
  std::string list;
  for (std::size_t k = 0; k < std::min<std::size_t>(far.size(), 3); ++k) list += (k == 0 ? "" : "; ") + far[k];
  refuse(scene, tie,
         fmt::format(
             "{} of the {} nodes of '{}' have no face of '{}' near enough: {}{}; place the surfaces on each other, "
             "take nodes beside the master out of the slave, or give a larger max_distance",
             far.size(), slaves, tie.slave, tie.master, list, far.size() > 3 ? "; ..." : ""));
}

void add_tie(const AssembledScene& assembled, const scene::Tie& tie, Conflicts& conflicts, Ties& ties) {
  const Assembly& assembly = assembled.assembly;
  const auto slaves = surface_nodes(assembly, find_surface(assembled.scene, assembly, tie, "slave", tie.slave));
  std::vector<MasterFace> faces;
  for (const Face& face : find_surface(assembled.scene, assembly, tie, "master", tie.master))
    faces.emplace_back(assembly, face);
  std::vector<std::string> far;
  int guess = 0;
  for (int n : slaves) {
    const Vector3 x = vector(assembly.nodes[n]);
    const Nearest nearest = nearest_face(faces, x, guess);
    guess = nearest.face;
    const MasterFace& face = faces[nearest.face];
    const double allowed = tie.max_distance.value_or(default_distance * face.diagonal);
    if (nearest.distance > allowed || nearest.place.outside() > most_outside) {
      far.push_back(fmt::format("{}, {:.3g} m from it (allowed: {:.3g} m)", place_text(assembly.nodes[n]),
                                nearest.distance, allowed));
      continue;
    }
    const TiedPlace tied = tied_place(n, x, face, nearest.place);
    for (int corner : tied.face)
      if (corner == n)
        refuse(assembled.scene, tie,
               fmt::format("'{}' and '{}' share the node at {}; name surfaces without common nodes", tie.slave,
                           tie.master, place_text(assembly.nodes[n])));
    const std::string conflict = conflicts.of(tied);
    if (!conflict.empty())
      refuse(assembled.scene, tie, fmt::format("the slave's node at {} {}", place_text(assembly.nodes[n]), conflict));
    conflicts.take(n, tie);
    ties.place_of_slave.emplace(n, static_cast<int>(ties.places.size()));
    ties.places.push_back(tied);
  }
  refuse_far(assembled.scene, tie, far, slaves.size());
}

/// A master node must not be a slave of another tie: forces pass over one tie only.
/// @param places_end of each of the scene's ties: how many places it and those before it have
void refuse_chains(const AssembledScene& assembled, const Ties& ties, const std::vector<std::size_t>& places_end) {
  std::vector<char> slave(assembled.mass.size(), 0);
  for (const TiedPlace& tied : ties.places) slave[tied.slave] = 1;
  std::size_t tie = 0;
  for (std::size_t i = 0; i < ties.places.size(); ++i) {
    while (i >= places_end[tie]) ++tie;
    for (int n : ties.places[i].face)
      if (slave[n] != 0)
        refuse(assembled.scene, assembled.scene.ties[tie],
               fmt::format("the node at {} is of a slave and of a master; ties cannot follow each other: let "
                           "one surface be the master of both, or end the surfaces before they meet",
                           place_text(assembled.assembly.nodes[n])));
  }
}

/// Where the slave is the coarser mesh, no slave node is tied to the master's nodes between: the surfaces would part.
void refuse_coarse_slaves(const AssembledScene& assembled, const Ties& ties) {
  const Assembly& assembly = assembled.assembly;
  std::vector<double> weight(assembled.mass.size(), 0);
  for (const TiedPlace& tied : ties.places)
    for (int k = 0; k < 4; ++k) weight[tied.face[k]] += std::fabs(tied.weight[k]);
  for (const scene::Tie& tie : assembled.scene.ties) {
    std::vector<MasterFace> faces;
    for (const Face& face : find_surface(assembled.scene, assembly, tie, "slave", tie.slave))
      faces.emplace_back(assembly, face);
    int guess = 0;
    for (int n : surface_nodes(assembly, find_surface(assembled.scene, assembly, tie, "master", tie.master))) {
      if (weight[n] > least_weight) continue;
      const Nearest nearest = nearest_face(faces, vector(assembly.nodes[n]), guess);
      guess = nearest.face;
      if (nearest.distance > default_distance * faces[nearest.face].diagonal || nearest.place.outside() > -least_weight)
        continue;
      refuse(assembled.scene, tie,
             fmt::format(
                 "the master's node at {} lies on '{}', but no node of that is near it: the slave is the coarser mesh "
                 "there, and the surfaces would come apart between its nodes; exchange slave and master",
                 place_text(assembly.nodes[n]), tie.slave));
    }
  }
}

/// All arrays but the rows of external forces: build_external_forces numbers these later.
void build_tie_arrays(Ties& ties) {
  for (const TiedPlace& tied : ties.places) ties.masters.insert(ties.masters.end(), tied.face, tied.face + 4);
  std::sort(ties.masters.begin(), ties.masters.end());
  ties.masters.erase(std::unique(ties.masters.begin(), ties.masters.end()), ties.masters.end());
  std::vector<std::vector<TieShare>> of_master(ties.masters.size());
  for (std::size_t s = 0; s < ties.places.size(); ++s)
    for (int k = 0; k < 4; ++k) {
      const TiedPlace& tied = ties.places[s];
      const auto place = std::lower_bound(ties.masters.begin(), ties.masters.end(), tied.face[k]);
      of_master[place - ties.masters.begin()].push_back(
          {static_cast<int>(s), 0, tied.weight[k], tied.slope_xi[k], tied.slope_eta[k]});
    }
  std::vector<int> first{0};
  std::vector<TieShare> shares;
  for (const auto& own : of_master) {
    shares.insert(shares.end(), own.begin(), own.end());
    first.push_back(static_cast<int>(shares.size()));
  }
  TieArrays& arrays = ties.arrays;
  arrays.slave_count = static_cast<int>(ties.places.size());
  arrays.master_count = static_cast<int>(ties.masters.size());
  arrays.places = to_device("tied places", ties.places);
  arrays.master_nodes = to_device("masters of ties", ties.masters);
  arrays.first_share = to_device("first share of ties", first);
  arrays.shares = to_device("shares of ties", shares);
  arrays.passed_on = Array<double* [9]>("forces over ties", ties.places.size());
  arrays.before = Array<double* [3]>("tied nodes before", ties.places.size());
}

}  // namespace

void build_ties(const AssembledScene& assembled, const std::vector<ContactPair>& contacts, Ties& ties) {
  ties = {};
  if (assembled.scene.ties.empty()) return;
  Conflicts conflicts(assembled, contacts);
  std::vector<std::size_t> places_end;
  for (const scene::Tie& tie : assembled.scene.ties) {
    add_tie(assembled, tie, conflicts, ties);
    places_end.push_back(ties.places.size());
  }
  refuse_chains(assembled, ties, places_end);
  refuse_coarse_slaves(assembled, ties);
  build_tie_arrays(ties);
}

std::vector<double> masses_with_ties(const Ties& ties, std::vector<double> mass) {
  for (const TiedPlace& tied : ties.places) {
    double total = 0;
    for (double weight : tied.weight) total += std::fmax(weight, 0.0);
    for (int k = 0; k < 4; ++k) mass[tied.face[k]] += std::fmax(tied.weight[k], 0.0) / total * mass[tied.slave];
    mass[tied.slave] *= trace_of_mass;
  }
  return mass;
}

}  // namespace railwave
