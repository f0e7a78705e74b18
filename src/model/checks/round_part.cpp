#include "model/checks/round_part.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "mesh/vectors.hpp"

namespace railwave {
namespace {

constexpr double nowhere = std::numeric_limits<double>::infinity();

/// How far from the axis a body of revolution reaches at each place along it.
class Profile {
 public:
  Profile(const Assembly& assembly, const RoundPart& round, const std::vector<Face>& surface) : round_(round) {
    constexpr double same = 1e-7;  // m: nodes of one circle
    std::vector<std::array<double, 2>> all;
    for (int n : surface_nodes(assembly, surface)) all.push_back(seen(assembly.nodes[n]));
    std::sort(all.begin(), all.end());
    for (const auto& [along, radius] : all) {
      if (points_.empty() || along > points_.back()[0] + same)
        points_.push_back({along, radius});
      else
        points_.back()[1] = std::max(points_.back()[1], radius);
    }
  }

  /// Place along the axis, distance from it.
  std::array<double, 2> seen(const Vec3& x) const {
    const Vec3 arm = difference(x, round_.origin);
    const double along = dot(arm, round_.axis);
    return {along, std::sqrt(std::max(0.0, dot(arm, arm) - along * along))};
  }

  /// Radius there; none beside the surface.
  double radius(double along) const {
    if (points_.size() < 2 || along < points_.front()[0] || along > points_.back()[0]) return nowhere;
    const auto behind = std::max(points_.begin() + 1,
                                 std::lower_bound(points_.begin(), points_.end(), std::array<double, 2>{along, 0}));
    const auto& [a, b] = std::pair{*(behind - 1), *behind};
    return a[1] + (along - a[0]) / (b[0] - a[0]) * (b[1] - a[1]);
  }

  double gap(const Vec3& x) const {
    const auto [along, distance] = seen(x);
    const double own = radius(along);
    return own < nowhere ? distance - own : nowhere;
  }

