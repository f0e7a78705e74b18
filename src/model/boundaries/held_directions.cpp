#include "model/boundaries/held_directions.hpp"

#include "mesh/vectors.hpp"

namespace railwave {

void add_direction(HeldDirections& directions, scene::Vec3 d) {
  for (const scene::Vec3& known : directions) {
    const double along = dot(d, known);
    for (int i = 0; i < 3; ++i) d[i] -= along * known[i];
  }
  const double size = length(d);
  if (size < 1e-9) return;
  for (double& component : d) component /= size;
  directions.push_back(d);
}

void hold(HeldDirections& directions) {
  for (int i = 0; i < 3; ++i) add_direction(directions, {i == 0 ? 1.0 : 0.0, i == 1 ? 1.0 : 0.0, i == 2 ? 1.0 : 0.0});
}

std::map<int, HeldDirections> held_directions(const scene::Scene& scene, const Assembly& assembly) {
  std::map<int, HeldDirections> held;
  for (const scene::Constraint& constraint : scene.constraints)
    for (int n : find_node_set(scene, assembly, constraint, "target", constraint.target))
      for (int a = 0; a < 3; ++a)
        if (constraint.fixed[a]) add_direction(held[n], constraint.axes[a]);
  for (const scene::PrescribedMotion& motion : scene.prescribed_motions)
    for (int n : find_node_set(scene, assembly, motion, "target", motion.target))
      for (int a = 0; a < 3; ++a)
        if (motion.directions[a]) add_direction(held[n], motion.axes[a]);
  return held;
}

bool force_is_held(const std::map<int, HeldDirections>& held, int node, const Vec3& force) {
  const auto found = held.find(node);
  if (found == held.end()) return false;
  Vec3 rest = force;
  for (const Vec3& d : found->second)
    for (int i = 0; i < 3; ++i) rest[i] -= dot(force, d) * d[i];
  return length(rest) <= 1e-9 * length(force);
}

bool wholly_held(const std::map<int, HeldDirections>& held, int node) {
  const auto found = held.find(node);
  return found != held.end() && found->second.size() >= 3;
}

Array<double* [3][3]> projections(const std::map<int, HeldDirections>& held, std::vector<int>& row_of_node) {
  std::map<HeldDirections, int> rows;
  for (const auto& [node, directions] : held) {
    const auto inserted = rows.try_emplace(directions, static_cast<int>(rows.size()));
    row_of_node[node] = inserted.first->second;
  }
  const auto table = unset_array<double* [3][3]>("constraints", rows.size());
  const auto host = Kokkos::create_mirror_view(table);
  for (const auto& [directions, row_number] : rows)
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) {
        // Three independent directions leave nothing; written out so that no rounding remains.
        double p = directions.size() == 3 ? 0.0 : i == j ? 1.0 : 0.0;
        if (directions.size() < 3)
          for (const scene::Vec3& d : directions) p -= d[i] * d[j];
        host(row_number, i, j) = p;
      }
  Kokkos::deep_copy(table, host);
  return table;
}

}  // namespace railwave
