#include <catch2/catch_test_macros.hpp>

#include "kernels/support/meanwhile.hpp"
#include "kernels/support/reductions.hpp"

using namespace railwave;

namespace {

struct CountUp {
  Array<int*> value;
  KOKKOS_INLINE_FUNCTION void operator()(const int i) const { value(i) += 1; }
};

}  // namespace

TEST_CASE("a thread that waits for the device does what it was given meanwhile, and what that waits for it waits for") {
  const Array<int*> value("value", 1);
  const auto launch = [&] { Kokkos::parallel_for("count_up", Range(0, 1), CountUp{value}); };
  const auto sum = [&] {
    double found = 0;
    ReductionSpace space;
    block_sum(ArraySum{Array<double*>("ones", 3)}, 3, &found, space);
    return found;
  };
  int bits = 0;
  {
    const Meanwhile other_work([&] {
      ++bits;
      launch();
      wait_for(ExecutionSpace());  // idly: there is nobody else to go on
      CHECK(sum() == 0);
    });
    launch();
    wait_for(ExecutionSpace());
    CHECK(bits >= 1);
    const int before = bits;
    CHECK(sum() == 0);
    CHECK(bits > before);
  }
  const int before = bits;
  launch();
  wait_for(ExecutionSpace());
  CHECK(bits == before);
  const auto host = Kokkos::create_mirror_view(value);
  Kokkos::deep_copy(host, value);
  CHECK(host(0) == 2 + bits);
}
