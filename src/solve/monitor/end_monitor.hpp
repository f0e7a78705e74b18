#pragma once

#include <string>
#include <vector>

#include "kernels/contact/contact_ends.hpp"
#include "model/assembled_scene.hpp"
#include "model/contact/contact_pair.hpp"
#include "model/contact/surface_ends.hpp"
#include "model/nodal_state.hpp"
#include "solve/checkpoint/run_state.hpp"
#include "solve/monitor/question.hpp"
#include "solve/monitor/sampled_ranks.hpp"

namespace railwave {

/// What a contact is doing at the ends of its surfaces.
struct EndSighting {
  bool closed = false;  ///< some node touches
  double at_end =
      0;  ///< largest nodal force where a surface ends though the contact would go on, over the contact's largest
  double outside_zone = 0;            ///< the same of nodes outside the fine zone of a part
  bool lost = false;                  ///< it was closed at the check before, and has lost its last nodes over an end
  int end_node = -1, zone_node = -1;  ///< of the model, for the place
  std::string end, zone;              ///< which end, which zone: for messages
};

/// Where the contacts of a run are on their surfaces, by checks: reductions over the slave nodes, after the
/// forces of a step, some dozens of steps apart. That is far oftener than checks of the whole model are, as what comes
/// to an end at 30 m/s has fallen off within a millisecond.
///
/// A patch is at an end of its master where the way over the master's facets from a touching slave node to one beside
/// it on the slave leads out. Not every such end is reported, as a wide block on a narrow one touches all of its ends:
/// of the ends at which the body ends, those count that have no like opposite, and those that the slave has slid over
/// by a quarter of its nodes' distance where its own end is opposite. Where a surface is a set and the body's skin goes
/// on beyond it, any counts. Strips whose sides are flush have no node beyond.
class EndMonitor {
 public:
  /// @param others null: this process has the whole model
  EndMonitor(const AssembledScene& assembled, const NodalState& nodal, const std::vector<ContactPair>& contacts,
             SampledRanks* others = nullptr);

  /// Steps between checks.
  static constexpr long steps_between = 256;

  /// Asks the device for what the next check has of the present instant.
  /// @param order in which the launches come
  void ask(const ExecutionSpace& order);
  /// Whether the device has yet to come to that.
  bool waits() const { return question_.waits(); }

  /// Checks all contacts of the scene; waits for what was asked, or asks. Once a step.
  /// @param thorough whether ends that were found to be no matter are checked again
  void check(bool thorough);

  /// Whether the next check may ask where whole parts are.
  bool may_ask_for_places() const;

  /// Some sample, not only a check, had nodes in contact.
  void note_closed(std::size_t contact) { ever_closed_[contact] = 1; }

  /// By contact of the scene, of the last check.
  const std::vector<EndSighting>& sightings() const { return sightings_; }

  /// A line for each contact that neither a check nor a sample of the histories has seen closed.
  std::vector<std::string> never_closed() const;

  void archive(StateSaver& state);
  void archive(StateRestorer& state);

 private:
  struct Memory {
    int closed = 0, ever_closed = 0;
    int ever_clear = 0;  ///< it was closed, and at no end
    int at_end = 0;      ///< at the last check
    int harmless = 0;    ///< the ends that it touches are no matter
    int lost = 0;        ///< it fell off an end, and has not closed since
    double out[3] = {};  ///< unit, to where the master ends there
    int end_node = -1, facet = -1, side = -1, of_set = 0;
  };
  struct Pair {
    std::array<SurfaceEnds, 2> ends;  ///< slave, master
    ContactEndArrays arrays;
    double way_start[3] = {};  ///< m, mean place of the slave's part less that of the master's, undeformed
    std::array<int, 2> part{-1, -1};
    Memory memory;
    EndSighting now;
  };
  struct Crossing;

  void judge(std::size_t number);
  bool has_moved_out(std::size_t number) const;
  void place_outside_zone(std::size_t number, int slave);
  std::string describe_end(const ContactPair& pair, const Memory& memory) const;
  template <class Archive>
  void archive_memory(Archive& archive);

  const AssembledScene& assembled_;
  const NodalState& nodal_;
  const std::vector<ContactPair>& contacts_;
  SampledRanks* const others_;
  Question<std::vector<Largest<ContactEndForces::values>>> question_;  ///< by pair
  std::vector<Pair> pairs_;
  std::vector<EndSighting> sightings_;
  std::vector<char> ever_closed_;  ///< by contact of the scene
};

}  // namespace railwave
