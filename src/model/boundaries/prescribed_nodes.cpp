#include "model/boundaries/prescribed_nodes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "case/error.hpp"
#include "case/perpendicular.hpp"
#include "mesh/vectors.hpp"
#include "model/assembled_scene.hpp"
#include "model/boundaries/ties.hpp"
#include "model/build_steps.hpp"
#include "model/checks/round_part.hpp"
#include "model/contact/contact_pair.hpp"
#include "model/host_copy.hpp"
#include "model/loads/load_model.hpp"
#include "model/nodal_state.hpp"

namespace railwave {
namespace {

/// Rodrigues' formula for a turn about a fixed axis; @param angle the rotation vector, rad
void turn_by(const Vec3& angle, double (&turn)[3][3]) {
  const double size = length(angle);
  const double half = std::sin(size / 2);
  // sin(a)/a and (1 - cos(a))/a^2, also for no turn at all
  const double first = size > 0 ? std::sin(size) / size : 1, second = size > 0 ? 2 * half * half / (size * size) : 0.5;
  const double across[3][3] = {{0, -angle[2], angle[1]}, {angle[2], 0, -angle[0]}, {-angle[1], angle[0], 0}};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      double square = 0;
      for (int k = 0; k < 3; ++k) square += across[i][k] * across[k][j];
      turn[i][j] = (i == j ? 1 : 0) + first * across[i][j] + second * square;
    }
}

/// Sum of d d^T over the prescribed directions d; exactly the unit matrix for all three.
void hold_directions(const scene::PrescribedMotion& motion, double (&held)[3][3]) {
  const bool all = motion.directions[0] && motion.directions[1] && motion.directions[2];
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      held[i][j] = all && i == j ? 1 : 0;
      for (int a = 0; a < 3 && !all; ++a)
        if (motion.directions[a]) held[i][j] += motion.axes[a][i] * motion.axes[a][j];
    }
}

/// A displacement that does not begin with 0 would move the set by a jump in the first step.
void refuse_jump(const scene::Scene& scene, const scene::PrescribedMotion& motion, const scene::Curve* curve) {
  if (curve == nullptr || curve_value(curve, 0) == 0) return;
  throw InputError(fmt::format(
      "{}:{}: [prescribed_motion.{}] displacement_curve: '{}' is {:g} at t = 0, so that '{}' would jump there; let it "
      "begin with 0",
      scene.path, motion.line, motion.name, motion.displacement_curve, curve_value(curve, 0), motion.target));
}

/// Two motions that prescribe the same component of a node's motion: the later one would win in silence.
void refuse_shared_directions(const AssembledScene& assembled) {
  std::map<int, std::vector<const scene::PrescribedMotion*>> of_node;
  for (const scene::PrescribedMotion& motion : assembled.scene.prescribed_motions)
    for (int n : find_node_set(assembled.scene, assembled.assembly, motion, "target", motion.target)) {
      for (const scene::PrescribedMotion* before : of_node[n])
        if (!perpendicular(*before, motion))
          throw InputError(fmt::format(
              "{}:{}: [prescribed_motion.{}]: the node of '{}' at {} is moved in the same directions by "
              "[prescribed_motion.{}] (line {}), whose '{}' has it too; leave it out of one of the two sets, or: {}",
              assembled.scene.path, motion.line, motion.name, motion.target, place_text(assembled.assembly.nodes[n]),
              before->name, before->line, before->target, perpendicular_advice));
      of_node[n].push_back(&motion);
    }
}

/// Finds sets that have nodes in common.
void join_alike(std::vector<PrescribedSet>& prescribed) {
  std::map<int, int> set_of_node;
  for (PrescribedSet& set : prescribed) {
    set.first_alike = set.number;
    for (int n : set.host_nodes) {
      const int before = prescribed[set_of_node.emplace(n, set.number).first->second].first_alike;
      const int first = std::min(before, set.first_alike), other = std::max(before, set.first_alike);
      for (PrescribedSet& one : prescribed)
        if (one.number <= set.number && one.first_alike == other) one.first_alike = first;
    }
  }
}

