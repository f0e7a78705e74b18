#pragma once

#include <memory>
#include <string>
#include <vector>

#include "case/scene.hpp"
#include "model/output_times.hpp"

namespace railwave {

/// What [solver] step_estimate = "automatic" came to (automatic_step.hpp).
struct StepChoice {
  enum class Reason {
    not_asked,     ///< the case names an estimate
    pays,          ///< the whole scene's step is taken
    gains_little,  ///< it is hardly longer than the elements'
    short_run,     ///< it takes longer to find than it can save
    step_given,
    subcycled,
    flows,
    strikes,
    crack_mouths,
    no_elements,
    changes_often,  ///< it was taken until contact changed too often
    deforms,        ///< it was taken until elements changed their shape
    no_longer_pays  ///< it was taken until contact made it hardly longer than the elements'
  };
  Reason reason = Reason::not_asked;
  double gain = 0;         ///< the whole scene's step over the elements'; where that was not taken, at most that
  double evaluations = 0;  ///< of the scene's forces: what finding it has cost so far
};

/// The stable step, s, by each estimate, and what sets it.
struct StableStep {
  double elements = 0;          ///< min V / (A_max C_d), thesis eq. 2.14
  int element = -1;             ///< the element that sets it
  scene::Vec3 element_place{};  ///< m, of its first node
  double contact = 0;           ///< of the contact springs with the elements under them; 0: no contact
  double connector = 0;         ///< of springs and dashpots on the masses of their ends; 0: none
  double beam = 0;              ///< of the beams with the mass that is theirs; 0: none
  double by_elements = 0;       ///< these together

  double eigenvalue = 0;  ///< of the element with the highest eigenvalue, hourglass control included
  int eigenvalue_element = -1;
  scene::Vec3 eigenvalue_place{};  ///< m
  double eigenvalue_contact = 0;   ///< of the contact springs with such elements under them; 0: no contact
  double by_eigenvalues = 0;       ///< these and the connectors together

  double global = 0;                    ///< of the whole scene at its last renewal; 0: not asked for
  long springs = 0;                     ///< contact springs counted in it
  std::vector<std::vector<char>> seen;  ///< by contact pair and slave node: whether its spring was

  double limit = 0;     ///< by the estimate that the case chose, and as far as elements have changed their shape
  double deformed = 0;  ///< of the limit, what is left by elements that have changed their shape; 0: all
  StepChoice choice;
};

class GlobalEstimate;

/// How large a run's steps are, how many, and at which of them it writes.
struct StepSizes {
  StableStep stable_step;
  std::vector<float> own_steps;  ///< s, by element as it was made: what it bears by its highest eigenvalue. On another
                                 ///< rank than 0 of the elements of its blocks, ascending
  std::shared_ptr<GlobalEstimate> global_estimate;  ///< null unless the case asks for it
  double step_size = 0;  ///< s, of the present step: the scale factor's share of the stable one, in whole steps
  long step_count = 0;   ///< steps from 0 to the end, if the step stays
  OutputTimes output_times;
};

/// Plans a scene's steps (equal_steps) with the stable step there is: sets step_size, step_count and output_times.
void plan_steps(const scene::Scene& scene, long cycle, StepSizes& sizes);

/// Lines that say how far apart the outputs are.
std::vector<std::string> describe_output_times(const scene::Scene& scene, const StepSizes& sizes, long cycle);

}  // namespace railwave
