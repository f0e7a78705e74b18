#include "model/checks/outside.hpp"

#include <algorithm>

#include "mesh/vectors.hpp"

namespace railwave {

OutsideFaces::OutsideFaces(const Assembly& assembly) : assembly_(assembly) {
  const auto sorted = [&](const Face& face) {
    auto nodes = assembly.face_nodes(face);
    std::sort(nodes.begin(), nodes.end());
    return nodes;
  };
  for (const auto& [name, surface] : assembly.surfaces)
    for (const Face& face : surface) owners_[sorted(face)] = 0;
  const int elements = owners_.empty() ? 0 : static_cast<int>(assembly.elements.size());
  std::vector<char> named(assembly.nodes.size(), 0);
  for (const auto& entry : owners_)
    for (int n : entry.first) named[n] = 1;
  for (int e = 0; e < elements; ++e)
    for (int side = 0; side < 6; ++side) {
      const Face face{e, side};
      const auto nodes = assembly.face_nodes(face);
      if (!std::all_of(nodes.begin(), nodes.end(), [&](int n) { return named[n] != 0; })) continue;
      const auto found = owners_.find(sorted(face));
      if (found != owners_.end()) ++found->second;
    }
}

bool OutsideFaces::has(const Face& face) const {
  auto nodes = assembly_.face_nodes(face);
  std::sort(nodes.begin(), nodes.end());
  const auto found = owners_.find(nodes);
  return found == owners_.end() || found->second < 2;
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

}  // namespace railwave
