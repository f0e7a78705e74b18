#include "model/contact/rolling.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "case/error.hpp"
#include "mesh/vectors.hpp"
#include "model/assembled_scene.hpp"
#include "model/build_steps.hpp"
#include "model/checks/round_part.hpp"

namespace railwave {
namespace {

constexpr double most_creepage = 0.05;

bool moves(const scene::InitialMotion& motion, const std::string& part) {
  return std::find(motion.parts.begin(), motion.parts.end(), part) != motion.parts.end();
}

[[noreturn]] void refuse(const scene::Scene& scene, const scene::InitialMotion& motion, const std::string& what) {
  throw InputError(fmt::format("{}:{}: [initial_motion.{}] rolling: {}", scene.path, motion.line, motion.name, what));
}

/// Where the parts lie undeformed.
Vec3 centre_of(const AssembledScene& assembled, const scene::InitialMotion& motion, const std::string& part) {
  if (motion.centre) return *motion.centre;
  if (const auto axis = carried_axis(assembled, motion)) return axis->point;
  const auto& nodes = motion.around.empty()
                          ? assembled.assembly.node_sets.at(part)
                          : find_node_set(assembled.scene, assembled.assembly, motion, "around", motion.around);
  return centre_of_mass(assembled, nodes);
}

/// Of a motion that rolls, its first round part; else the one that `around` or a set of which it names, if the angular
/// velocity is along its axis.
std::optional<RoundPart> part_turned_about_its_axis(const AssembledScene& assembled,
                                                    const scene::InitialMotion& motion) {
  if (motion.centre) return std::nullopt;
  if (motion.rolling) {
    for (const std::string& name : motion.parts)
      if (auto round = round_part(assembled, name)) return round;
    return std::nullopt;
  }
  auto round = round_part(assembled, part_of_name(motion.around));
  if (round && !turns_about(motion.angular_velocity, round->own_axis)) return std::nullopt;
  return round;
}

/// The angular velocity about its axis with which one part rolls, and from what it was found.
struct Rolling {
  RoundPart round;
  double spin = 0;  ///< rad/s
  bool touches = false;
};

/// The axis, unless another centre is asked for.
Vec3 centre_to_roll_about(const AssembledScene& assembled, const scene::InitialMotion& motion, const RoundPart& round) {
  const Vec3 centre = centre_of(assembled, motion, round.part->name);
  const double off = length(cross(difference(centre, round.origin), round.axis));
  constexpr double most = 0.02;
  if (motion.centre && off > most * round.nominal_radius)
    refuse(
        assembled.scene, motion,
        fmt::format(
            "the centre of the rotation is {:.4g} m off the axis of '{}'; leave centre out, or give angular_velocity",
            off, round.part->name));
  return centre;
}

/// Down, where nothing is known that the part rolls on.
Vec3 way_over_ground(const scene::Scene& scene, const scene::InitialMotion& motion, const RoundPart& round) {
  const Vec3& g = scene.gravity;
  Vec3 down = length(g) > 0 ? g : Vec3{0, 0, -1};
  const Vec3 along = cross(round.axis, down);
  if (length(along) < 1e-6 * length(down))
    refuse(scene, motion,
           fmt::format("the axis of '{}' points down and it has no contact, so that there is nothing to roll on; give "
                       "angular_velocity",
                       round.part->name));
  Vec3 unit = along;
  for (double& c : unit) c /= length(along);
  return unit;
}

Rolling rolling_of(const AssembledScene& assembled, const scene::InitialMotion& motion, const RoundPart& round) {
  Rolling rolling{round};
  const Vec3 centre = centre_to_roll_about(assembled, motion, round);
  std::vector<Touch> found = touches(assembled, round);
  found.erase(
      std::remove_if(found.begin(), found.end(), [&](const Touch& touch) { return moves(motion, touch.other); }),
      found.end());
  double least = found.empty() ? 0 : found.front().gap;
  for (const Touch& touch : found) least = std::min(least, touch.gap);
  // A second rail behind a gap, say, is farther away than the one that the wheel stands on.
  const double near = least + 1e-3 * round.nominal_radius;
  double speed = 0, radius = 0;
  int count = 0;
  for (const Touch& touch : found) {
    if (touch.gap > near) continue;
    for (const scene::InitialMotion& other : assembled.scene.initial_motions)
      if (other.rolling && moves(other, touch.other))
        refuse(assembled.scene, motion,
               fmt::format(
                   "'{}' rolls on '{}', which [initial_motion.{}] lets roll too; give one of them angular_velocity",
                   round.part->name, touch.other, other.name));
    speed += dot(difference(initial_velocity(assembled, touch.other, touch.place), motion.velocity), touch.along);
    // About a centre beside the axis the place goes the faster the farther it is from that.
    radius += touch.radius + dot(cross(round.axis, difference(round.origin, centre)), touch.along);
    ++count;
  }
  rolling.touches = count > 0;
  if (count == 0) {
    speed = -dot(motion.velocity, way_over_ground(assembled.scene, motion, round));
    radius = round.nominal_radius;
    count = 1;
  }
  rolling.spin = speed / count / motion.rolling_radius.value_or(radius / count);
  return rolling;
}

/// Of parts whose shape is not known: about the horizontal across the velocity, less by the angle between velocity and
/// wheel.
void roll_unknown_shape(const scene::Scene& scene, scene::InitialMotion& motion) {
  std::string part;
  double cosine = 1;
  for (const scene::Part& one : scene.parts)
    if (moves(motion, one.name)) {
      part = one.name;
      cosine = std::cos(one.angle_of_attack);
    }
  if (part.empty()) refuse(scene, motion, "only parts roll, not points; name a part, or leave rolling out");
  if (!motion.rolling_radius)
    refuse(scene, motion,
           fmt::format("'{}' is no wheel, wheelset, roller or cylinder, so that no radius is known; if it is round "
                       "give rolling_radius, else leave rolling out",
                       part));
  const Vec3 across = cross({0, 0, 1}, motion.velocity);
  if (!(length(across) > 0))
    refuse(scene, motion, "the velocity has no horizontal part, so that nothing rolls; give one");
  for (int i = 0; i < 3; ++i) motion.angular_velocity[i] = cosine * across[i] / *motion.rolling_radius;
}

void resolve(const AssembledScene& assembled, scene::InitialMotion& motion) {
  std::vector<Rolling> all;
  for (const std::string& name : motion.parts)
    if (const auto round = round_part(assembled, name)) all.push_back(rolling_of(assembled, motion, *round));
  if (all.empty()) return roll_unknown_shape(assembled.scene, motion);
  // One that touches knows better than one that hangs in the air.
  std::stable_partition(all.begin(), all.end(), [](const Rolling& one) { return one.touches; });
  const Rolling& first = all.front();
  if (first.spin == 0 || !std::isfinite(first.spin))
    refuse(assembled.scene, motion,
           fmt::format("neither its velocity nor an initial motion of what it touches makes '{}' roll; give a velocity "
                       "across its axle",
                       first.round.part->name));
  for (const Rolling& other : all) {
    if (other.touches != first.touches) continue;
    const Vec3 unlike = difference(
        Vec3{other.spin * other.round.axis[0], other.spin * other.round.axis[1], other.spin * other.round.axis[2]},
        Vec3{first.spin * first.round.axis[0], first.spin * first.round.axis[1], first.spin * first.round.axis[2]});
    if (length(unlike) > 5e-3 * std::fabs(first.spin))
      refuse(assembled.scene, motion,
             fmt::format("'{}' rolls at {:.6g} rad/s, '{}' at {:.6g} rad/s; give each an initial motion of its own",
                         first.round.part->name, first.spin, other.round.part->name, other.spin));
  }
  for (int i = 0; i < 3; ++i) motion.angular_velocity[i] = first.spin * first.round.own_axis[i];
}

}  // namespace

std::optional<CarriedAxis> carried_axis(const AssembledScene& assembled, const scene::InitialMotion& motion) {
  const auto round = part_turned_about_its_axis(assembled, motion);
  if (!round) return std::nullopt;
  CarriedAxis axis;
  axis.point = round->origin;
  axis.nodes = motion.around.empty()
                   ? &assembled.assembly.node_sets.at(round->part->name)
                   : &find_node_set(assembled.scene, assembled.assembly, motion, "around", motion.around);
  const Vec3 mean = centre_of_mass(assembled, *axis.nodes);
  axis.from_mean = difference(axis.point, mean);
  return axis;
}

void resolve_rolling(AssembledScene& assembled) {
  for (scene::InitialMotion& motion : assembled.scene.initial_motions)
    if (motion.rolling) resolve(assembled, motion);
}

Vec3 initial_velocity(const AssembledScene& assembled, const std::string& part, const Vec3& place) {
  Vec3 velocity{0, 0, 0};
  for (const scene::InitialMotion& motion : assembled.scene.initial_motions) {
    if (!moves(motion, part)) continue;
    const Vec3 w = turned_with_part_of(assembled.scene, part, motion.angular_velocity);
    velocity = sum(velocity, sum(motion.velocity, cross(w, difference(place, centre_of(assembled, motion, part)))));
  }
  return velocity;
}

std::vector<std::string> rolling_doubts(const AssembledScene& assembled) {
  std::vector<std::string> doubts;
  if (assembled.scene.initial_motions.empty()) return doubts;
  for (const scene::Part& part : assembled.scene.parts) {
    const auto round = round_part(assembled, part.name);
    if (!round) continue;
    for (const Touch& touch : touches(assembled, *round)) {
      if (touch.contact->friction == 0) continue;
      Vec3 on_axis = touch.place;  // where the axis is abreast of the contact
      const Vec3 arm = difference(touch.place, round->origin);
      for (int i = 0; i < 3; ++i) on_axis[i] = round->origin[i] + dot(arm, round->axis) * round->axis[i];
      const Vec3 under = initial_velocity(assembled, touch.other, touch.place),
                 centre = initial_velocity(assembled, part.name, on_axis);
      const double travel = dot(difference(under, centre), touch.along);
      const double slip = -dot(difference(under, initial_velocity(assembled, part.name, touch.place)), touch.along);
      const double turning = slip + travel, fastest = std::max(std::fabs(travel), std::fabs(turning));
      // A body that falls, say, neither travels nor turns but for rounding.
      if (!(std::fabs(slip) > most_creepage * fastest) || fastest < 1e-3 * std::max(length(centre), length(under)))
        continue;
      const auto own = std::find_if(assembled.scene.initial_motions.begin(), assembled.scene.initial_motions.end(),
                                    [&](const auto& motion) { return moves(motion, part.name); });
      const std::string mend =
          own == assembled.scene.initial_motions.end()
              ? fmt::format("give '{}' an [initial_motion] with rolling = true", part.name)
              : fmt::format("write rolling = true in place of angular_velocity in [initial_motion.{}] (line {})",
                            own->name, own->line);
      doubts.push_back(fmt::format(
          "[contacts.{}] (line {}): '{}' travels at {:.4g} m/s over '{}' but turns at {:.4g} rad/s, which is {:.4g} "
          "m/s at its radius of {:.5g} m: it begins "
          "by sliding at {:.4g} m/s, a creepage of {:.3g} %; it rolls at {:.6g} rad/s: {}, unless it is meant to slide",
          touch.contact->name, touch.contact->line, part.name, std::fabs(travel), touch.other,
          std::fabs(turning / touch.radius), std::fabs(turning), touch.radius, std::fabs(slip),
          100 * std::fabs(slip) / fastest, std::fabs(travel / touch.radius), mend));
    }
  }
  return doubts;
}

}  // namespace railwave
