#include <catch2/catch_test_macros.hpp>
#include <vector>

#include "model/host_copy.hpp"
#include "solve/step_values.hpp"

using namespace railwave;

namespace {

constexpr int width = 3, steps_of_graph = 16;

struct ReadValues {
  const double* from;
  Array<double*> to;
  KOKKOS_INLINE_FUNCTION void operator()(const int i) const { to(i) = from[i]; }
};

/// What launches of a graph of so many steps would read.
std::vector<double> read(const StepValues<double>& values, long steps) {
  const Array<double*> found("values", width * steps);
  Kokkos::parallel_for("read_values", Range(0, static_cast<int>(found.extent(0))), ReadValues{values.of(0), found});
  return to_vector(found);
}

/// Graphs of several sizes, with a plain step now and then, to beyond several tables.
/// @param value of a step, of the given number, with a step size
template <class Value>
void check_run(const Value& value) {
  StepValues<double> values(width, steps_of_graph);
  const ExecutionSpace space;
  double step_size = 1;
  long step = 5;
  int wrong = 0;
  const long sizes[] = {4, 16, 16, 15, 1, 16, 2, 16, 16, 16, 8};
  for (int graph = 0; graph < 300; ++graph) {
    const long steps = sizes[graph % 11];
    if (graph % 7 == 3) ++step;
    if (graph == 150) step_size = 0.5;
    values.take(space, step, steps, step_size, [&](long s, int k) { return value(s, k, step_size); });
    const std::vector<double> found = read(values, steps);
    for (long s = 0; s < steps; ++s)
      for (int k = 0; k < width; ++k) wrong += found[width * s + k] != value(step + s, k, step_size);
    if (graph == 200) {
      values.forget();
      continue;
    }
    values.take_next(steps);
    values.has_taken_next(steps);
    step += steps;
  }
  CHECK(wrong == 0);
  CHECK(step > 3000);
}

}  // namespace

TEST_CASE("each graph reads the values of its own steps, whether the graph before has taken them or not") {
  SECTION("values that change") {
    check_run([](long step, int number, double size) { return size * static_cast<double>(10 * step + number); });
  }
  SECTION("values that stay, but for the step size") {
    check_run([](long /*step*/, int number, double size) { return size + number; });
  }
  SECTION("values that change at first") {
    check_run([](long step, int number, double size) {
      return size * static_cast<double>(step < 700 ? step : 700) + number;
    });
  }
}
