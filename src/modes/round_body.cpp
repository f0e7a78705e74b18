#include "modes/round_body.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <limits>
#include <map>
#include <numeric>

namespace railwave {
namespace {

using Complex = std::complex<double>;

constexpr double same_place = 1e-5;   ///< of the largest radius: nodes of one ring
constexpr double most_slope = 0.1;    ///< radial over length of an edge along a ring
constexpr double most_spread = 0.05;  ///< of radii in a ring, of its mean
constexpr int fewest_nodes = 12;      ///< of a ring
constexpr double widest_gap = 0.15;   ///< of the way round, between nodes of a ring
constexpr double least_share = 0.5;   ///< of the part's mass that lies in rings
constexpr int highest_order = 40;
constexpr int radius_steps = 24;      ///< in which the displacement along the radius is looked at
constexpr double least_swing = 0.03;  ///< of its largest value: what lies below has no sign

Eigen::Vector3d vector(const Vec3& a) { return {a[0], a[1], a[2]}; }

/// By angle.
void sort_ring(std::vector<int>& nodes, std::vector<double>& angle) {
  std::vector<std::size_t> order(nodes.size());
  for (std::size_t k = 0; k < order.size(); ++k) order[k] = k;
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return angle[a] < angle[b]; });
  const auto nodes_before = nodes;
  const auto angle_before = angle;
  for (std::size_t k = 0; k < order.size(); ++k) {
    nodes[k] = nodes_before[order[k]];
    angle[k] = angle_before[order[k]];
  }
}

/// The node that stands for all those of a ring: union and find.
int first_of(std::vector<int>& parent, int node) {
  while (parent[node] != node) node = parent[node] = parent[parent[node]];
  return node;
}

/// Nodes of each ring: those of one radius and height, and those that edges round the axis join to them, because the
/// radius of a wheel's ring grows a little with the width of its cells (mesh/body_balance.hpp).
/// @param local place of each node: two directions across the axis, then along it; m
/// @param unit m, within which places count as the same
std::vector<std::vector<int>> nodes_of_rings(const std::vector<Eigen::Vector3d>& local, double unit,
                                             const std::vector<std::array<int, 2>>& edges) {
  std::vector<double> radius;
  for (const Eigen::Vector3d& x : local) radius.push_back(x.head<2>().norm());
  std::vector<int> parent(local.size());
  std::iota(parent.begin(), parent.end(), 0);
  const auto unite = [&](int a, int b) { parent[first_of(parent, a)] = first_of(parent, b); };
  std::map<std::pair<long, long>, int> found;
  for (std::size_t k = 0; k < local.size(); ++k) {
    // Places count as the same in one cell of a lattice; its origin is off round numbers, so that no cell border runs
    // through a ring.
    const auto cell = std::make_pair(std::lround(radius[k] / unit + 0.31), std::lround(local[k][2] / unit + 0.37));
    unite(static_cast<int>(k), found.try_emplace(cell, static_cast<int>(k)).first->second);
  }
  for (const auto& [a, b] : edges)
    if (std::fabs(local[a][2] - local[b][2]) <= unit &&
        std::fabs(radius[a] - radius[b]) <= most_slope * (local[a] - local[b]).norm())
      unite(a, b);
  std::map<int, std::vector<int>> rings;
  for (std::size_t k = 0; k < parent.size(); ++k)
    rings[first_of(parent, static_cast<int>(k))].push_back(static_cast<int>(k));
  std::vector<std::vector<int>> nodes;
  for (auto& [first, ring] : rings) nodes.push_back(std::move(ring));
  return nodes;
}

/// Nodes at the ends of each edge of each element, counted from the part's first node.
std::vector<std::array<int, 2>> edges_of(const Assembly& assembly, const Assembly::PartRange& range) {
  std::vector<std::array<int, 2>> edges;
  for (int e = range.first_element; e < range.first_element + range.element_count; ++e)
    for (const auto& side : hexahedron_face_corners)
      for (int i = 0; i < 4; ++i)
        edges.push_back({assembly.elements[e][side[i]] - range.first_node,
                         assembly.elements[e][side[(i + 1) % 4]] - range.first_node});
  return edges;
}

}  // namespace

const char* text_of(RoundName::Kind kind) {
  return kind == RoundName::Kind::axial ? "axial" : kind == RoundName::Kind::radial ? "radial" : "circumferential";
}

std::optional<RoundBody::Ring> RoundBody::ring_of(const std::vector<int>& nodes,
                                                  const std::vector<Eigen::Vector3d>& local, const double* mass) {
  const int count = static_cast<int>(nodes.size());
  if (count < fewest_nodes) return {};
  Ring ring;
  double least = std::numeric_limits<double>::max(), most = 0;
  for (int k : nodes) {
    const double radius = local[k].head<2>().norm();
    ring.nodes.push_back(k);
    ring.angle.push_back(std::atan2(local[k][1], local[k][0]));
    ring.mass += mass[k];
    ring.radius += radius / count;
    least = std::min(least, radius);
    most = std::max(most, radius);
  }
  if (most - least > most_spread * ring.radius) return {};
  sort_ring(ring.nodes, ring.angle);
  for (int k = 0; k < count; ++k) {
    const double before = k > 0 ? ring.angle[k - 1] : ring.angle.back() - 2 * M_PI;
    const double behind = k + 1 < count ? ring.angle[k + 1] : ring.angle.front() + 2 * M_PI;
    if ((behind - ring.angle[k]) / (2 * M_PI) > widest_gap) return {};
    ring.share.push_back((behind - before) / (4 * M_PI));
  }
  return ring;
}

