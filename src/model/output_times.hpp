#pragma once

namespace railwave {

/// How far apart a run's outputs are. With the step of plan_steps() both are whole numbers of cycles of steps.
struct OutputTimes {
  double history = 0;  ///< s, between samples of the histories; 0: every cycle of steps
  double fields = 0;   ///< s, between outputs of fields
};

/// Steps of a run and its outputs.
struct StepPlan {
  long count = 0;   ///< from 0 to the end
  double size = 0;  ///< s
  OutputTimes times;
};

/// Steps of equal size from 0 to `end`, none longer than `largest`, so that outputs are evenly spaced from the
/// first to the last. An interval that does not divide `end` is replaced by the next shorter one that does. Steps are
/// then shortened so that whole cycles of them make the interval (of both outputs if that can be, else of the
/// histories), if that takes less than a tenth more steps. Where it would take more, which is so of intervals of a few
/// steps only, the interval becomes the nearest whole number of cycles, and the run a whole number of these. The size
/// depends on `end` only where the interval does.
/// @param history, fields s, asked for; 0: every cycle; only at the beginning and the end
/// @param cycle steps between two instants at which all is in phase
/// @param fixed the step was asked for: no longer made for the sake of outputs than by what the end needs; outputs come
/// at the nearest cycles
StepPlan equal_steps(double end, double largest, double history, double fields, long cycle, bool fixed);

/// Steps in the whole number of cycles nearest to an interval, at least one cycle.
long whole_cycles(double interval, double step, long cycle);

}  // namespace railwave
