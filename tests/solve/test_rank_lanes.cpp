#include <algorithm>
#include <catch2/catch_test_macros.hpp>
#include <map>
#include <random>
#include <set>
#include <stdexcept>
#include <utility>

#include "solve/plan.hpp"
#include "solve/ranks/row_exchange.hpp"
#include "tests/solve/moved_blocks.hpp"
#include "tests/solve/one_of_two.hpp"
#include "tests/verify/beam_scene.hpp"

using namespace railwave;
using namespace railwave::verify;

namespace {

constexpr int steps_in_lanes = 40;

/// Those of a GPU in name: all lanes launch in the default order, and the other rank sends zeros.
class LanesInName : public DeviceMessages {
 public:
  explicit LanesInName(SentBytes& sent) : sent_(sent) {}
  const ExecutionSpace& space(RankLane /*lane*/) const override { return space_; }
  void wait(const LaneWait& /*wait*/) override {}
  void exchange(const std::vector<Message>& messages) override {
    using Bytes = Kokkos::View<const unsigned char*, ExecutionSpace::memory_space, Kokkos::MemoryUnmanaged>;
    for (const Message& one : messages) {
      const auto sent = Kokkos::create_mirror_view_and_copy(
          Kokkos::HostSpace(), Bytes(static_cast<const unsigned char*>(one.sent), one.sent_bytes));
      sent_.add(sent.data(), one.sent_bytes);
      Kokkos::deep_copy(space_, Array<unsigned char*>(static_cast<unsigned char*>(one.received), one.received_bytes),
                        static_cast<unsigned char>(0));
    }
  }
  std::unique_ptr<Recorded> record(const std::function<void()>& /*launch*/) override {
    throw std::logic_error("nothing is recorded here");
  }

 private:
  SentBytes& sent_;
  ExecutionSpace space_;
};

/// The same with memory into which rows are packed.
class LendsInName : public LanesInName {
 public:
  LendsInName(SentBytes& sent, const RankShare& share)
      : LanesInName(sent),
        sent_(sent),
        bytes_(sizeof(PartialForce<double>) * share.sent.extent(0) + sizeof(FixedForce) * share.touched.extent(0)),
        second_((bytes_ + cache_line - 1) / cache_line * cache_line),
        came_("came", 2 * (sizeof(PartialForce<double>) * share.received.extent(0))),
        packed_("packed", 2 * second_),
        exchanges_("exchanges", 1) {
    REQUIRE(share.neighbours.size() == 1);
    lent_.parts.push_back(
        {packed_.data(), came_.data(), static_cast<long>(second_), static_cast<long>(came_.extent(0) / 2)});
    lent_.exchanges = exchanges_.data();
  }
  const LentMemory* lent() const override { return &lent_; }
  void exchange(const std::vector<Message>& messages) override {
    REQUIRE(messages.empty());
    const auto packed = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), packed_);
    sent_.add(packed.data() + (done_++ % 2 == 0 ? 0 : second_), bytes_);
    Kokkos::deep_copy(packed_, static_cast<unsigned char>(0xee));
    Kokkos::deep_copy(exchanges_, done_);
  }

 private:
  SentBytes& sent_;
  std::size_t bytes_, second_;
  unsigned long long done_ = 0;
  Kokkos::View<unsigned char*, ExecutionSpace::memory_space> came_, packed_;
  Kokkos::View<unsigned long long*, ExecutionSpace::memory_space> exchanges_;
  LentMemory lent_;
};

/// How rank 0 exchanges rows.
enum class Way { by_mpi, in_lanes, into_lent_memory };

/// Rank 1 has the blocks on whose nodes nothing but elements, constraints and contact's springs acts.
BlockPartition elements_alone_to_another(const Model& model) {
  std::set<int> bound;
  for (const LoadedRow& loaded : to_vector(model.external.loaded)) bound.insert(loaded.node);
  const auto shared = to_host(model.shared.nodes);
  for (std::size_t i = model.first_late; i < shared.extent(0); ++i) bound.insert(shared(i).node & ~special_bit);
  for (const TiedPlace& tied : model.ties.places) bound.insert(std::begin(tied.face), std::end(tied.face));
  BlockPartition partition;
  partition.ranks = 2;
  for (const ElementGroup& group : model.elements) {
    auto& owner = partition.owner.emplace_back();
    const auto node = to_host(group.blocks.node), count = to_host(group.blocks.node_count);
    for (int p = 0; p < group.blocks.count; ++p) {
      bool any = false;
      for (int l = 0; l < count(p); ++l)
        any = any || bound.count(node(p * group.blocks.node_stride + l) & ~advance_bit) > 0;
      owner.push_back(any ? 0 : 1);
    }
  }
  return partition;
}

