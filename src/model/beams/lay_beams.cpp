#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "case/error.hpp"
#include "mesh/vectors.hpp"
#include "model/beams/beams.hpp"

namespace railwave {
namespace {

/// A direction without its part along a unit vector, of length 1; the length that it had.
std::pair<Vec3, double> across(const Vec3& direction, const Vec3& unit) {
  Vec3 rest = direction;
  const double along = dot(direction, unit);
  for (int i = 0; i < 3; ++i) rest[i] -= along * unit[i];
  const double size = length(rest);
  if (size > 0)
    for (double& r : rest) r /= size;
  return {rest, size};
}

/// The global axis most across a direction.
Vec3 axis_across(const Vec3& direction) {
  int least = 0;
  for (int i = 1; i < 3; ++i)
    if (std::fabs(direction[i]) < std::fabs(direction[least]) - 1e-9 * length(direction)) least = i;
  Vec3 axis{0, 0, 0};
  axis[least] = 1;
  return axis;
}

[[noreturn]] void complain(const scene::Scene& scene, const scene::Beam& beam, const std::string& text) {
  throw InputError(fmt::format("{}:{}: [beams.{}] {}", scene.path, beam.line, beam.name, text));
}

/// Nodes of `to` that are nearest to `count` places evenly around `from`, on a circle as wide as the set in the mean,
/// in the plane through `from` normal to the beams' orientation (the plane S of thesis fig. 3.8).
std::vector<int> spread(const scene::Scene& scene, const Assembly& assembly, const scene::Beam& beam, int from,
                        const std::vector<int>& nodes, int count) {
  if (!beam.orientation)
    complain(scene, beam,
             "count: needs `orientation`, the normal of the plane in which the beams are spread, to choose among the " +
                 fmt::format("{} nodes of '{}'", nodes.size(), beam.to));
  const auto [normal, size] = across(*beam.orientation, {0, 0, 0});
  double radius = 0;
  for (int n : nodes)
    radius +=
        across(difference(assembly.nodes[n], assembly.nodes[from]), normal).second / static_cast<double>(nodes.size());
  const Vec3 first = across(axis_across(normal), normal).first, second = cross(normal, first);
  std::vector<int> chosen;
  for (int k = 0; k < count; ++k) {
    const double angle = 2 * M_PI * k / count;
    int best = -1;
    double least = std::numeric_limits<double>::infinity();
    for (int n : nodes) {
      Vec3 off = difference(assembly.nodes[n], assembly.nodes[from]);
      for (int i = 0; i < 3; ++i) off[i] -= radius * (std::cos(angle) * first[i] + std::sin(angle) * second[i]);
      if (length(off) < (1 - 1e-9) * least) {
        least = length(off);
        best = n;
      }
    }
    if (std::find(chosen.begin(), chosen.end(), best) != chosen.end())
      complain(scene, beam,
               fmt::format("count: is {}, but '{}' has not so many nodes around the plane normal to orientation; "
                           "lower it, or turn the orientation",
                           count, beam.to));
    chosen.push_back(best);
  }
  return chosen;
}

std::vector<int> far_ends(const scene::Scene& scene, const Assembly& assembly, const scene::Beam& beam, int from) {
  const auto& nodes = find_node_set(scene, assembly, beam, "to", beam.to);
  const int size = static_cast<int>(nodes.size()), count = beam.count.value_or(size);
  if (count > size)
    complain(
        scene, beam,
        fmt::format("count: is {}, but '{}' has only {} node{}; lower it", count, beam.to, size, size == 1 ? "" : "s"));
  return count == size ? nodes : spread(scene, assembly, beam, from, nodes, count);
}

}  // namespace

std::array<Vec3, 3> beam_axes(const scene::Scene& scene, const scene::Beam& beam, const Vec3& from, const Vec3& to) {
  Vec3 along = difference(to, from);
  const double distance = length(along);
  if (!(distance > 0))
    complain(scene, beam, fmt::format("from '{}' to '{}' is no distance; move one of them", beam.from, beam.to));
  for (double& a : along) a /= distance;
  const auto [height, size] = across(beam.orientation ? *beam.orientation : axis_across(along), along);
  if (!(size > 1e-6)) complain(scene, beam, "orientation: lies along the beam; give a direction across it");
  return {along, cross(height, along), height};
}

void lay_beams(const scene::Scene& scene, Assembly& assembly) {
  for (std::size_t b = 0; b < scene.beams.size(); ++b) {
    const scene::Beam& beam = scene.beams[b];
    const auto& begin = find_node_set(scene, assembly, beam, "from", beam.from);
    if (begin.size() != 1)
      complain(scene, beam,
               fmt::format("from: '{}' has {} nodes, must be a point or a set of one node; several may be at `to`",
                           beam.from, begin.size()));
    const int from = begin.front(), first = static_cast<int>(assembly.nodes.size());
    for (int to : far_ends(scene, assembly, beam, from)) {
      const Vec3 a = assembly.nodes[from], z = assembly.nodes[to];
      beam_axes(scene, beam, a, z);
      Assembly::BeamChain chain{static_cast<int>(b), {from}};
      for (int k = 1; k < beam.divisions; ++k) {
        const double share = static_cast<double>(k) / beam.divisions;
        chain.nodes.push_back(static_cast<int>(assembly.nodes.size()));
        assembly.nodes.push_back(
            {a[0] + share * (z[0] - a[0]), a[1] + share * (z[1] - a[1]), a[2] + share * (z[2] - a[2])});
      }
      chain.nodes.push_back(to);
      assembly.beam_chains.push_back(chain);
    }
    assembly.beam_nodes.push_back({first, static_cast<int>(assembly.nodes.size()) - first});
  }
}

}  // namespace railwave
