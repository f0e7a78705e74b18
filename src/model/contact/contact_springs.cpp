#include "model/contact/contact_springs.hpp"

#include <cmath>
#include <limits>

#include "mesh/hexahedron.hpp"
#include "mesh/vectors.hpp"
#include "model/contact/surface_rows.hpp"
#include "model/sets/point_search.hpp"

namespace railwave {
namespace {

/// How much faster than at present two surfaces may close within the horizon.
constexpr double closing_factor = 2;

/// What the master's surface is around each of its nodes.
struct MasterNodes {
  std::vector<Vec3> normal;
  std::vector<double> size;       ///< m, longest diagonal around the node
  std::vector<double> stiffness;  ///< N/m, largest
  std::vector<std::vector<int>> segments;
  double largest_size = 0;

  MasterNodes(const ContactPair& pair, const std::vector<Vec3>& position)
      : normal(position.size(), Vec3{}),
        size(position.size(), 0),
        stiffness(position.size(), 0),
        segments(position.size()) {
    for (std::size_t s = 0; s < pair.master_segments.size(); ++s) {
      const auto& corner = pair.master_segments[s];
      const Vec3 p = difference(position[corner[2]], position[corner[0]]),
                 q = difference(position[corner[3]], position[corner[1]]);
      const double diagonal = std::sqrt(std::fmax(dot(p, p), dot(q, q)));
      largest_size = std::fmax(largest_size, diagonal);
      for (int m : corner) {
        for (int i = 0; i < 3; ++i) {
          const int j = (i + 1) % 3, k = (i + 2) % 3;
          normal[m][i] += p[j] * q[k] - p[k] * q[j];
        }
        size[m] = std::fmax(size[m], diagonal);
        segments[m].push_back(static_cast<int>(s));
        stiffness[m] = std::fmax(stiffness[m], pair.segment_stiffness[s]);
      }
    }
    for (Vec3& n : normal) {
      const double length = std::sqrt(dot(n, n));
      if (length > 0)
        for (double& component : n) component /= length;
    }
  }
};

/// Where a place that is `away` from master node m lies on the segments around it, taken as parallelograms.
void place_on_segment(const ContactPair& pair, const std::vector<Vec3>& position, const std::vector<int>& segments,
                      int m, const Vec3& away, ContactSpring& spring) {
  double least = 1e300;
  for (int s : segments) {
    const auto& corner = pair.master_segments[s];
    int own = 0;
    while (corner[own] != m) ++own;
    const Vec3 p = difference(position[corner[(own + 1) % 4]], position[m]),
               q = difference(position[corner[(own + 3) % 4]], position[m]);
    const double pp = dot(p, p), pq = dot(p, q), qq = dot(q, q), ap = dot(away, p), aq = dot(away, q);
    const double determinant = pp * qq - pq * pq;
    const double a = (ap * qq - aq * pq) / determinant, b = (aq * pp - ap * pq) / determinant;
    const double inside_a = std::fmax(0.0, std::fmin(1.0, a)), inside_b = std::fmax(0.0, std::fmin(1.0, b));
    const double outside = std::fabs(a - inside_a) + std::fabs(b - inside_b);
    if (!(outside < least)) continue;
    least = outside;
    const double share[4] = {(1 - inside_a) * (1 - inside_b), inside_a * (1 - inside_b), inside_a * inside_b,
                             (1 - inside_a) * inside_b};
    for (int k = 0; k < 4; ++k) {
      spring.master_nodes[k] = pair.master_nodes[corner[(own + k) % 4]];
      spring.share[k] = share[k];
    }
  }
}

/// Of critical damping of the slave's mass and the segment's, which is felt most in its middle.
double damping_of(const std::vector<double>& mass, double share_of_critical, const ContactSpring& spring) {
  double heaviest = 0;
  for (int n : spring.master_nodes) heaviest = std::fmax(heaviest, mass[n]);
  const double inverse_mass = 1 / mass[spring.slave_node] + 0.25 / heaviest;
  return 2 * share_of_critical * std::sqrt(spring.stiffness / inverse_mass);
}

void add_pair(const AssembledScene& assembled, const ContactPair& pair, ContactOnNodes& sum) {
  std::vector<double> stiffness(assembled.mass.size(), 0), damping(assembled.mass.size(), 0);
  const auto put = [&](int n, double k, double springs) {
    stiffness[n] = std::fmax(stiffness[n], springs * k);
    damping[n] = std::fmax(damping[n], springs * 2 * pair.contact->damping * std::sqrt(k * assembled.mass[n]));
  };
  double stiffest = 0;
  for (double k : pair.segment_stiffness) stiffest = std::fmax(stiffest, pair.growth * k);
  for (int n : pair.slave_nodes) put(n, stiffest, 1);

  const auto area = [&](const std::array<int, 4>& facet, const std::vector<int>& nodes) {
    const auto x = [&](int k) { return assembled.assembly.nodes[nodes[facet[k]]]; };
    return facet_area(x(0), x(1), x(2), x(3));
  };
  double slave_area = std::numeric_limits<double>::infinity();
  for (const auto& facet : pair.slave_facets) slave_area = std::fmin(slave_area, area(facet, pair.slave_nodes));
  for (std::size_t s = 0; s < pair.master_segments.size(); ++s) {
    const double springs = std::fmax(1.0, area(pair.master_segments[s], pair.master_nodes) / slave_area);
    for (int m : pair.master_segments[s]) put(pair.master_nodes[m], pair.growth * pair.segment_stiffness[s], springs);
  }
  for (std::size_t n = 0; n < assembled.mass.size(); ++n) {
    sum.stiffness[n] += stiffness[n];
    sum.damping[n] += damping[n];
  }
}

}  // namespace

ContactOnNodes contact_on_nodes(const AssembledScene& assembled, const std::vector<ContactPair>& contacts) {
  ContactOnNodes sum{std::vector<double>(assembled.mass.size(), 0), std::vector<double>(assembled.mass.size(), 0)};
  for (const ContactPair& pair : contacts)
    if (pair.has_springs()) add_pair(assembled, pair, sum);
  return sum;
}

std::vector<ContactSpring> possible_contact_springs(const std::vector<double>& mass, const NodeArrays& nodes,
                                                    const ContactPair& pair, const ContactReach& within) {
  const double horizon = within.horizon;
  const Array<int*>&of_slaves = pair.arrays.slave_nodes, of_masters = pair.arrays.master_nodes;
  const auto slaves = rows_on_host(nodes.position, of_slaves),
             slave_velocities = rows_on_host(nodes.velocity, of_slaves);
  const auto masters = rows_on_host(nodes.position, of_masters),
             master_velocities = rows_on_host(nodes.velocity, of_masters);
  const MasterNodes around(pair, masters);
  const NearestPoint nearest(masters);
  double fastest_master = 0;
  for (const Vec3& v : master_velocities) fastest_master = std::fmax(fastest_master, std::sqrt(dot(v, v)));

  std::vector<char> near(slaves.size(), 0);
  if (within.near) {
    const auto entries = to_vector(pair.window.entries);
    for (int i = 0; i < pair.window.count; ++i) near[entries[i].slave] = entries[i].near != 0;
  }

  std::vector<int> nearest_master(slaves.size(), -1);
  on_host_threads(static_cast<int>(slaves.size()), [&](int s) {
    if (pair.on_both[s] != 0) return;
    const Vec3& v = slave_velocities[s];
    const double reach = 2 * around.largest_size + closing_factor * horizon * (std::sqrt(dot(v, v)) + fastest_master);
    nearest_master[s] = nearest.find(slaves[s], reach);
  });

  std::vector<ContactSpring> springs;
  const auto status = to_host(pair.arrays.status), tracked = to_host(pair.arrays.tracked);
  for (std::size_t s = 0; s < slaves.size(); ++s) {
    const int m = nearest_master[s];
    if (m < 0) continue;
    const Vec3 away = difference(slaves[s], masters[m]),
               relative = difference(slave_velocities[s], master_velocities[m]);
    const double gap = dot(away, around.normal[m]);
    const double aside = std::sqrt(std::fmax(0.0, dot(away, away) - gap * gap));
    const double closing = closing_factor * horizon * std::sqrt(dot(relative, relative));
    const bool may_touch =
        aside <= around.size[m] && gap <= within.share * around.size[m] + closing && gap >= -around.size[m];
    if (status(static_cast<int>(s)) == status_apart && !may_touch && !near[s]) continue;
    double stiffness = around.stiffness[m];
    // Of long segments that under the node need not have the nearest corner.
    if (within.near && tracked(static_cast<int>(s)) >= 0)
      stiffness = std::fmax(stiffness, pair.segment_stiffness[tracked(static_cast<int>(s))]);
    ContactSpring spring{
        static_cast<int>(s), pair.slave_nodes[s], pair.growth * stiffness, 0, around.normal[m], {}, {}};
    place_on_segment(pair, masters, around.segments[m], m, away, spring);
    spring.damping = damping_of(mass, pair.contact->damping, spring);
    springs.push_back(spring);
  }
  return springs;
}

}  // namespace railwave