/// Rank 0's part of a scene.
struct Rank0 {
  Model model;
  OneOfTwo transport;
  std::unique_ptr<RowExchange> exchange;

  Rank0(const scene::Scene& scene, Way way) {
    build_model(scene, model);
    set_initial_motion(model, model.nodes, model.beams);
    const BlockPartition partition = elements_alone_to_another(model);
    RankShare share = take_share(model, partition, lay_out_ranks(model, partition), 0);
    std::unique_ptr<DeviceMessages> messages;
    if (way == Way::in_lanes) messages = std::make_unique<LanesInName>(transport.sent);
    if (way == Way::into_lent_memory) messages = std::make_unique<LendsInName>(transport.sent, share);
    exchange = std::make_unique<RowExchange>(model, std::move(share), transport, std::move(messages));
  }
};

/// A task of one of many steps, and what it comes after.
struct Launch {
  const Task* task;
  Instant instant;
  long step;
  double velocity_lag;
  std::set<int> after;
};

/// All tasks of the steps of a plan. @param without the lane for which nobody waits; null: as the plan has it
std::vector<Launch> launches_of(const Plan& plan, const Model& model, const RankLane* without) {
  std::vector<Launch> all;
  std::map<RankLane, std::set<int>> last;
  for (long s = 0; s < steps_in_lanes; ++s) {
    const Instant instant{static_cast<double>(s) * model.step_size, model.step_size, s == 0 ? 0 : model.step_size};
    for (const std::vector<Task>* tasks : {&plan.forces, &plan.motion})
      for (const Task& task : *tasks) {
        if (!task.due(s)) continue;
        for (const LaneWait& wait : task.waits)
          if (without == nullptr || wait.for_whom != *without)
            last[wait.who].insert(last[wait.for_whom].begin(), last[wait.for_whom].end());
        all.push_back({&task, instant, s, s == 0 ? 0 : 0.5 * model.step_size, last[task.rank_lane]});
        last[task.rank_lane] = {static_cast<int>(all.size()) - 1};
      }
  }
  return all;
}

/// Runs launches in any order that their waits allow. @param first says which of two lanes comes first where both may
template <class First>
End run_launches(Model& model, const std::vector<Launch>& launches, const First& first) {
  std::vector<char> done(launches.size(), 0);
  // Of each lane the next launch; lanes go in order.
  std::map<RankLane, std::vector<int>> left;
  for (std::size_t k = launches.size(); k-- > 0;) left[launches[k].task->rank_lane].push_back(static_cast<int>(k));
  for (std::size_t count = 0; count < launches.size(); ++count) {
    std::vector<RankLane> ready;
    for (const auto& [lane, of_lane] : left) {
      if (of_lane.empty()) continue;
      const std::set<int>& after = launches[of_lane.back()].after;
      if (std::all_of(after.begin(), after.end(), [&](int other) { return done[other] != 0; })) ready.push_back(lane);
    }
    REQUIRE(!ready.empty());
    const RankLane lane = first(ready);
    const int next = left[lane].back();
    left[lane].pop_back();
    done[next] = 1;
    const Launch& launch = launches[next];
    model.step = launch.step;
    model.time = launch.instant.time;
    model.velocity_lag = launch.velocity_lag;
    launch.task->run(launch.instant);
  }
  return end_of(model);
}

/// How rank 0's part of a run ends, and what it has sent.
struct Outcome {
  End end;
  std::uint64_t sent;
};

Outcome outcome_in_order(const scene::Scene& scene, Way way = Way::by_mpi) {
  Rank0 rank(scene, way);
  REQUIRE(rank.exchange->between_devices() == (way != Way::by_mpi));
  StepPlans plans(rank.model, rank.exchange.get());
  for (long s = 0; s < steps_in_lanes; ++s) {
    const Instant instant{static_cast<double>(s) * rank.model.step_size, rank.model.step_size,
                          s == 0 ? 0 : rank.model.step_size};
    rank.model.time = instant.time;
    plans.compute_forces(instant, StepKind::advancing);
    plans.advance(instant);
  }
  return {end_of(rank.model), rank.transport.sent.hash()};
}

