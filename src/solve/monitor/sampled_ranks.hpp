#pragma once

namespace railwave {

struct MonitorMeasures;
struct DeformedNow;
struct DeformedAhead;

/// What is summed at a sampled instant, in parts that ranks have.
enum class SampledSums : int {
  energies,  ///< kinetic energy and work of gravity by parts of the nodes, energies of blocks of elements
  histories  ///< mean motions and means of elements, by parts of their sets
};

/// The other ranks of a run, as the account and the monitor of rank 0 see them. All ranks stand at the same instant,
/// whose forces are computed and whose nodes have not been moved on.
class SampledRanks {
 public:
  virtual ~SampledRanks() = default;

  /// The others begin to sum their parts. @param step s, the step size
  virtual void begin_sums(SampledSums what, double step) = 0;
  /// Waits for them and puts the others' sums of parts beside the own ones.
  virtual void take_sums(SampledSums what) = 0;

  /// Joins what the others measure of their elements and nodes.
  virtual void join_measures(MonitorMeasures& own) = 0;
  /// The largest of the own rate, see MonitorArrays::largest_rate(), and the others'.
  virtual double largest_rate(double own) = 0;

  /// The same of what elements allow the step, see measure_now() and measure_ahead().
  virtual void join_deformed(DeformedNow& own, double first_limit, double second_limit) = 0;
  virtual void join_deformed(DeformedAhead& own, double limit, double step, double least) = 0;

  /// Makes the mesh whole.
  virtual void gather_mesh() = 0;
  /// Makes the arrays of nodes and elements whole, and the mesh.
  virtual void gather() = 0;
};

}  // namespace railwave
