#include "model/model_room.hpp"

#include <fmt/format.h>

#include <Kokkos_Core.hpp>

#include "case/error.hpp"
#include "case/memory.hpp"

#ifdef KOKKOS_ENABLE_CUDA
#include <cuda_runtime.h>
#endif

namespace railwave {
namespace {

constexpr const char* mend = "make the elements larger, or the bodies smaller";

}  // namespace

void expect_model_room(const Assembly& assembly) {
  const double elements = static_cast<double>(assembly.elements.size());
  const double need = bytes_of_model_element * elements;
#ifdef KOKKOS_ENABLE_CUDA
  std::size_t left = 0, all = 0;
  if (cudaMemGetInfo(&left, &all) == cudaSuccess && need > static_cast<double>(left))
    throw InputError(fmt::format("the model's {} elements need about {} of the GPU's memory, which has {} of its {} left; {}, or see what else runs there", elements,
                                 bytes_text(need), bytes_text(static_cast<double>(left)), bytes_text(static_cast<double>(all)), mend));
#else
  expect_memory(need, fmt::format("the model's {} elements need", elements), mend);
#endif
}

}  // namespace railwave