/// Whether all orders that are tried end as the expected one, and send the same.
/// @param without see launches_of()
bool all_alike(const scene::Scene& scene, const Outcome& expected, const RankLane* without = nullptr) {
  const auto alike = [&](const auto& first) {
    Rank0 rank(scene, Way::in_lanes);
    REQUIRE(rank.exchange->between_devices());
    const Plan plan = make_plan(rank.model, StepKind::advancing, rank.exchange.get());
    const End end = run_launches(rank.model, launches_of(plan, rank.model, without), first);
    return end.position == expected.end.position && end.velocity == expected.end.velocity &&
           rank.transport.sent.hash() == expected.sent;
  };
  std::vector<RankLane> lanes{RankLane::inner};
  lanes.insert(lanes.end(), std::begin(other_rank_lanes), std::end(other_rank_lanes));
  bool all = true;
  for (RankLane favoured : lanes)
    for (const bool hurries : {true, false}) {
      // As early as it can, or as late.
      all = all && alike([&](const std::vector<RankLane>& ready) {
              const auto is_favoured = [&](RankLane lane) { return (lane == favoured) == hurries; };
              const auto found = std::find_if(ready.begin(), ready.end(), is_favoured);
              return found == ready.end() ? ready.front() : *found;
            });
    }
  std::mt19937 random(1);
  for (int k = 0; k < 3; ++k)
    all = all && alike([&](const std::vector<RankLane>& ready) { return ready[random() % ready.size()]; });
  return all;
}

scene::Scene tied_scene() {
  TiedBlocks blocks;
  blocks.fine = {8, 8, 32};
  return tied_and_open(blocks);
}

scene::Scene in_contact(scene::ContactAlgorithm algorithm) {
  scene::Scene scene = moved_blocks();
  for (auto& mesh : scene.meshes) mesh.box.divisions = {32, 8, 16};
  scene.parts[1].stiffness_damping = 0;
  scene.contacts[0].algorithm = algorithm;
  return scene;
}

}  // namespace

TEST_CASE("lanes of a rank go on side by side, bit for bit, and wait for what they must") {
  scene::Scene scene;
  std::vector<RankLane> waited_for{RankLane::inner, RankLane::outer, RankLane::late, RankLane::messages};
  SECTION("ties, non-reflecting ends, loads") {
    scene = tied_scene();
    waited_for.push_back(RankLane::loads);
    waited_for.push_back(RankLane::motion);
  }
  SECTION("the same with loads on other nodes than those at ends") {
    scene = tied_scene();
    scene.loads.pop_back();
    waited_for = {RankLane::motion};
  }
  SECTION("in mixed precision") {
    scene = tied_scene();
    scene.solver.precision = scene::Precision::mixed;
    waited_for.clear();  // one after the other
  }
  SECTION("contact by springs, prescribed motions, connectors") {
    scene = in_contact(scene::ContactAlgorithm::penalty);
    waited_for.push_back(RankLane::contact);
  }
  SECTION("the same with a beam") {
    scene = in_contact(scene::ContactAlgorithm::penalty);
    scene.points = {massless("pole", {0.03, 0.03, 0.2})};
    scene.beams = {round_beam("pole", "upper.z_max", 0.004, 2)};
    waited_for = {RankLane::beams, RankLane::motion};
  }
  SECTION("contact by multipliers") { scene = in_contact(scene::ContactAlgorithm::multiplier); }
  const Outcome expected = outcome_in_order(scene);
  CHECK(all_alike(scene, expected));
  for (RankLane lane : waited_for) {
    INFO(static_cast<int>(lane));
    CHECK_FALSE(all_alike(scene, expected, &lane));
  }
}

TEST_CASE("rows are packed into memory that a neighbour lends, as they would be sent") {
  scene::Scene scene;
  SECTION("elements and ties") { scene = tied_scene(); }
  SECTION("contact's forces, too") { scene = in_contact(scene::ContactAlgorithm::penalty); }
  const Outcome sent = outcome_in_order(scene), packed = outcome_in_order(scene, Way::into_lent_memory);
  CHECK(packed.end.position == sent.end.position);
  CHECK(packed.end.velocity == sent.end.velocity);
  CHECK(packed.sent == sent.sent);
}
