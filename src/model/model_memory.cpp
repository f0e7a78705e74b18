#include <fmt/format.h>

#include <Kokkos_Core.hpp>

#include "case/error.hpp"
#include "case/memory.hpp"
#include "model/build_steps.hpp"

namespace railwave {
namespace {

using Space = Kokkos::DefaultExecutionSpace::memory_space;
constexpr bool on_host = Kokkos::SpaceAccessibility<Kokkos::HostSpace, Space>::accessible;
constexpr const char* mend = "make the elements larger, or the bodies smaller";

/// A device does not tell Kokkos how much it has left, but gives what it has at once, and refuses the rest.
bool device_gives(double bytes) {
  try {
    Kokkos::kokkos_free<Space>(Kokkos::kokkos_malloc<Space>("memory for a model", static_cast<std::size_t>(bytes)));
    return true;
  } catch (const std::exception&) {
    return false;
  }
}

}  // namespace

void expect_model_memory(const Assembly& assembly) {
  const double elements = static_cast<double>(assembly.elements.size());
  const double need = bytes_of_model_element * elements;
  if (on_host)
    expect_memory(need, fmt::format("the model's {} elements need", elements), mend);
  else if (!device_gives(need))
    throw MemoryShortage(
        fmt::format("the model's {} elements need about {} of the GPU's memory, which it has not left; {}, or see what "
                    "else runs there",
                    elements, bytes_text(need), mend));
}

}  // namespace railwave
