#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "solve/plan.hpp"
#include "solve/ranks/row_exchange.hpp"

/// A run over several ranks. Rank 0 has the time loop, contact, loads, outputs and all that looks at the whole model;
/// it gives the others orders, by which they compute the elements of their blocks.
namespace railwave {

/// Brings what a rank's blocks change between that rank and rank 0: places and velocities of their nodes, the forces
/// that stand in their rows, histories of materials, energies dissipated.
class StateTransfer {
 public:
  StateTransfer(Model& model, Transport& transport);
  ~StateTransfer();

  void send(int to, const ShareItems& items);
  void receive(int from, const ShareItems& items);

 private:
  struct Kept;

  Model& model_;
  Transport& transport_;
  std::unique_ptr<Kept> kept_;
};

/// What rank 0 has the others do.
struct RankOrder {
  enum Kind : int {
    deal_out,    ///< which rank has which blocks
    take_state,  ///< the scene as it begins, or as it was taken up
    advance,     ///< so many steps
    sample,      ///< the forces of an instant, as for outputs
    gather,      ///< the state of the blocks
    move,        ///< the nodes, after a sample
    end
  };
  Kind kind = end;
  long steps = 0;           ///< to advance
  long step = 0;            ///< the present one
  double size = 0;          ///< s, of the step
  double elapsed = 0;       ///< s, since the instant before
  double time = 0;          ///< s, at the present instant
  double velocity_lag = 0;  ///< s, see NodalState
  std::uint64_t model = 0;  ///< when it is dealt out: a number by which models differ
};

/// Rank 0's side.
class RankLeader {
 public:
  /// The model is as built; it may settle and be set in motion afterwards.
  RankLeader(Model& model, Transport& transport);
  /// The others end too.
  ~RankLeader();
  RankLeader(const RankLeader&) = delete;
  RankLeader& operator=(const RankLeader&) = delete;

  /// Deals the model out as it stands: from now on its arrays are whole only after gather().
  void begin();

  RowExchange& exchange() { return *exchange_; }

  /// How many ranks there are, and how their rows go.
  std::string describe() const;

  /// The others take so many steps.
  void advance(const Instant& instant, long steps);
  /// The others compute the forces of an instant that is sampled; and move the nodes on.
  void sample(const Instant& instant);
  void move(const Instant& instant);
  /// Makes the model's arrays whole.
  void gather();

 private:
  void give_order(RankOrder::Kind kind, const Instant& instant, long steps = 0);

  Model& model_;
  Transport& transport_;
  StateTransfer state_transfer_;
  std::vector<ShareItems> items_;  ///< by rank
  std::unique_ptr<RowExchange> exchange_;
};

/// The last order of rank 0, if it has not been given yet: the others wait for orders until then.
void end_followers(Transport& transport);

/// The side of another rank: follows the orders, until rank 0 has come to an end.
void follow_rank_0(Model& model, Transport& transport);

}  // namespace railwave