/// Finds what else acts on the nodes of sets. Loads, connectors and torques act on all nodes whose motion they read.
void find_acting(const std::vector<ContactPair>& contacts, const Ties& ties, const ExternalForces& external,
                 std::size_t nodes, std::vector<PrescribedSet>& prescribed) {
  std::vector<char> pushed(nodes, 0), loaded(nodes, 0);
  for (const ContactPair& pair : contacts)
    for (const auto* surface : {&pair.slave_nodes, &pair.master_nodes})
      for (int n : *surface) pushed[n] = pushed[n] != 0 || !pair.has_springs() ? 1 : 0;
  for (const LoadedRow& row : to_vector(external.loaded)) loaded[row.node] = 1;
  for (int n : ties.masters) loaded[n] = 1;
  std::vector<char> alike_pushed(prescribed.size(), 0);
  for (PrescribedSet& set : prescribed)
    for (int n : set.host_nodes) {
      set.loaded = set.loaded || loaded[n] != 0;
      if (pushed[n] != 0) alike_pushed[set.first_alike] = 1;
    }
  for (PrescribedSet& set : prescribed) set.pushed = alike_pushed[set.first_alike] != 0;
}

}  // namespace

void build_prescribed_motions(const AssembledScene& assembled, const std::vector<ContactPair>& contacts,
                              const Ties& ties, const NodalState& nodal, std::vector<PrescribedSet>& prescribed) {
  refuse_shared_directions(assembled);
  for (const scene::PrescribedMotion& motion : assembled.scene.prescribed_motions) {
    const auto& nodes = find_node_set(assembled.scene, assembled.assembly, motion, "target", motion.target);
    PrescribedSet set;
    set.number = static_cast<int>(prescribed.size());
    set.motion = &motion;
    set.curve = curve_of(assembled.scene, motion.curve);
    set.displacement_curve = curve_of(assembled.scene, motion.displacement_curve);
    refuse_jump(assembled.scene, motion, set.displacement_curve);
    hold_directions(motion, set.held);
    set.centre = centre_of_rotation(assembled, motion, nodes);
    set.nodes = to_device("nodes of prescribed motion", nodes);
    set.host_nodes = nodes;
    std::sort(set.host_nodes.begin(), set.host_nodes.end());
    set.work = Array<double*>("work of prescribed motion", nodes.size());
    prescribed.push_back(set);
  }
  if (prescribed.empty()) return;
  join_alike(prescribed);
  find_acting(contacts, ties, nodal.external, assembled.assembly.nodes.size(), prescribed);
}

RigidPlace place_at(const PrescribedSet& set, double time) {
  const double lasted = curve_integral(set.curve, time);
  const double moved = set.displacement_curve != nullptr ? curve_value(set.displacement_curve, time) : 0;
  RigidPlace place{};
  Vec3 angle{};
  for (int i = 0; i < 3; ++i) {
    place.centre[i] = set.centre[i];
    place.place[i] = set.centre[i] + lasted * set.motion->velocity[i] + moved * set.motion->displacement[i];
    angle[i] = lasted * set.motion->angular_velocity[i];
  }
  turn_by(angle, place.turn);
  return place;
}

namespace {

/// At a run's first instant there is no time before.
RigidRates rates_at(const NodalState& nodal, const PrescribedSet& set) {
  const double before = 1e-3 * nodal.velocity_lag;
  const CurveRates pace = curve_rates(set.curve, nodal.time, before);
  const CurveRates moved =
      set.displacement_curve == nullptr ? CurveRates{0, 0, 0} : curve_rates(set.displacement_curve, nodal.time, before);
  RigidRates rates{place_at(set, nodal.time), {}, {}, {}, {}};
  for (int i = 0; i < 3; ++i) {
    rates.velocity[i] = pace.value * set.motion->velocity[i] + moved.first * set.motion->displacement[i];
    rates.acceleration[i] = pace.first * set.motion->velocity[i] + moved.second * set.motion->displacement[i];
    rates.spin[i] = pace.value * set.motion->angular_velocity[i];
    rates.spin_rate[i] = pace.first * set.motion->angular_velocity[i];
  }
  return rates;
}

}  // namespace

PrescribedInstant prescribed_instant(const NodalState& nodal, const PrescribedSet& set) {
  PrescribedInstant instant{nodal.nodes, rates_at(nodal, set), {}, nodal.velocity_lag > 0};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) instant.held[i][j] = set.held[i][j];
  return instant;
}

PrescribedMotion prescribed_motion(const NodalState& nodal, const PrescribedSet& set, double step) {
  const NodalAcceleration acceleration = nodal.acceleration();
  PrescribedMotion motion{acceleration.force,
                          acceleration.gravity,
                          set.nodes,
                          set.work,
                          {place_at(set, nodal.time + step)},
                          nodal.velocity_lag,
                          step,
                          {}};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) motion.held[i][j] = set.held[i][j];
  return motion;
}

}  // namespace railwave
