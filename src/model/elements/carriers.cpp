#include "model/elements/carriers.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "kernels/support/flush_denormals.hpp"
#include "model/build_steps.hpp"
#include "model/host_copy.hpp"

namespace railwave {
namespace {

/// Steps whose carriers are worked out in one launch.
constexpr int steps_of_block = 64;

using Rows = Array<double* [3]>::HostMirror;
using Eigen::Matrix3d;
using Eigen::Vector3d;

Vector3d row_of(const Rows& rows, int n) { return {rows(n, 0), rows(n, 1), rows(n, 2)}; }

/// Linear and angular momentum give the motion. A body without extent in two directions does not turn.
CarrierMotion best_motion(const std::vector<double>& mass, const Rows& position, const Rows& velocity,
                          const CarriedNodes::Range& range) {
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
  CarrierMotion motion;
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

CarriedArm arm_of(const Assembly& assembly, const CarriedNodes& carried, int node, int carrier) {
  const Vec3& X = assembly.nodes[node];
  CarriedArm arm;
  for (int i = 0; i < 3; ++i) arm.x[i] = static_cast<float>(X[i] - carried.host_motion[carrier].centre[i]);
  arm.carrier = carrier;
  return arm;
}

int carrier_of(const CarriedNodes& carried, int node) {
  const auto after = std::upper_bound(carried.range.begin(), carried.range.end(), node,
                                      [](int n, const CarriedNodes::Range& range) { return n < range.first; });
  return static_cast<int>(after - carried.range.begin()) - 1;
}

/// Arms of blocks and of shared nodes from the carriers' centres.
void set_arms(const Assembly& assembly, const std::vector<ElementGroup>& groups, const NodalState& nodal) {
  for (const ElementGroup& group : groups) {
    const auto arm = Kokkos::create_mirror_view(group.carried.arm);
    for (int p = 0; p < group.blocks.count; ++p) {
      const int node = assembly.elements[group.first_element[p]][0];
      arm(p) = arm_of(assembly, nodal.carried, node, carrier_of(nodal.carried, node));
    }
    Kokkos::deep_copy(group.carried.arm, arm);
  }
  const auto shared = to_host(nodal.shared_nodes);
  const auto arm = Kokkos::create_mirror_view(nodal.carried.shared_arm);
  for (std::size_t i = 0; i < shared.extent(0); ++i) {
    const int node = shared(i).node & ~special_bit;
    arm(i) = arm_of(assembly, nodal.carried, node, carrier_of(nodal.carried, node));
  }
  Kokkos::deep_copy(nodal.carried.shared_arm, arm);
}

/// Reference places of a group's nodes told from each block's point, the first corner of its first element.
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

void build_carried_nodes(const AssembledScene& assembled, std::vector<ElementGroup>& groups, Ties& ties,
                         NodalState& nodal) {
  if (assembled.scene.solver.precision != scene::Precision::single_precision) return;
  CarriedNodes& carried = nodal.carried;
  for (const auto& part : assembled.assembly.parts) carried.range.push_back({part.first_node, part.node_count});
  for (int n : assembled.assembly.point_nodes) carried.range.push_back({n, 1});
  for (const auto& [first, count] : assembled.assembly.beam_nodes)
    if (count > 0) carried.range.push_back({first, count});
  carried.node = unset_array<CarriedNode*>("carried nodes", nodal.nodes.count);
  carried.shared_arm = unset_array<CarriedArm*>("arms of shared nodes", nodal.shared_nodes.extent(0));
  carried.motion = unset_array<CarrierMotion*>("carriers", carried.range.size());
  carried.steps = unset_array<CarrierStep*>("steps of carriers", steps_of_block * carried.range.size());
  std::vector<int> of_slave;
  for (const TiedPlace& tied : ties.places) of_slave.push_back(carrier_of(carried, tied.slave));
  ties.carrier = to_device("carriers of tied nodes", of_slave);
  for (ElementGroup& group : groups) {
    group.carried.local = local_places(assembled.assembly, group);
    group.carried.arm = unset_array<CarriedArm*>("arms of blocks", group.blocks.count);
  }
}

void take_nodes_over(const AssembledScene& assembled, const std::vector<ElementGroup>& groups, NodalState& nodal) {
  flush_denormals();
  CarriedNodes& carried = nodal.carried;
  const Rows position = to_host(nodal.nodes.position), velocity = to_host(nodal.nodes.velocity);
  carried.host_motion.clear();
  for (const CarriedNodes::Range& range : carried.range)
    carried.host_motion.push_back(best_motion(assembled.mass, position, velocity, range));
  const auto motion = Kokkos::create_mirror_view(carried.motion);
  for (std::size_t c = 0; c < carried.range.size(); ++c) motion(c) = carried.host_motion[c];
  Kokkos::deep_copy(carried.motion, motion);
  set_arms(assembled.assembly, groups, nodal);
  for (std::size_t c = 0; c < carried.range.size(); ++c)
    Kokkos::parallel_for(
        "take_nodes", Range(0, carried.range[c].count),
        TakeNodes{nodal.nodes, carried.node, carrier_at(carried.host_motion[c], 0, 2 * nodal.velocity_lag),
                  carried.range[c].first});
  carried.begun = true;
  carried.block_step = nodal.step;
  carried.block_time = carried.block_size = 0;
}

void lay_carrier_steps(NodalState& nodal, double step) {
  CarriedNodes& carried = nodal.carried;
  if (carried.block_size == step && nodal.step < carried.block_step + steps_of_block) return;
  carried.block_time = carried.time_of(nodal.step);
  carried.block_step = nodal.step;
  carried.block_size = step;
  const int carriers = static_cast<int>(carried.range.size());
  Kokkos::parallel_for(
      "carrier_steps", Range(0, steps_of_block * carriers),
      LayCarrierSteps{carried.motion, carried.steps, carriers, carried.block_time, 2 * nodal.velocity_lag, step});
}

void give_nodes_back(const NodalState& nodal) {
  const CarriedNodes& carried = nodal.carried;
  const double time = carried.time_of(nodal.step);
  for (std::size_t c = 0; c < carried.range.size(); ++c)
    Kokkos::parallel_for(
        "give_nodes", Range(0, carried.range[c].count),
        GiveNodes{nodal.nodes, carried.node, carrier_at(carried.host_motion[c], time, 2 * nodal.velocity_lag),
                  carried.range[c].first});
}

CarriedAdvance carried_advance(const NodalState& nodal, const CarriedBlocks& blocks, double step) {
  const CarriedNodes& carried = nodal.carried;
  const Vector3& g = nodal.gravity;
  const int first = static_cast<int>(nodal.step - carried.block_step) * static_cast<int>(carried.range.size());
  return {{carried.node, blocks.local, blocks.arm, carried.steps, first},
          {static_cast<float>(g[0]), static_cast<float>(g[1]), static_cast<float>(g[2])},
          static_cast<float>(nodal.velocity_lag + 0.5 * step),
          static_cast<float>(step)};
}

}  // namespace railwave
