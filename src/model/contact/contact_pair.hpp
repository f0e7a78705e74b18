#pragma once

#include <array>
#include <vector>

#include "case/scene.hpp"
#include "kernels/contact/contact_arrays.hpp"
#include "kernels/contact/multiplier_arrays.hpp"
#include "kernels/support/milestone.hpp"
#include "kernels/support/spaces.hpp"
#include "model/assembly.hpp"
#include "model/contact/surface_motion.hpp"

namespace railwave {

struct ContactPair {
  const scene::Contact* contact = nullptr;
  ContactArrays arrays;
  ContactLawArrays law;
  ContactWindow window;
  MultiplierArrays multipliers;  ///< of the second algorithm, see kernels/contact/contact_multiplier.hpp
  Array<double*[3]> slaves_at_layout, masters_at_layout;  ///< m, where the surfaces were when the window was built
  long next_check = -1;                                   ///< step at which the window is checked again
  long next_near_check = -1;                              ///< step at which its nodes that can touch are selected again
  bool boxed = false;                                     ///< the master's boxes hold until then
  long layouts = 0;                                       ///< how often the window was built
  long checks = 0;                                        ///< how often it was checked
  AskedMotion asked_motion;                               ///< since then, for its next check
  bool loaded = false;                                    ///< loads, ties or non-reflecting ends act on its nodes
  bool has_springs() const { return !multipliers.active(); }
  bool own_master = true;     ///< no other forces than the pair's on slaves reach the master's nodes
  bool reversed = false;      ///< the second half of a symmetric contact: surfaces exchanged, reported with the first
  int partner = -1;           ///< the other half of a symmetric contact, -1: none
  std::vector<char> on_both;  ///< by slave: a node of the master too, at a seam's end, where it can't meet itself
  Array<int*> missed;         ///< one: see FindNearNodes
  Array<double*> counted;     ///< N/m by slave: its spring that is counted in the step, see FindNearNodes; empty where
                              ///< nobody asks (automatic_step.hpp)
  bool counts_springs() const { return counted.extent(0) != 0; }
  Array<int*> uncounted;                         ///< one: nodes that can touch by the last check, and are not counted
  PinnedArray<int*> uncounted_sent;              ///< the same, as the device has sent it
  Milestone uncounted_arrives;                   ///< when it has
  long uncounted_of = -1;                        ///< the step whose check that is; -1: the device has it alone
  long near_checked_at = -1;                     ///< step of the last check
  long answer_due = -1;                          ///< step at which the host asks for their number: see answer_of()
  std::vector<int> slave_nodes, master_nodes;    ///< host copies, model node numbers
  std::vector<std::array<int, 4>> slave_facets;  ///< positions in slave_nodes
  std::vector<std::array<int, 4>> master_segments;  ///< positions in master_nodes
  std::vector<double> segment_stiffness;            ///< N/m, at no penetration
  double growth = 1;                                ///< largest factor on that, at any penetration
  double segment_size = 0;                          ///< m, the largest segment's diagonal
  double slave_strength = 0;  ///< N, beyond any force that a face of the slave bears: see contact_quantum()

  /// Steps between two choices of the nodes that can touch.
  static constexpr long steps_between_near_checks = 64;
  /// Steps from there to the one at which the host asks whether all of them are counted. Earlier it would wait for the
  /// device, and the device then for the host. Where nodes are counted, those are chosen that can touch in so many
  /// steps more.
  static constexpr long steps_to_answer = 16;

  /// The step at which the host asks for what a check finds: before any node touches that the check before did not see
  /// coming.
  long answer_of(long check) const {
    const bool seen_coming =
        near_checked_at >= 0 && check > near_checked_at && check <= near_checked_at + steps_between_near_checks;
    if (!seen_coming) return check + 1;
    return answer_due > check ? answer_due : check + steps_to_answer;
  }
};

}  // namespace railwave
