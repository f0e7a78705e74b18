#include "out_of_memory.hpp"

#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include <atomic>
#include <cstdlib>
#include <cstring>
#include <new>
#include <regex>
#include <system_error>

#include "case/memory.hpp"
#include "output/room.hpp"
#include "steady_memory.hpp"

namespace {

/// What the latest refused `new` wanted; written where nothing can be allocated any more.
std::atomic<std::size_t> refused{0};

constexpr std::size_t large = std::size_t{1} << 20;  ///< bytes; what is smaller is not worth a look at what is left

}  // namespace

// The program's own, so that a refusal can say how much was wanted. Sanitizers bring theirs; nvcc takes these for functions of the device.
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__) && !defined(__CUDACC__)
[[gnu::noinline]] void* operator new(std::size_t size) {
  if (size < large || railwave::leaves_room(size))
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

constexpr const char* of_kokkos = "Kokkos failed to allocate memory";

/// Kokkos says it as "... for label "NAME". ... Allocation of size 3.725 G failed ...".
std::string wanted_of_kokkos(const std::string& said) {
  std::smatch label, size, space;
  std::string text;
  if (std::regex_search(said, size, std::regex("size ([0-9.]+ ?[KMGT]?i?B?)"))) text = size[1].str() + (size[1].str().find('B') == std::string::npos ? "iB" : "");
  if (std::regex_search(said, label, std::regex("label \"([^\"]*)\""))) text += fmt::format("{}for the array {}", text.empty() ? "memory " : " ", label[1].str());
  if (std::regex_search(said, space, std::regex("MemorySpace named \"([^\"]*)\""))) text += fmt::format(", in memory of {}", space[1].str());
  return text.empty() ? "memory" : text;
}

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
  return dynamic_cast<const std::bad_alloc*>(&error) || std::strncmp(error.what(), of_kokkos, std::strlen(of_kokkos)) == 0 ||
         std::strstr(error.what(), "memory allocation failed");  // HDF5
}

std::string out_of_memory(const std::exception& error) try {
  const std::string said = error.what();
  if (const auto* no_room = dynamic_cast<const NoRoom*>(&error)) refused = no_room->wanted();
  const std::string wanted = said.rfind(of_kokkos, 0) == 0 ? wanted_of_kokkos(said) : refused > 0 ? bytes_text(static_cast<double>(refused)) + " more" : "more memory";
  return fmt::format("out of memory: {} could not be had; {}; take a coarser mesh or fewer output sets, solver.precision \"mixed\" or \"float\", or a machine with "
                     "more; railwave check on a coarser mesh tells the bytes an element",
                     wanted, there_is());
} catch (const std::bad_alloc&) {
  return "out of memory";  // short enough to need none
}

}  // namespace railwave
