#include <algorithm>
#include <catch2/catch_test_macros.hpp>
#include <catch2/matchers/catch_matchers_string.hpp>
#include <cstdlib>
#include <cstring>

#include "case/error.hpp"
#include "model/host_copy.hpp"
#include "solve/plan.hpp"
#include "solve/ranks/row_exchange.hpp"
#include "tests/verify/two_blocks.hpp"

using namespace railwave;
using namespace railwave::verify;
using Catch::Matchers::ContainsSubstring;

namespace {

/// What users set, for as long as it lives.
class Wanted {
 public:
  explicit Wanted(const char* way) { setenv("RAILWAVE_RANK_MESSAGES", way, 1); }
  ~Wanted() { unsetenv("RAILWAVE_RANK_MESSAGES"); }
  Wanted(const Wanted&) = delete;
  Wanted& operator=(const Wanted&) = delete;
};

/// Rank 0 of two, of which the other sends back what it is sent.
class Echo : public Transport {
 public:
  explicit Echo(bool takes) : takes_(takes) {}
  int rank() const override { return 0; }
  int ranks() const override { return 2; }
  bool takes_device_memory() const override { return takes_; }
  void broadcast(void* /*data*/, std::size_t /*bytes*/) override {}
  void start_send(int /*to*/, const void* data, std::size_t bytes) override { sent.emplace_back(data, bytes); }
  void start_receive(int /*from*/, void* data, std::size_t bytes) override { received_.emplace_back(data, bytes); }
  void finish() override {
    for (std::size_t k = 0; k < received_.size(); ++k) copy(received_[k].first, sent[k].first, sent[k].second);
    finished.insert(finished.end(), sent.begin(), sent.end());
    sent.clear();
    received_.clear();
  }
  void wait_until(const std::function<bool()>& /*come*/) override {}
  int first_to_refuse(bool yes) override { return yes ? -1 : 0; }
  [[noreturn]] void end_all() override { std::abort(); }

  using Bytes = std::pair<const void*, std::size_t>;
  std::vector<Bytes> sent, finished;

 private:
  void copy(void* to, const void* from, std::size_t bytes) const {
    if (!takes_) {
      std::memcpy(to, from, bytes);
      return;
    }
    const Array<unsigned char*> target(static_cast<unsigned char*>(to), bytes);
    Kokkos::deep_copy(target, Array<const unsigned char*>(static_cast<const unsigned char*>(from), bytes));
  }

  const bool takes_;
  std::vector<std::pair<void*, std::size_t>> received_;
};

/// Every second block of the lower body is another rank's: as many rows go as come, of alike blocks.
BlockPartition every_second_of_another(const Model& model) {
  BlockPartition partition;
  partition.ranks = 2;
  for (const ElementGroup& group : model.elements) partition.owner.emplace_back(group.blocks.count, 0);
  for (std::size_t p = 1; p < partition.owner.back().size(); p += 2) partition.owner.back()[p] = 1;
  return partition;
}

RowWay way_of(const char* text, bool takes) {
  const Wanted wanted(text);
  Echo transport(takes);
  return wanted_row_way(transport);
}

/// Rows of the lower body when two steps have been taken, and what was sent.
std::vector<double> rows_after_steps(const char* way, Echo& transport, RowWay& came) {
  const Wanted wanted(way);
  TwoBlocks blocks;
  blocks.lower_divisions = {16, 16, 12};
  Model model;
  build_model(blocks.scene(1e-4), model);
  set_velocity(model, [](const Vec3& x, int) { return Vec3{-20 * x[0], 30 * x[1], 1e3 * x[0] * x[2]}; });
  const BlockPartition partition = every_second_of_another(model);
  RankShare share = take_share(model, partition, lay_out_ranks(model, partition), 0);
  // The other sends as much as it is sent.
  const std::size_t count = std::min(share.sent.extent(0), share.received.extent(0));
  const auto first = [count](const Array<int*>& all) {
    auto rows = to_vector(all);
    rows.resize(count);
    return to_device("rows", rows);
  };
  share.sent = first(share.sent);
  share.received = first(share.received);
  share.neighbours.at(0).sent_count = share.neighbours.at(0).received_count = static_cast<int>(count);
  RowExchange exchange(model, share, transport);
  came = exchange.way();
  StepPlans plans(model, &exchange);
  Instant instant;
  instant.step = model.step_size;
  for (int k = 0; k < 2; ++k, instant.elapsed = model.step_size) {
    plans.compute_forces(instant, StepKind::advancing);
    plans.advance(instant);
  }
  std::vector<double> rows;
  for (const auto& row : to_vector(model.partial.in_double))
    for (int d = 0; d < 3; ++d) rows.push_back(row.x[d]);
  return rows;
}

}  // namespace

TEST_CASE("users choose the way of rows between ranks") {
  CHECK(way_of("", false) == RowWay::automatic);
  CHECK(way_of("auto", true) == RowWay::automatic);
  CHECK(way_of("host", false) == RowWay::host);
  CHECK(way_of("mpi", true) == RowWay::mpi);
  CHECK_THROWS_WITH(way_of("mpi", false), ContainsSubstring("'mpi', which rank 0 does not have: its MPI"));
  CHECK_THROWS_AS(way_of("mpi", false), InputError);
  CHECK_THROWS_WITH(way_of("HOST", true), ContainsSubstring("'HOST': auto, direct, nccl, mpi or host is wanted"));
  if (has_direct_messages)
    CHECK(way_of("direct", false) == RowWay::direct);
  else
    CHECK_THROWS_WITH(way_of("direct", true), ContainsSubstring("'direct', which rank 0 does not have: its program"));
  if (has_nccl_messages)
    CHECK(way_of("nccl", false) == RowWay::nccl);
  else
    CHECK_THROWS_WITH(way_of("nccl", true), ContainsSubstring("'nccl', which rank 0 does not have: its program"));
}

TEST_CASE("an MPI that takes the device's memory brings the rows that one through the host brings") {
  Echo on_host(false), by_device(true);
  RowWay first = RowWay::automatic, second = RowWay::automatic;
  const auto expected = rows_after_steps("host", on_host, first);
  const auto found = rows_after_steps("mpi", by_device, second);
  CHECK(first == RowWay::host);
  CHECK(second == RowWay::mpi);
  REQUIRE(on_host.finished.size() == 4);  // in each step rows of partial forces and contact forces
  REQUIRE(by_device.finished.size() == 4);
  CHECK(on_host.finished[0].second > 0);
  CHECK(by_device.finished[0].second == on_host.finished[0].second);
  REQUIRE(found.size() == expected.size());
  CHECK(std::memcmp(found.data(), expected.data(), sizeof(double) * found.size()) == 0);
  CHECK(std::any_of(found.begin(), found.end(), [](double force) { return force != 0; }));
}
