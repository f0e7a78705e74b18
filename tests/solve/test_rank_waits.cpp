#include <catch2/catch_test_macros.hpp>

#include "solve/plan.hpp"
#include "solve/ranks/row_exchange.hpp"
#include "tests/solve/one_of_two.hpp"
#include "tests/verify/two_blocks.hpp"

using namespace railwave;
using namespace railwave::verify;

namespace {

/// The last block of the lower body is another rank's.
BlockPartition last_block_of_another(const Model& model) {
  BlockPartition partition;
  partition.ranks = 2;
  for (const ElementGroup& group : model.elements) partition.owner.emplace_back(group.blocks.count, 0);
  partition.owner.back().back() = 1;
  return partition;
}

}  // namespace

TEST_CASE("rows of other ranks are waited for, with patience, before a contact's window is checked and not else") {
  for (const scene::ContactAlgorithm algorithm : both_algorithms) {
    INFO(name_of(algorithm));
    TwoBlocks blocks;
    blocks.lower_divisions = {16, 16, 12};
    blocks.algorithm = algorithm;
    Model model;
    build_model(blocks.scene(1e-4), model);
    ContactPair& pair = model.contacts[0];
    std::vector<long> checks_when_waited;
    OneOfTwo transport([&] { checks_when_waited.push_back(pair.checks); });
    const BlockPartition partition = last_block_of_another(model);
    RowExchange exchange(model, take_share(model, partition, lay_out_ranks(model, partition), 0), transport);
    REQUIRE(!exchange.share().neighbours.empty());
    StepPlans plans(model, &exchange);
    Instant instant;
    instant.step = model.step_size;
    for (int k = 0; k < 12; ++k) {
      const bool check = k % 4 == 0;
      pair.next_check = check ? model.step : model.step + 1;
      const long before = pair.checks;
      checks_when_waited.clear();
      plans.compute_forces(instant, StepKind::advancing);
      CHECK(pair.checks == before + (check ? 1 : 0));
      CHECK(checks_when_waited == std::vector<long>(check ? 1 : 0, before));
      plans.advance(instant);
      instant.elapsed = model.step_size;
    }
    CHECK(transport.all_came);
  }
}