std::optional<RoundBody> RoundBody::of_part(const AssembledScene& assembled, int number) {
  const scene::Part& part = assembled.scene.parts[number];
  const bool along_z = find_entry(assembled.scene.meshes, part.mesh)->type == scene::MeshType::cylinder;
  RoundBody body(part.position, turned_with(part, along_z ? Vec3{0, 0, 1} : Vec3{0, 1, 0}));
  const Eigen::Vector3d axis = vector(body.axis_).normalized();
  const Eigen::Vector3d across = axis.unitOrthogonal();
  body.frame_ << across, axis.cross(across), axis;

  const auto& range = assembled.assembly.parts[number];
  std::vector<Eigen::Vector3d> local;
  double reach = 0, total = 0;
  for (int n = range.first_node; n < range.first_node + range.node_count; ++n) {
    local.push_back(body.frame_.transpose() * (vector(assembled.assembly.nodes[n]) - vector(body.centre_)));
    reach = std::max(reach, local.back().head<2>().norm());
    total += assembled.mass[n];
  }
  double in_rings = 0;
  for (const auto& nodes : nodes_of_rings(local, same_place * reach, edges_of(assembled.assembly, range))) {
    std::optional<Ring> ring = ring_of(nodes, local, &assembled.mass[range.first_node]);
    if (!ring) continue;
    for (int& n : ring->nodes) n += range.first_node;
    in_rings += ring->mass;
    body.most_orders_ = std::max(body.most_orders_, std::min(static_cast<int>(nodes.size()) / 2 - 1, highest_order));
    body.rings_.push_back(std::move(*ring));
  }
  if (in_rings < least_share * total) return {};
  std::sort(body.rings_.begin(), body.rings_.end(), [](const Ring& a, const Ring& b) { return a.radius < b.radius; });
  return body;
}

int RoundBody::circles(const std::vector<Complex>& amplitude) const {
  Complex square = 0;
  for (std::size_t r = 0; r < rings_.size(); ++r) square += rings_[r].mass * amplitude[r] * amplitude[r];
  const Complex turn = std::polar(1.0, -0.5 * std::arg(square));
  const double first = rings_.front().radius, width = (rings_.back().radius - first) / radius_steps;
  std::vector<double> sum(radius_steps, 0.0), mass(radius_steps, 0.0);
  for (std::size_t r = 0; r < rings_.size(); ++r) {
    const int step = std::clamp(static_cast<int>((rings_[r].radius - first) / width), 0, radius_steps - 1);
    sum[step] += rings_[r].mass * (turn * amplitude[r]).real();
    mass[step] += rings_[r].mass;
  }
  double largest = 0;
  for (int s = 0; s < radius_steps; ++s)
    if (mass[s] > 0) largest = std::max(largest, std::fabs(sum[s] /= mass[s]));
  int changes = 0;
  double sign = 0;
  for (int s = 0; s < radius_steps; ++s) {
    if (!(mass[s] > 0) || std::fabs(sum[s]) < least_swing * largest) continue;
    if (sign * sum[s] < 0) ++changes;
    sign = sum[s];
  }
  return changes;
}

RoundName RoundBody::name(const Eigen::VectorXd& motion) const {
  constexpr int directions = 3;  // radial, circumferential, axial
  const int orders = most_orders_ + 1;
  std::vector<std::vector<Complex>> amplitude(orders * directions, std::vector<Complex>(rings_.size()));
  for (std::size_t r = 0; r < rings_.size(); ++r) {
    const Ring& ring = rings_[r];
    const int own_orders = std::min<int>(orders, static_cast<int>(ring.nodes.size()) / 2);
    for (std::size_t k = 0; k < ring.nodes.size(); ++k) {
      const Eigen::Vector3d u = frame_.transpose() * motion.segment<3>(3 * ring.nodes[k]);
      const double c = std::cos(ring.angle[k]), s = std::sin(ring.angle[k]);
      const double along[directions] = {c * u[0] + s * u[1], c * u[1] - s * u[0], u[2]};
      const Complex step(c, -s);
      Complex wave = ring.share[k];
      for (int n = 0; n < own_orders; ++n, wave *= step)
        for (int d = 0; d < directions; ++d) amplitude[n * directions + d][r] += wave * along[d];
    }
  }
  std::vector<double> energy(orders * directions, 0.0);
  double total = 0;
  for (int i = 0; i < orders * directions; ++i) {
    for (std::size_t r = 0; r < rings_.size(); ++r) energy[i] += rings_[r].mass * std::norm(amplitude[i][r]);
    if (i >= directions) energy[i] *= 2;  // cos^2 and sin^2 have a mean of a half
    total += energy[i];
  }
  RoundName result;
  double most = -1;
  for (int n = 0; n < orders; ++n) {
    const double* e = &energy[n * directions];
    if (e[0] + e[1] + e[2] <= most) continue;
    most = e[0] + e[1] + e[2];
    result.diameters = n;
  }
  const double* e = &energy[result.diameters * directions];
  result.order_share = most / total;
  result.radial_share = e[0] / most;
  result.circumferential_share = e[1] / most;
  result.axial_share = e[2] / most;
  const int main = e[2] >= std::max(e[0], e[1]) ? 2 : e[0] >= e[1] ? 0 : 1;
  result.kind = main == 2   ? RoundName::Kind::axial
                : main == 0 ? RoundName::Kind::radial
                            : RoundName::Kind::circumferential;
  result.circles = circles(amplitude[result.diameters * directions + main]);
  return result;
}

}  // namespace railwave
