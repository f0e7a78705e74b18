#include "model/contact/initial_overlap.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "mesh/hexahedron.hpp"
#include "mesh/nearest_on_triangle.hpp"
#include "mesh/vectors.hpp"
#include "model/sets/place_sets.hpp"
#include "model/sets/point_search.hpp"

namespace railwave {
namespace {

/// Of the size of a face. What is less is rounding, or facets that stand for curves.
constexpr double noticed = 1e-5;
/// The same: springs as stiff as the elements under them press with about a hundredth of Young's modulus then, beyond
/// what steel bears.
constexpr double deep_share = 0.01;
/// The same where the scene settles first: statics shares it among the bodies, and Hertz cases of this repository begin
/// with 0.104.
constexpr double deep_share_settled = 0.25;
/// Cosine of the angle between the way to a face and its normal: what lies farther beside it is under another surface
/// of the body.
constexpr double beside = 0.7;
/// Natural coordinates by which rounding may put a node outside both elements on whose common side it lies.
constexpr double on_a_side = 1e-9;
/// m/s with which multipliers throw nodes out: they close a gap within a step. As of a hard impact.
constexpr double thrown = 1;

/// Four nodes of the model each.
using Faces = std::vector<std::array<int, 4>>;

/// The faces of a surface, to be asked for the one nearest to a place.
class NearestFace {
 public:
  struct Found {
    int face = -1;  ///< position in the surface
    Vec3 point{0, 0, 0};
    double distance = std::numeric_limits<double>::infinity();
  };

  NearestFace(const Assembly& assembly, const Faces& faces) : assembly_(assembly), faces_(faces) {
    for (std::size_t f = 0; f < faces.size(); ++f) {
      Bounds bounds = no_bounds;
      for (int n : faces[f]) widen(bounds, assembly.nodes[n]);
      order_.push_back({0.5 * (bounds[0][0] + bounds[1][0]), static_cast<int>(f)});
      reach_ = std::max(reach_, 0.5 * (bounds[1][0] - bounds[0][0]));
    }
    std::sort(order_.begin(), order_.end());
  }

  /// Goes both ways from the place along x, until all further faces are farther off than the best one.
  Found find(const Vec3& place) const {
    Found best;
    const auto middle = std::lower_bound(order_.begin(), order_.end(), std::pair<double, int>{place[0], 0});
    for (auto up = middle; up != order_.end() && up->first - place[0] - reach_ < best.distance; ++up)
      consider(place, up->second, best);
    for (auto down = middle; down != order_.begin() && place[0] - std::prev(down)->first - reach_ < best.distance;
         --down)
      consider(place, std::prev(down)->second, best);
    return best;
  }

 private:
  void consider(const Vec3& place, int f, Found& best) const {
    const auto& corner = faces_[f];
    const auto& x = assembly_.nodes;
    for (int second : {1, 2}) {
      const Vec3 point = nearest_on_triangle(x[corner[0]], x[corner[second]], x[corner[second + 1]], place);
      const double distance = length(difference(point, place));
      if (distance < best.distance || (distance == best.distance && f < best.face)) best = {f, point, distance};
    }
  }

