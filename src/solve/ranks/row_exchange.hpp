#pragma once

#include "model/ranks/rank_share.hpp"
#include "model/ranks/transport.hpp"
#include "solve/tasks.hpp"

namespace railwave {

/// Brings to each rank the rows of partial forces that others' blocks leave for its nodes. All ranks that have a node
/// add its rows in the same order, so that it goes the same way on each.
class RowExchange {
 public:
  RowExchange(const NodalState& nodal, RankShare share, Transport& transport);
  ~RowExchange();

  const RankShare& share() const { return share_; }
  Transport& transport() const { return transport_; }

  /// Whether rows go from GPU to GPU; else they go through the host.
  bool between_devices() const;

  /// Until no more than so many steps are left whose rows of other ranks have not come, see Transport::wait_until().
  /// Nobody may wait for the device before that: of a rank that does not answer, it waits without end.
  void wait_for_rows(long steps_ahead = 0) const;

  /// To come after the outer blocks' forces: the rows are on their way from then on.
  Task send_task();
  /// Before anything that needs all forces.
  Task receive_task();

 private:
  struct Buffers;

  /// Calls act(rows of partial forces, their buffers).
  template <class Do>
  void with_rows(const Do& act) const;

  const NodalState& nodal_;
  RankShare share_;
  Transport& transport_;
  std::unique_ptr<Buffers> buffers_;
};

}  // namespace railwave