 private:
  const RoundPart& round_;
  std::vector<std::array<double, 2>> points_;  ///< ascending
};

Vec3 place_on(const std::array<Vec3, 4>& corner, double xi, double eta) {
  const double weight[4] = {0.25 * (1 - xi) * (1 - eta), 0.25 * (1 + xi) * (1 - eta), 0.25 * (1 + xi) * (1 + eta),
                            0.25 * (1 - xi) * (1 + eta)};
  Vec3 x{0, 0, 0};
  for (int k = 0; k < 4; ++k)
    for (int i = 0; i < 3; ++i) x[i] += weight[k] * corner[k][i];
  return x;
}

struct NearestFace {
  double gap = nowhere;
  Vec3 place{0, 0, 0};
};

/// The face's place nearest to the profile: the best of a grid, then by steps that are halved.
NearestFace nearest_on(const Profile& profile, const std::array<Vec3, 4>& corner) {
  constexpr int grid = 8, halvings = 24;
  double best[2] = {0, 0};
  NearestFace nearest;
  const auto consider = [&](double xi, double eta) {
    const Vec3 x = place_on(corner, xi, eta);
    const double gap = profile.gap(x);
    if (!(gap < nearest.gap)) return false;
    nearest = {gap, x};
    best[0] = xi;
    best[1] = eta;
    return true;
  };
  for (int i = 0; i <= grid; ++i)
    for (int j = 0; j <= grid; ++j) consider(2.0 * i / grid - 1, 2.0 * j / grid - 1);
  double step = 1.0 / grid;
  for (int halving = 0; halving < halvings;) {
    bool nearer = false;
    const double from[2] = {best[0], best[1]};
    for (int i = -1; i <= 1; ++i)
      for (int j = -1; j <= 1; ++j)
        nearer =
            consider(std::clamp(from[0] + i * step, -1.0, 1.0), std::clamp(from[1] + j * step, -1.0, 1.0)) || nearer;
    if (nearer) continue;
    step /= 2;
    ++halving;
  }
  return nearest;
}

NearestFace nearest_of(const Assembly& assembly, const Profile& profile, const std::vector<Face>& surface) {
  std::vector<std::array<Vec3, 4>> faces;
  std::vector<double> at_least;  // m, the gap that a face may have
  double least = nowhere;
  for (const Face& face : surface) {
    const auto node = assembly.face_nodes(face);
    std::array<Vec3, 4> corner;
    for (int k = 0; k < 4; ++k) corner[k] = assembly.nodes[node[k]];
    const double size = std::max(length(difference(corner[0], corner[2])), length(difference(corner[1], corner[3])));
    double gap = profile.gap(place_on(corner, 0, 0));
    for (const Vec3& x : corner) gap = std::min(gap, profile.gap(x));
    least = std::min(least, gap);
    faces.push_back(corner);
    // A face across the profile's edge has no gap at corners and middle.
    at_least.push_back(gap < nowhere ? gap - 0.5 * size : -nowhere);
  }
  NearestFace nearest;
  for (std::size_t f = 0; f < faces.size(); ++f) {
    if (at_least[f] > std::min(least, nearest.gap)) continue;
    const NearestFace here = nearest_on(profile, faces[f]);
    if (here.gap < nearest.gap) nearest = here;
  }
  return nearest;
}

}  // namespace

bool turns_about(const Vec3& angular_velocity, const Vec3& axis) {
  constexpr double along = 1e-6;
  return length(angular_velocity) > 0 && length(cross(angular_velocity, axis)) <= along * length(angular_velocity);
}

Vec3 centre_of_rotation(const AssembledScene& assembled, const scene::PrescribedMotion& motion,
                        const std::vector<int>& nodes) {
  if (motion.centre) return *motion.centre;
  const auto round = round_part(assembled, part_of_name(motion.target));
  return round && turns_about(motion.angular_velocity, round->axis) ? round->origin : centre_of_mass(assembled, nodes);
}

std::optional<RoundPart> round_part(const AssembledScene& assembled, const std::string& name) {
  const scene::Scene& scene = assembled.scene;
  for (std::size_t p = 0; p < scene.parts.size(); ++p) {
    const scene::Part& part = scene.parts[p];
    if (part.name != name) continue;
    RoundPart round;
    for (const scene::MeshSource& mesh : scene.meshes) {
      if (mesh.name != part.mesh) continue;
      if (mesh.type == scene::MeshType::wheel) round.nominal_radius = mesh.wheel.radius;
      if (mesh.type == scene::MeshType::wheelset) round.nominal_radius = mesh.wheelset.radius;
      if (mesh.type == scene::MeshType::roller) round.nominal_radius = mesh.roller.radius;
      if (mesh.type == scene::MeshType::cylinder) {
        round.nominal_radius = mesh.cylinder.radius;
        round.own_axis = {0, 0, 1};
      }
    }
    if (!(round.nominal_radius > 0)) return std::nullopt;
    round.part = &part;
    round.origin = assembled.assembly.parts[p].origin;
    round.axis = turned_with(part, round.own_axis);
    return round;
  }
  return std::nullopt;
}

namespace {

/// Where the part is nearest to the other surface of a contact, or to one of its masters; none: it is no part of the
/// pair, or far off.
std::optional<Touch> touch_of(const AssembledScene& assembled, const RoundPart& round, const scene::Contact& contact,
                              const std::string& master_name) {
  const std::string slave = part_of_name(contact.slave), master = part_of_name(master_name);
  const std::string& own = round.part->name;
  if ((slave == own) == (master == own)) return std::nullopt;
  const auto& slaves = find_surface(assembled.scene, assembled.assembly, contact, "slave", contact.slave);
  const auto& masters = find_surface(assembled.scene, assembled.assembly, contact, "master", master_name);
  const Profile profile(assembled.assembly, round, slave == own ? slaves : masters);
  const NearestFace nearest = nearest_of(assembled.assembly, profile, slave == own ? masters : slaves);
  if (!(nearest.gap < round.nominal_radius)) return std::nullopt;
  const auto [along, distance] = profile.seen(nearest.place);
  if (!(distance > 0)) return std::nullopt;
  Touch touch{&contact, slave == own ? master : slave, nearest.place, {0, 0, 0}, profile.radius(along), nearest.gap};
  touch.along = cross(round.axis, difference(nearest.place, round.origin));
  for (double& c : touch.along) c /= distance;
  return touch;
}

}  // namespace

std::vector<Touch> touches(const AssembledScene& assembled, const RoundPart& round) {
  std::vector<Touch> found;
  for (const scene::Contact& contact : assembled.scene.contacts) {
    // Of several masters the one that is nearest: the next rail along the track is not what the wheel stands on.
    std::optional<Touch> best;
    for (const std::string& name : contact.master)
      if (const auto touch = touch_of(assembled, round, contact, name); touch && (!best || touch->gap < best->gap))
        best = touch;
    if (best) found.push_back(*best);
  }
  return found;
}

}  // namespace railwave
