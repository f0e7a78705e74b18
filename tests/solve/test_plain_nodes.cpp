#include <Kokkos_Core.hpp>
#include <catch2/catch_test_macros.hpp>
#include <vector>

#include "kernels/nodes/shared_nodes.hpp"
#include "model/elements/relative_coordinates.hpp"
#include "model/host_copy.hpp"
#include "solve/plan.hpp"
#include "solve/statics/settle.hpp"
#include "solve/tasks/element_forces.hpp"
#include "tests/verify/two_blocks.hpp"

using namespace railwave;
using namespace railwave::verify;

namespace {

constexpr double step_size = 1e-7;  // s

scene::Scene moving_blocks(scene::Precision precision) {
  TwoBlocks blocks;
  blocks.lower_divisions = blocks.upper_divisions = {11, 12, 13};
  scene::Scene scene = blocks.scene(3e-4);
  scene.solver.precision = precision;
  add_motion(scene, {"upper", "lower"}, {30, 0, 0}, {0, 0, 500});
  return scene;
}

/// A model after some steps, with the forces of the next instant: the nodes that blocks share have yet to move.
struct MovingModel : Model {
  explicit MovingModel(const scene::Scene& of_blocks) {
    build_model(of_blocks, *this);
    set_initial_motion(*this, nodes, nullptr);
    StepPlans plans(*this);
    for (int k = 0; k < 5; ++k) {
      const Instant instant{k * step_size, step_size, k == 0 ? 0 : step_size};
      plans.compute_forces(instant, StepKind::advancing);
      if (k < 4) plans.advance(instant);
    }
    REQUIRE(shared.first_special > 100);
    REQUIRE(shared.first_special < static_cast<int>(shared.nodes.extent(0)));
    REQUIRE(partial.more.extent(0) > 0);
  }

  SharedForces forces() const { return {acceleration(), shared, RowLoads{}, false}; }

  /// Moves the plain ones.
  template <class Update>
  void move(const Update& update) const {
    Kokkos::parallel_for("plain_nodes", Range(ExecutionSpace(), 0, shared.first_special), update);
  }

  std::vector<double> place() const {
    std::vector<double> all;
    for (const auto& host : {to_host(nodes.position), to_host(nodes.velocity)})
      for (std::size_t n = 0; n < host.extent(0); ++n)
        for (int k = 0; k < 3; ++k) all.push_back(host(n, k));
    return all;
  }
};

template <class S>
void moves_plain_ones_alike(const scene::Scene& scene) {
  const MovingModel one(scene), other(scene);
  REQUIRE(one.partial.single_precision == (sizeof(S) == sizeof(float)));
  const std::vector<double> before = one.place();
  one.move(SharedNodeUpdate{one.forces(), node_advance(one, step_size)});
  other.move(PlainNodeUpdate<S>{other.acceleration().force, other.shared.nodes, node_advance(other, step_size)});
  CHECK(one.place() != before);
  CHECK(one.place() == other.place());
}

}  // namespace

TEST_CASE("plain nodes by themselves move as those among special ones do") {
  moves_plain_ones_alike<double>(moving_blocks(scene::Precision::double_precision));
}

TEST_CASE("plain nodes by themselves move as those among special ones do, under forces in single precision") {
  moves_plain_ones_alike<float>(moving_blocks(scene::Precision::mixed));
}

TEST_CASE("plain nodes in single precision by themselves move as those among special ones do") {
  const scene::Scene scene = moving_blocks(scene::Precision::single_precision);
  const MovingModel one(scene), other(scene);
  REQUIRE(one.relative.active());
  const auto places = [](const Model& model) {
    std::vector<float> all;
    const auto host = to_host(model.relative.node);
    for (std::size_t n = 0; n < host.extent(0); ++n)
      for (int k = 0; k < 3; ++k) {
        all.push_back(host(n).displacement[k]);
        all.push_back(host(n).velocity[k]);
      }
    return all;
  };
  const std::vector<float> before = places(one);
  one.move(RelativeSharedUpdate{one.forces(), relative_advance(one, {}, step_size), one.relative.shared_arm});
  other.move(RelativePlainUpdate{other.acceleration().force, other.shared.nodes, relative_advance(other, {}, step_size),
                                 other.relative.shared_arm});
  CHECK(places(one) != before);
  CHECK(places(one) == places(other));
}
