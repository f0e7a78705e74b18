#pragma once

#include <cstdint>
#include <exception>
#include <memory>
#include <string>

#include "solve/monitor/monitor_measures.hpp"
#include "solve/monitor/sampled_ranks.hpp"
#include "solve/plan.hpp"
#include "solve/ranks/row_exchange.hpp"

/// A run over several ranks. Rank 0 has the time loop, contact, loads, outputs and all that looks at the whole model;
/// it gives the others orders, by which they compute the elements of their blocks.
namespace railwave {

/// What is brought between a rank and rank 0.
enum class Transferred : int {
  state,     ///< what the rank's blocks change: places and velocities of their nodes, the forces that stand in their
             ///< rows, histories of materials, energies dissipated
  energies,  ///< sums of its parts, see SampledSums
  histories,
  places  ///< of nodes whose fields are written
};
inline constexpr int transferred_kinds = 4;

/// Brings values of a rank's blocks between that rank and rank 0.
class StateTransfer {
 public:
  StateTransfer(Model& model, Transport& transport);
  ~StateTransfer();

  void send(int to, const ShareItems& items, Transferred what);
  void receive(int from, const ShareItems& items, Transferred what);

  /// Received so far.
  double bytes(Transferred what) const { return bytes_[static_cast<int>(what)]; }

 private:
  struct Kept;

  Model& model_;
  Transport& transport_;
  std::unique_ptr<Kept> kept_;
  double bytes_[transferred_kinds] = {};
};

/// What rank 0 has the others do.
struct RankOrder {
  enum Kind : int {
    settle,      ///< with rank 0, see static_parts.hpp
    deal_out,    ///< which rank has which blocks
    take_state,  ///< the scene as it begins, or as it was taken up
    advance,     ///< so many steps
    sample,      ///< the forces of an instant, as for outputs
    gather,      ///< the state of the blocks
    gather_mesh,
    gather_places,
    move,       ///< the nodes, after a sample
    energies,   ///< sums of energies, after a sample
    histories,  ///< sums of motions, stresses and strains
    measures,   ///< of the monitor
    deformed,   ///< elements, by two limits of the step
    deforming,  ///< the same elements in motion
    rate,       ///< at which the fastest element turns
    memory,     ///< the most that was taken
    end
  };
  Kind kind = end;
  long steps = 0;           ///< to advance
  long step = 0;            ///< the present one
  double size = 0;          ///< s, of the step
  double elapsed = 0;       ///< s, since the instant before
  double time = 0;          ///< s, at the present instant
  double velocity_lag = 0;  ///< s, see NodalState
  double limits[3] = {};    ///< s, what measure_now() and measure_ahead() are given
  std::uint64_t model = 0;  ///< when it is dealt out: a number by which models differ
};

/// Rank 0's side.
class RankLeader : public SampledRanks {
 public:
  /// The model is as built; it may settle and be set in motion afterwards.
  RankLeader(Model& model, Transport& transport);
  /// The others end too, unless an exception ends this rank: whoever catches it decides what becomes of them.
  ~RankLeader() override;
  RankLeader(const RankLeader&) = delete;
  RankLeader& operator=(const RankLeader&) = delete;

  /// Deals the model out as it stands: from now on its arrays are whole only after gather().
  /// @param at_start it is as it was built, or settled and set in motion; false: taken up from a checkpoint
  void begin(bool at_start);

  RowExchange& exchange() { return *exchange_; }

  /// The others take so many steps.
  void advance(const Instant& instant, long steps);
  /// The others compute the forces of an instant that is sampled; and move the nodes on.
  void sample(const Instant& instant);
  void move(const Instant& instant);
  /// Nothing where they are whole already.
  void gather_mesh() override;
  void gather() override;
  /// What fields are written from: places alone where displacements are.
  void gather_fields();

  void begin_sums(SampledSums what, double step) override;
  void take_sums(SampledSums what) override;
  void join_measures(MonitorMeasures& own) override;
  double largest_rate(double own) override;
  void join_deformed(DeformedNow& own, double first_limit, double second_limit) override;
  void join_deformed(DeformedAhead& own, double limit, double step, double least) override;

  /// What rank 0 measures.
  const OwnItems& own() const { return own_; }

  /// By rank, see peak_memory().
  std::vector<double> peak_memories();

  /// For people: how much was brought to rank 0.
  std::string summary() const;

 private:
  void take(Transferred what);
  void give_order(RankOrder::Kind kind, const Instant& instant, long steps = 0);
  void give_order(RankOrder order);
  template <class Found>
  void join_found(Found& own);

  Model& model_;
  Transport& transport_;
  StateTransfer state_transfer_;
  std::vector<ShareItems> items_;  ///< by rank
  OwnItems own_;
  const int exceptions_ = std::uncaught_exceptions();  ///< under way when it was made
  bool whole_ = false;                                 ///< the model's arrays are
  long counts_[transferred_kinds] = {};                ///< by Transferred: how often
  std::unique_ptr<RowExchange> exchange_;
};

/// The last order of rank 0, if it has not been given yet: the others wait for orders until then.
void end_followers(Transport& transport);

/// The side of another rank: follows the orders, until rank 0 has come to an end.
void follow_rank_0(Model& model, Transport& transport);

}  // namespace railwave
