#pragma once

#include <cstring>

#include "kernels/support/milestone.hpp"
#include "kernels/support/spaces.hpp"

namespace railwave {

/// Copies a graph's values to where its launches read them. Recorded in a graph it brings those of the next one.
template <class Value>
struct TakeStepValues {
  Array<const Value*> table;
  Array<Value*> taken;
  Array<int*> row;  ///< of the table, where what is taken begins: each thread has its own
  int steps;        ///< from there, or from the table's beginning, to where it is to begin
  bool from_there;
  int width;

  KOKKOS_INLINE_FUNCTION void operator()(const int i) const {
    row(i) = from_there ? row(i) + steps : steps;
    // Behind the table's end is nothing, and what comes then is taken anew.
    const int place = row(i) * width + i;
    if (place < static_cast<int>(table.extent(0))) taken(i) = table(place);
  }
};

/// One kind of values that follow from a step's time, `width` of them a step, for the steps to come.
template <class Value>
class StepValues {
 public:
  StepValues(int width, int steps_of_graph)
      : width_(width),
        table_("values of steps", width * (steps_of_table + steps_of_graph)),
        host_("values of steps, on the host", table_.extent(0)),
        taken_("values of a graph", width * steps_of_graph),
        row_("first row of a graph's values", taken_.extent(0)) {}

  bool any() const { return width_ > 0; }

  const Value* of(int step_of_graph) const { return width_ == 0 ? nullptr : taken_.data() + step_of_graph * width_; }

  void forget() { step_size_ = 0; }

  /// Brings the values of some steps in place, in the order of a space, if the graph before has not.
  /// @param value of a step, of the given number
  template <class ValueAt>
  void take(const ExecutionSpace& space, long step, long steps, double step_size, const ValueAt& value) {
    if (width_ == 0) return;
    const bool at_hand = step_size == step_size_ && step >= first_ && step + steps <= first_ + steps_of_table;
    if (!at_hand) {
      sent_.wait();
      fill(step, step_size, value);
      Kokkos::deep_copy(space, table_, host_);
      sent_.put(space);
    }
    if (taken_from_ == step || (constant_ && taken_from_ >= 0)) return;
    launch(space, step - first_, false);
    taken_from_ = step;
  }

  /// Recorded in a graph, where nothing of it reads values any more: takes those of the next one.
  void take_next(long steps) const { launch(ExecutionSpace(), steps, true); }

  /// A graph with that has been launched.
  void has_taken_next(long steps) { taken_from_ += steps; }

 private:
  static constexpr int steps_of_table = 512;

  void launch(const ExecutionSpace& space, long steps, bool from_there) const {
    Kokkos::parallel_for("step_values", Range(space, 0, static_cast<int>(taken_.extent(0))),
                         TakeStepValues<Value>{table_, taken_, row_, static_cast<int>(steps), from_there, width_});
  }

  template <class ValueAt>
  void fill(long step, double step_size, const ValueAt& value) {
    first_ = step;
    step_size_ = step_size;
    taken_from_ = -1;
    constant_ = true;
    const int rows = static_cast<int>(host_.extent(0)) / width_;
    for (int s = 0; s < rows; ++s)
      for (int k = 0; k < width_; ++k) {
        const Value now = value(step + s, k);
        constant_ = constant_ && (s == 0 || std::memcmp(&now, &host_(k), sizeof now) == 0);
        host_(s * width_ + k) = now;
      }
  }

  int width_;
  Array<Value*> table_;
  PinnedArray<Value*> host_;
  Milestone sent_;  ///< the host's values may change
  Array<Value*> taken_;
  Array<int*> row_;
  long first_ = 0;
  long taken_from_ = -1;  ///< the step of the first values taken; -1: none of this table
  double step_size_ = 0;  ///< s; 0: nothing is in the table
  bool constant_ = false;
};

}  // namespace railwave
