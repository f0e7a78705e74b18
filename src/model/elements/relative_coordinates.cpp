#include "model/elements/relative_coordinates.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "kernels/support/flush_denormals.hpp"
#include "model/build_steps.hpp"
#include "model/host_copy.hpp"

namespace railwave {
namespace {

/// Steps whose frames are worked out in one launch.

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

FrameArm arm_of(const Assembly& assembly, const RelativeNodes& relative, int node, int frame) {
  const Vec3& X = assembly.nodes[node];
  FrameArm arm;
  for (int i = 0; i < 3; ++i) arm.x[i] = static_cast<float>(X[i] - relative.host_motion[frame].centre[i]);
  arm.frame = frame;
  return arm;
}

int frame_of(const RelativeNodes& relative, int node) {
  const auto after = std::upper_bound(relative.range.begin(), relative.range.end(), node,
                                      [](int n, const RelativeNodes::Range& range) { return n < range.first; });
  return static_cast<int>(after - relative.range.begin()) - 1;
}

/// Arms of blocks and of shared nodes from the frames' centres.
void set_arms(const Assembly& assembly, const std::vector<ElementGroup>& groups, const NodalState& nodal) {
  for (const ElementGroup& group : groups) {
    const auto arm = Kokkos::create_mirror_view(group.relative.arm);
    for (int p = 0; p < group.blocks.count; ++p) {
      const int node = assembly.elements[group.first_element[p]][0];
      arm(p) = arm_of(assembly, nodal.relative, node, frame_of(nodal.relative, node));
    }
    Kokkos::deep_copy(group.relative.arm, arm);
  }
  const auto shared = to_host(nodal.shared.nodes);
  const auto arm = Kokkos::create_mirror_view(nodal.relative.shared_arm);
  for (std::size_t i = 0; i < shared.extent(0); ++i) {
    const int node = shared(i).node & ~special_bit;
    arm(i) = arm_of(assembly, nodal.relative, node, frame_of(nodal.relative, node));
  }
  Kokkos::deep_copy(nodal.relative.shared_arm, arm);
}

/// Reference places of a group's nodes relative to each block's point, the first corner of its first element.
Array<float*> local_places(const Assembly& assembly, const ElementGroup& group) {
  const ElementBlocks& blocks = group.blocks;
  const auto number = to_host(blocks.node);
  std::vector<float> local(3 * number.extent(0));
  for (int p = 0; p < blocks.count; ++p) {
    const Vec3& point = assembly.nodes[assembly.elements[group.first_element[p]][0]];
    for (int l = 0; l < blocks.node_stride; ++l) {
      const int n = number(static_cast<std::size_t>(p) * blocks.node_stride + l) & ~advance_bit;
      for (int i = 0; i < 3; ++i)
        local[(3 * static_cast<std::size_t>(p) + i) * blocks.node_stride + l] =
            static_cast<float>(assembly.nodes[n][i] - point[i]);
    }
  }
  return to_device("local places", local);
}

}  // namespace

void build_relative_nodes(const AssembledScene& assembled, std::vector<ElementGroup>& groups, Ties& ties,
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
    group.relative.local = local_places(assembled.assembly, group);
    group.relative.arm = unset_array<FrameArm*>("arms of blocks", group.blocks.count);
  }
}

void begin_relative_nodes(const AssembledScene& assembled, const std::vector<ElementGroup>& groups, NodalState& nodal) {
  flush_denormals();
  RelativeNodes& relative = nodal.relative;
  const Rows position = to_host(nodal.nodes.position), velocity = to_host(nodal.nodes.velocity);
  relative.host_motion.clear();
  for (const RelativeNodes::Range& range : relative.range)
    relative.host_motion.push_back(best_motion(assembled.mass, position, velocity, range));
  const auto motion = Kokkos::create_mirror_view(relative.motion);
  for (std::size_t c = 0; c < relative.range.size(); ++c) motion(c) = relative.host_motion[c];
  Kokkos::deep_copy(relative.motion, motion);
  set_arms(assembled.assembly, groups, nodal);
  for (std::size_t c = 0; c < relative.range.size(); ++c)
    Kokkos::parallel_for(
        "make_relative", Range(0, relative.range[c].count),
        MakeRelative{nodal.nodes, relative.node, frame_at(relative.host_motion[c], 0, 2 * nodal.velocity_lag),
                     relative.range[c].first});
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

void update_absolute_nodes(const NodalState& nodal) {
  const RelativeNodes& relative = nodal.relative;
  const double time = relative.time_of(nodal.step);
  for (std::size_t c = 0; c < relative.range.size(); ++c)
    Kokkos::parallel_for(
        "make_absolute", Range(0, relative.range[c].count),
        MakeAbsolute{nodal.nodes, relative.node, frame_at(relative.host_motion[c], time, 2 * nodal.velocity_lag),
                     relative.range[c].first});
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
