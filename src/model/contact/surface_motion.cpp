#include "model/contact/surface_motion.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "kernels/nodes/nodes.hpp"
#include "model/contact/contact_pair.hpp"

namespace railwave {
namespace {

/// The largest motion of the nodes of two surfaces, in blocks.
struct LargestMotion {
  static constexpr int block = 16;
  struct Surface {
    Array<const int*> nodes;
    Array<const double* [3]> before;

    KOKKOS_INLINE_FUNCTION int count() const { return static_cast<int>(nodes.extent(0)); }
    KOKKOS_INLINE_FUNCTION int blocks() const { return (count() + block - 1) / block; }
  };
  Array<const double*[3]> position, velocity;
  Surface slave, master;
  PinnedArray<SquaredMotion*> largest;

  /// A NaN counts as far: kept as NaN it would be lost at the next comparison.
  KOKKOS_INLINE_FUNCTION static void raise(double& value, double other) {
    if (!(other <= value)) value = other < 1e300 ? other : 1e300;
  }

  KOKKOS_INLINE_FUNCTION void operator()(const int b) const {
    const int slave_blocks = slave.blocks();
    const bool of_slave = b < slave_blocks;
    const Surface& surface = of_slave ? slave : master;
    const int begin = (of_slave ? b : b - slave_blocks) * block, count = surface.count();
    double moved = 0, speed = 0;
    for (int i = begin; i < begin + block && i < count; ++i) {
      const Vector3 way = row(position, surface.nodes(i)) - row(surface.before, i), v = row(velocity, surface.nodes(i));
      raise(moved, dot(way, way));
      raise(speed, dot(v, v));
    }
    largest(b) = {moved, speed};
  }
};

LargestMotion largest_motion(const NodeArrays& nodes, const ContactPair& pair) {
  return {nodes.position,
          nodes.velocity,
          {pair.arrays.slave_nodes, pair.slaves_at_layout},
          {pair.arrays.master_nodes, pair.masters_at_layout},
          pair.asked_motion.largest};
}

}  // namespace

void ask_for_motion(const ExecutionSpace& space, const NodeArrays& nodes, ContactPair& pair, long step) {
  AskedMotion& asked = pair.asked_motion;
  LargestMotion motion = largest_motion(nodes, pair);
  const int blocks = motion.slave.blocks() + motion.master.blocks();
  if (static_cast<int>(asked.largest.extent(0)) != blocks)
    motion.largest = asked.largest = PinnedArray<SquaredMotion*>("motion of surfaces", blocks);
  Kokkos::parallel_for("surface_motion", SpreadRange(space, 0, blocks), motion);
  asked.arrives.put(space);
  asked.under_way = true;
  asked.last.step = step;
}

const SurfaceMotion& take_motion(ContactPair& pair) {
  AskedMotion& asked = pair.asked_motion;
  if (!asked.under_way) return asked.last;
  asked.arrives.wait();
  asked.under_way = false;
  const int slave_blocks = (pair.arrays.slave_count + LargestMotion::block - 1) / LargestMotion::block,
            blocks = static_cast<int>(asked.largest.extent(0));
  asked.last.moved = asked.last.speed = 0;
  for (const auto& [begin, end] : {std::pair{0, slave_blocks}, std::pair{slave_blocks, blocks}}) {
    SquaredMotion most{};
    for (int b = begin; b < end; ++b) {
      most.moved = std::max(most.moved, asked.largest(b).moved);
      most.speed = std::max(most.speed, asked.largest(b).speed);
    }
    asked.last.moved += std::sqrt(most.moved);
    asked.last.speed += std::sqrt(most.speed);
  }
  return asked.last;
}

}  // namespace railwave
