#pragma once

#include <vector>

namespace railwave {

/// What a rank launches side by side between GPUs, each lane in an order of its own.
enum class RankLane : int {
  inner,     ///< the default order: blocks without late nodes or nodes of other ranks; nodes of this rank alone
  outer,     ///< blocks with nodes of other ranks
  late,      ///< blocks with late nodes, which ties, multipliers, prescribed motions or ends move; then ties, where
             ///< they need no loads
  messages,  ///< rows to and from other ranks, then nodes of several ranks
  loads,
  contact,  ///< springs; multipliers, where they need no loads
  beams,
  motion  ///< ends, ties and multipliers that need loads, late nodes
};
inline constexpr RankLane other_rank_lanes[] = {RankLane::outer,   RankLane::late,  RankLane::messages, RankLane::loads,
                                                RankLane::contact, RankLane::beams, RankLane::motion};

/// What a lane launches from then on comes after all that another has launched.
struct LaneWait {
  RankLane who, for_whom;
};

/// All others for the inner lane.
inline std::vector<LaneWait> others_wait() {
  std::vector<LaneWait> waits;
  for (RankLane lane : other_rank_lanes) waits.push_back({lane, RankLane::inner});
  return waits;
}

/// The same, and lanes for each other, where the inner lane has not waited for all of them: it alone has no blocks with
/// nodes that others move.
/// @param loads_wait loads and beams act on late nodes
inline std::vector<LaneWait> others_wait_in_lanes(bool loads_wait) {
  std::vector<LaneWait> waits = others_wait();
  for (RankLane lane : {RankLane::outer, RankLane::late, RankLane::contact})
    waits.push_back({lane, RankLane::messages});
  for (RankLane lane : {RankLane::late, RankLane::contact}) waits.push_back({lane, RankLane::motion});
  if (loads_wait)
    for (RankLane lane : {RankLane::loads, RankLane::beams}) waits.push_back({lane, RankLane::motion});
  return waits;
}

/// The inner lane for all others.
inline std::vector<LaneWait> inner_waits() {
  std::vector<LaneWait> waits;
  for (RankLane lane : other_rank_lanes) waits.push_back({RankLane::inner, lane});
  return waits;
}

}  // namespace railwave
