#include "commands/process.hpp"

#include <alloca.h>
#include <malloc.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <cstring>

namespace railwave {
namespace {

constexpr std::size_t of_libraries = std::size_t{16} << 20;  ///< bytes: many times what they take to begin
std::atomic<bool> begun{false};
char** first_environment = nullptr;    ///< before libraries begin getenv() finds nothing
constexpr int of_own_pages = 1 << 20;  ///< bytes
constexpr std::size_t of_stack = std::size_t{1} << 20;

void expect(std::size_t bytes) {
  void* const place = mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (place == MAP_FAILED) end_for_want_of_memory();
  munmap(place, bytes);
}

#if !defined(__CUDACC__) && !defined(__SANITIZE_ADDRESS__) && \
    !defined(__SANITIZE_THREAD__)  // sanitizers have not begun then
/// Some of the libraries that HDF5 brings, and their constructors, don't live through a lack of memory.
void before_libraries(int, char**, char** environment) {
  first_environment = environment;
  expect(of_libraries);
}
[[gnu::section(".preinit_array"), gnu::used]] void (*const look_before_libraries)(int, char**,
                                                                                  char**) = before_libraries;
#endif

/// Null where there is none. @param name with "=" behind
const char* environment_value(const char* name) {
  for (char** entry = first_environment != nullptr ? first_environment : environ; *entry != nullptr; ++entry)
    if (std::strncmp(*entry, name, std::strlen(name)) == 0) return *entry + std::strlen(name);
  return nullptr;
}

[[gnu::noinline]] void touch_stack(std::size_t bytes) {
  auto* const lowest = static_cast<volatile char*>(alloca(bytes));
  const auto page = static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
  for (std::size_t below = page; below <= bytes; below += page) lowest[bytes - below] = 0;
}

}  // namespace

bool has_begun() noexcept { return begun; }

void end_for_want_of_memory() noexcept {
  const auto say = [](const char* text) {
    const auto written = write(STDERR_FILENO, text, std::strlen(text));
    static_cast<void>(written);
  };
  say("railwave: ");
  // Of a process that has not joined the others yet what has started it knows which it is.
  for (const char* variable : {"OMPI_COMM_WORLD_RANK=", "PMI_RANK="})
    if (const char* rank = environment_value(variable)) {
      say("rank ");
      say(rank);
      say(": ");
      break;
    }
  say("out of memory: not even the program itself finds enough to begin; see ulimit -v, ulimit -d and what else takes "
      "memory\n");
  _exit(1);
}

void steady_memory() {
  if (std::getenv("MALLOC_ARENA_MAX") == nullptr) mallopt(M_ARENA_MAX, 1);
  // Arrays of a model have pages of their own, which go back to the system when they are freed.
  if (std::getenv("MALLOC_MMAP_THRESHOLD_") == nullptr) mallopt(M_MMAP_THRESHOLD, of_own_pages);
  rlimit limit{};
  const bool known = getrlimit(RLIMIT_STACK, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY;
  const std::size_t stack = known ? std::min<std::size_t>(of_stack, limit.rlim_cur / 4) : of_stack;
  expect(2 * stack);
  touch_stack(stack);
  begun = true;
}

}  // namespace railwave
