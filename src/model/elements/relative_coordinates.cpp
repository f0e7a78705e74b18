#include "model/elements/relative_coordinates.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "kernels/support/flush_denormals.hpp"
#include "kernels/support/set_zero.hpp"
#include "model/build_steps.hpp"
#include "model/host_copy.hpp"

namespace railwave {
namespace {

using Rows = Array<double* [3]>::HostMirror;
using Eigen::Matrix3d;
using Eigen::Vector3d;

Vector3d row_of(const Rows& rows, int n) { return {rows(n, 0), rows(n, 1), rows(n, 2)}; }

/// Linear and angular momentum give the motion. A body without extent in two directions does not turn.
FrameMotion best_motion(const std::vector<double>& mass, const Rows& position, const Rows& velocity,
                        const RelativeNodes::Range& range) {
  Vector3d centre = Vector3d::Zero(), mean = Vector3d::Zero();
  double total = 0;
  for (int n = range.first; n < range.first + range.count; ++n) {
    total += mass[n];
    centre += mass[n] * row_of(position, n);
    mean += mass[n] * row_of(velocity, n);
  }
  centre /= total;
  mean /= total;
  Matrix3d inertia = Matrix3d::Zero();
  Vector3d momentum = Vector3d::Zero();
  for (int n = range.first; n < range.first + range.count; ++n) {
    const Vector3d arm = row_of(position, n) - centre;
    inertia += mass[n] * (arm.squaredNorm() * Matrix3d::Identity() - arm * arm.transpose());
    momentum += mass[n] * arm.cross(row_of(velocity, n) - mean);
  }
  FrameMotion motion;
  for (int i = 0; i < 3; ++i) {
    motion.centre[i] = centre[i];
    motion.velocity[i] = mean[i];
  }
  if (!(inertia.determinant() > 1e-12 * std::pow(inertia.trace(), 3))) return motion;
  const Vector3d turning = inertia.ldlt().solve(momentum);
  motion.speed = turning.norm();
  if (motion.speed > 0)
    for (int i = 0; i < 3; ++i) motion.axis[i] = turning[i] / motion.speed;
  return motion;
}

int frame_of(const RelativeNodes& relative, int node) {
  const auto after = std::upper_bound(relative.range.begin(), relative.range.end(), node,
                                      [](int n, const RelativeNodes::Range& range) { return n < range.first; });
  return static_cast<int>(after - relative.range.begin()) - 1;
}

FrameArm arm_of(const Rows& reference, const RelativeNodes& relative, int node) {
  FrameArm arm;
  arm.frame = frame_of(relative, node);
  const Vector3& centre = relative.host_motion[arm.frame].centre;
  for (int i = 0; i < 3; ++i) arm.x[i] = static_cast<float>(reference(node, i) - centre[i]);
  return arm;
}

/// The first corner of each block's first element.
std::vector<int> points_of(const Assembly& assembly, const ElementGroup& group) {
  std::vector<int> points;
  for (int first : group.first_element) points.push_back(assembly.elements[first][0]);
  return points;
}

/// Reference places of a group's nodes relative to each block's point. @param rank whose blocks; -1: all
Array<float*> local_places(const Assembly& assembly, const ElementGroup& group, int rank) {
  const ElementBlocks& blocks = group.blocks;
  const auto number = to_host(blocks.node);
  const auto device = unset_array<float*>("local places", 3 * number.extent(0));
  set_zero(device);
  const auto local = to_host(device);
  for (int p = 0; p < blocks.count; ++p) {
    if (rank >= 0 && group.owner[p] != rank) continue;
    const Vec3& point = assembly.nodes[group.relative.point[p]];
    for (int l = 0; l < blocks.node_stride; ++l) {
      const int n = number(static_cast<std::size_t>(p) * blocks.node_stride + l) & ~advance_bit;
      for (int i = 0; i < 3; ++i)
        local((3 * static_cast<std::size_t>(p) + i) * blocks.node_stride + l) =
            static_cast<float>(assembly.nodes[n][i] - point[i]);
    }
  }
  Kokkos::deep_copy(device, local);
  return device;
}

/// Calls act(frame, its nodes, how many) for each frame: with the nodes that this process makes coordinates of.
template <class Act>
void each_frame(const NodalState& nodal, const Act& act) {
  const RelativeNodes& relative = nodal.relative;
  const bool all = relative.own.empty();
  for (std::size_t c = 0; c < relative.range.size(); ++c) {
    const RelativeNodes::Range& range = all ? relative.range[c] : relative.own[c];
    act(relative.host_motion[c], FrameNodes{range.first, all ? Array<int*>() : nodal.own_nodes}, range.count);
  }
}

}  // namespace

void build_relative_nodes(const AssembledScene& assembled, int rank, std::vector<ElementGroup>& groups, Ties& ties,
                          NodalState& nodal) {
  if (assembled.scene.solver.precision != scene::Precision::single_precision) return;
  RelativeNodes& relative = nodal.relative;
  for (const auto& part : assembled.assembly.parts) relative.range.push_back({part.first_node, part.node_count});
  for (int n : assembled.assembly.point_nodes) relative.range.push_back({n, 1});
  for (const auto& [first, count] : assembled.assembly.beam_nodes)
    if (count > 0) relative.range.push_back({first, count});
  relative.node = unset_array<RelativeNode*>("relative nodes", nodal.nodes.count);
  relative.shared_arm = unset_array<FrameArm*>("arms of shared nodes", nodal.shared.nodes.extent(0));
  relative.motion = unset_array<FrameMotion*>("co-rotating frames", relative.range.size());
  relative.steps = unset_array<FrameStep*>("steps of frames", steps_of_block * relative.range.size());
  std::vector<int> of_slave;
  for (const TiedPlace& tied : ties.places) of_slave.push_back(frame_of(relative, tied.slave));
  ties.frame = to_device("frames of tied nodes", of_slave);
  for (ElementGroup& group : groups) {
    group.relative.point = points_of(assembled.assembly, group);
    group.relative.local = local_places(assembled.assembly, group, rank);
    group.relative.arm = unset_array<FrameArm*>("arms of blocks", group.blocks.count);
  }
}

void find_frames(const AssembledScene& assembled, NodalState& nodal) {
  flush_denormals();
  RelativeNodes& relative = nodal.relative;
  const Rows position = to_host(nodal.nodes.position), velocity = to_host(nodal.nodes.velocity);
  relative.host_motion.clear();
  for (const RelativeNodes::Range& range : relative.range)
    relative.host_motion.push_back(best_motion(assembled.mass, position, velocity, range));
}

void place_frames(const std::vector<ElementGroup>& groups, const NodalState& nodal) {
  flush_denormals();
  const RelativeNodes& relative = nodal.relative;
  const Rows reference = to_host(nodal.nodes.reference);
  const auto motion = Kokkos::create_mirror_view(relative.motion);
  for (std::size_t c = 0; c < relative.range.size(); ++c) motion(c) = relative.host_motion[c];
  Kokkos::deep_copy(relative.motion, motion);
  for (const ElementGroup& group : groups) {
    const auto arm = Kokkos::create_mirror_view(group.relative.arm);
    for (int p = 0; p < group.blocks.count; ++p) arm(p) = arm_of(reference, relative, group.relative.point[p]);
    Kokkos::deep_copy(group.relative.arm, arm);
  }
  const auto shared = to_host(nodal.shared.nodes);
  const auto arm = Kokkos::create_mirror_view(relative.shared_arm);
  for (std::size_t i = 0; i < shared.extent(0); ++i)
    arm(i) = arm_of(reference, relative, shared(i).node & ~special_bit);
  Kokkos::deep_copy(relative.shared_arm, arm);
}

void keep_relative_nodes(NodalState& nodal) {
  RelativeNodes& relative = nodal.relative;
  const auto nodes = to_vector(nodal.own_nodes);
  const auto before = [&nodes](int n) {
    return static_cast<int>(std::lower_bound(nodes.begin(), nodes.end(), n) - nodes.begin());
  };
  relative.own.clear();
  for (const RelativeNodes::Range& range : relative.range) {
    const int first = before(range.first);
    relative.own.push_back({first, before(range.first + range.count) - first});
  }
}

void begin_relative_nodes(const AssembledScene& assembled, const std::vector<ElementGroup>& groups, NodalState& nodal) {
  RelativeNodes& relative = nodal.relative;
  if (relative.host_motion.empty()) find_frames(assembled, nodal);
  place_frames(groups, nodal);
  each_frame(nodal, [&](const FrameMotion& motion, const FrameNodes& nodes, int count) {
    Kokkos::parallel_for("make_relative", Range(0, count),
                         MakeRelative{nodal.nodes, relative.node, frame_at(motion, 0, 2 * nodal.velocity_lag), nodes});
  });
  relative.begun = true;
  relative.block_step = nodal.step;
  relative.block_time = relative.block_size = 0;
}

void compute_frame_steps(const ExecutionSpace& space, NodalState& nodal, double step) {
  RelativeNodes& relative = nodal.relative;
  if (relative.block_size == step && nodal.step < relative.block_step + steps_of_block) return;
  relative.block_time = relative.time_of(nodal.step);
  relative.block_step = nodal.step;
  relative.block_size = step;
  const int frames = static_cast<int>(relative.range.size());
  Kokkos::parallel_for(
      "frame_steps", Range(space, 0, steps_of_block * frames),
      ComputeFrameSteps{relative.motion, relative.steps, frames, relative.block_time, 2 * nodal.velocity_lag, step});
}

void update_absolute_nodes(const NodalState& nodal, const ExecutionSpace& order) {
  const RelativeNodes& relative = nodal.relative;
  const double time = relative.time_of(nodal.step);
  each_frame(nodal, [&](const FrameMotion& motion, const FrameNodes& nodes, int count) {
    Kokkos::parallel_for(
        "make_absolute", Range(order, 0, count),
        MakeAbsolute{nodal.nodes, relative.node, frame_at(motion, time, 2 * nodal.velocity_lag), nodes});
  });
}

RelativeAdvance relative_advance(const NodalState& nodal, const RelativeBlocks& blocks, double step) {
  const RelativeNodes& relative = nodal.relative;
  const Vector3& g = nodal.gravity;
  const int first = static_cast<int>(nodal.step - relative.block_step) * static_cast<int>(relative.range.size());
  return {{relative.node, blocks.local, blocks.arm, relative.steps, first},
          {static_cast<float>(g[0]), static_cast<float>(g[1]), static_cast<float>(g[2])},
          static_cast<float>(nodal.velocity_lag + 0.5 * step),
          static_cast<float>(step)};
}

}  // namespace railwave