  const Assembly& assembly_;
  const Faces& faces_;
  std::vector<std::pair<double, int>> order_;  ///< m, x of a face's middle
  double reach_ = 0;                           ///< m, half the longest face along x
};

/// How much of a small ball around a place lies in an element, were its corners square: all inside, half at a face, a
/// quarter at an edge.
double share_in(const Vec3& natural) {
  double share = 1;
  for (double c : natural) {
    if (!(std::fabs(c) <= 1 + on_a_side)) return 0;
    if (std::fabs(c) >= 1 - on_a_side) share *= 0.5;
  }
  return share;
}

/// Nodes within elements of that part, ascending; not those of which they are corners, nor those on the part's outer
/// faces.
std::vector<int> nodes_inside(const Assembly& assembly, const std::vector<int>& nodes,
                              const Assembly::PartRange& part) {
  Bounds where = no_bounds;
  for (int n : nodes) widen(where, assembly.nodes[n]);
  const NodeGrid grid(assembly.nodes, nodes, where);
  std::map<int, double> share;
  for (int e = part.first_element; e < part.first_element + part.element_count; ++e) {
    const auto& corners = assembly.elements[e];
    Bounds bounds = no_bounds;
    for (int n : corners) widen(bounds, assembly.nodes[n]);
    bool apart = false;
    for (int i = 0; i < 3; ++i) apart = apart || bounds[0][i] > where[1][i] || bounds[1][i] < where[0][i];
    if (apart) continue;
    grid.within(bounds, [&](int n) {
      if (std::find(corners.begin(), corners.end(), n) != corners.end()) return;
      if (const double here = share_in(natural_coordinates(corners_of(assembly.nodes, corners), assembly.nodes[n]));
          here > 0)
        share[n] += here;
    });
  }
  std::vector<int> inside;
  for (const auto& [n, all] : share)
    if (all > 0.7) inside.push_back(n);
  return inside;
}

/// Its faces as numbers of the model's nodes.
Faces master_of(const ContactPair& pair) {
  Faces faces;
  for (auto corners : pair.master_segments) {
    for (int& n : corners) n = pair.master_nodes[n];
    faces.push_back(corners);
  }
  return faces;
}

/// Whether a node inside the body lies under the face, seen along its normal.
bool is_under(const Assembly& assembly, const std::array<int, 4>& c, const Vec3& node, const Vec3& point) {
  const Vec3 normal = doubled_area(assembly.nodes, c), way = difference(point, node);
  return dot(way, normal) >= beside * length(way) * length(normal);
}

double size_of(const Assembly& assembly, const std::array<int, 4>& c) {
  const auto& x = assembly.nodes;
  return std::sqrt(facet_area(x[c[0]], x[c[1]], x[c[2]], x[c[3]]));
}

bool is_deep(const scene::Scene& scene, double step_size, const InitialOverlap& overlap) {
  if (overlap.share > (scene.settle.active ? deep_share_settled : deep_share)) return true;
  return overlap.contact->algorithm == scene::ContactAlgorithm::multiplier && !scene.settle.active &&
         overlap.depth > thrown * step_size;
}

/// A pair's slave nodes in its master's bodies.
/// @param sign -1 where the pair is the second half of a symmetric contact: its slave is the contact's master
void find_overlaps(const Assembly& assembly, const ContactPair& pair, double sign, InitialOverlap& overlap) {
  std::vector<int> inside;
  for (const auto& part : assembly.parts) {
    const auto is_own = [&](int n) { return n >= part.first_node && n < part.first_node + part.node_count; };
    if (std::none_of(pair.master_nodes.begin(), pair.master_nodes.end(), is_own)) continue;
    const auto more = nodes_inside(assembly, pair.slave_nodes, part);
    inside.insert(inside.end(), more.begin(), more.end());
  }
  if (inside.empty()) return;
  const Faces master = master_of(pair);
  const NearestFace faces(assembly, master);
  for (int n : inside) {
    const Vec3& x = assembly.nodes[n];
    const auto found = faces.find(x);
    const double size = size_of(assembly, master[found.face]);
    if (found.distance <= noticed * size || !is_under(assembly, master[found.face], x, found.point)) continue;
    ++overlap.nodes;
    if (found.distance <= overlap.depth) continue;
    overlap.depth = found.distance;
    overlap.share = found.distance / size;
    overlap.place = x;
    for (int i = 0; i < 3; ++i) overlap.outwards[i] = sign * (found.point[i] - x[i]) / found.distance;
  }
}

}  // namespace

std::vector<InitialOverlap> initial_overlaps(const AssembledScene& assembled, const std::vector<ContactPair>& contacts,
                                             double step_size) {
  std::vector<InitialOverlap> overlaps;
  for (const ContactPair& pair : contacts) {
    if (pair.reversed) continue;
    InitialOverlap overlap;
    overlap.contact = pair.contact;
    find_overlaps(assembled.assembly, pair, 1, overlap);
    if (pair.partner >= 0) find_overlaps(assembled.assembly, contacts[pair.partner], -1, overlap);
    if (overlap.nodes == 0) continue;
    overlap.deep = is_deep(assembled.scene, step_size, overlap);
    overlaps.push_back(overlap);
  }
  return overlaps;
}

std::string mend_of(const InitialOverlap& overlap) {
  const scene::Contact& contact = *overlap.contact;
  const std::string part = part_of_name(contact.slave);
  const Vec3 shift = {overlap.depth * overlap.outwards[0], overlap.depth * overlap.outwards[1],
                      overlap.depth * overlap.outwards[2]};
  const double up =
      1.0 / std::max({std::fabs(overlap.outwards[0]), std::fabs(overlap.outwards[1]), std::fabs(overlap.outwards[2])});
  const auto rounded = [&](double component) { return std::round(1e3 * -up * component) / 1e3 + 0.0; };
  return fmt::format(
      "shift parts.{}.position by [{:.4g}, {:.4g}, {:.4g}] m, or place it farther off and give contacts.{}.close_gap = "
      "[{:g}, {:g}, {:g}]; where pressing in is "
      "meant, bring it in by a [prescribed_motion] or a load with a curve that rises from 0",
      part, shift[0], shift[1], shift[2], contact.name, rounded(overlap.outwards[0]), rounded(overlap.outwards[1]),
      rounded(overlap.outwards[2]));
}

std::string describe(const scene::Scene& scene, const InitialOverlap& overlap) {
  const scene::Contact& contact = *overlap.contact;
  const std::string what = fmt::format(
      "[contacts.{}] (line {}): {} node{} of '{}' lie{} inside the body of '{}' when the run begins, the deepest "
      "{:.4g} m ({:.3g} of the size of a face there) at {}",
      contact.name, contact.line, overlap.nodes, overlap.nodes == 1 ? "" : "s", contact.slave,
      overlap.nodes == 1 ? "s" : "", contact.master.text(), overlap.depth, overlap.share, place_text(overlap.place));
  if (overlap.deep)
    return fmt::format("{}: more than a contact can push apart without a blow; {}", what, mend_of(overlap));
  return fmt::format("{}: {}", what,
                     scene.settle.active
                         ? "settling pushes them apart"
                         : "its forces push them apart in the first steps, and both bodies ring a little");
}

}  // namespace railwave
