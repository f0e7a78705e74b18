#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include <atomic>
#include <cstdlib>
#include <cstring>
#include <new>
#include <system_error>

#include "case/memory.hpp"
#include "commands/process.hpp"
#include "model/ranks/transport.hpp"
#include "output/free_memory.hpp"

namespace {

/// What the latest refused `new` wanted; written where nothing can be allocated any more.
std::atomic<std::size_t> refused{0};

constexpr std::size_t large = std::size_t{1} << 20;  ///< bytes; what is smaller is not worth a look at what is left

}  // namespace

// The program's own, so that a refusal can say how much was wanted. Sanitizers bring theirs; nvcc takes these for
// functions of the device.
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__) && !defined(__CUDACC__)
[[gnu::noinline]] void* operator new(std::size_t size) {
  if (size < large || railwave::leaves_free_memory(size))
    if (void* const place = std::malloc(size ? size : 1)) return place;
  if (!railwave::has_begun()) railwave::end_for_want_of_memory();  // nobody is there yet to catch anything
  refused = size;
  throw std::bad_alloc();
}
[[gnu::noinline]] void operator delete(void* place) noexcept { std::free(place); }
[[gnu::noinline]] void operator delete(void* place, std::size_t) noexcept { std::free(place); }
#endif

namespace railwave {
namespace {

std::string there_is() {
  rlimit limit{};
  const double all = static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGESIZE));
  std::string text = fmt::format("this machine has {}", bytes_text(all));
  if (getrlimit(RLIMIT_AS, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY)
    text += fmt::format(", this process may take {} (ulimit -v)", bytes_text(static_cast<double>(limit.rlim_cur)));
  return text;
}

}  // namespace

bool is_out_of_memory(const std::exception& error) {
  const auto* refused_by_system = dynamic_cast<const std::system_error*>(&error);  // a thread's stack
  if (refused_by_system && refused_by_system->code() == std::errc::resource_unavailable_try_again) return true;
  return dynamic_cast<const std::bad_alloc*>(&error) || is_refusal_of_kokkos(error.what()) ||
         std::strstr(error.what(), "memory allocation failed");  // HDF5
}

std::string rank_for_messages() {
  return others_were_started() ? fmt::format("rank {}: ", rank_of_process()) : std::string();
}

std::string out_of_memory(const std::exception& error) try {
  const std::string said = error.what();
  if (const auto* too_little = dynamic_cast<const TooLittleMemory*>(&error)) refused = too_little->wanted();
  const std::string wanted = is_refusal_of_kokkos(error.what()) ? refused_by_kokkos(said)
                             : refused > 0                      ? bytes_text(static_cast<double>(refused)) + " more"
                                                                : "more memory";
  return fmt::format(
      "out of memory: {} could not be had; {}; take a coarser mesh or fewer output sets, solver.precision \"mixed\" or "
      "\"float\", or a machine with "
      "more; railwave check on a coarser mesh tells the bytes an element",
      wanted, there_is());
} catch (const std::bad_alloc&) {
  return "out of memory";  // short enough to need none
}

}  // namespace railwave
