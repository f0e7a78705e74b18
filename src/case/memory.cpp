#include "case/memory.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <fstream>
#include <limits>
#include <regex>

#ifdef __GLIBC__
#include <malloc.h>
#endif
#include <sys/resource.h>

#include "case/error.hpp"

namespace railwave {
namespace {

constexpr double unknown = std::numeric_limits<double>::infinity();

/// The number after `name` in a file of names and numbers.
double entry_of(const char* path, const std::string& name) {
  std::ifstream file(path);
  for (std::string word; file >> word;) {
    double value = 0;
    if (word == name && file >> value) return value;
  }
  return unknown;
}

/// The one number in a file; infinity for "max" or where there is no such file.
double number_in(const char* path) {
  std::ifstream file(path);
  double value = 0;
  return file >> value ? value : unknown;
}

double left_of_address_space() {
  rlimit limit{};
  if (getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return unknown;
  const double kilobytes = entry_of("/proc/self/status", "VmSize:");
  return std::max(0.0, static_cast<double>(limit.rlim_cur) - (kilobytes == unknown ? 0 : 1024 * kilobytes));
}

double left_of_container() {
  const double limit = number_in("/sys/fs/cgroup/memory.max"), taken = number_in("/sys/fs/cgroup/memory.current");
  if (limit == unknown || taken == unknown) return unknown;
  // Copies of files on disk count as taken, but are given up when memory is asked for.
  const double copies = entry_of("/sys/fs/cgroup/memory.stat", "inactive_file");
  return std::max(0.0, limit - taken + (copies == unknown ? 0 : copies));
}

}  // namespace

double available_memory() {
  return std::min({1024 * entry_of("/proc/meminfo", "MemAvailable:"), left_of_address_space(), left_of_container()});
}

double peak_memory() {
  const double kilobytes = entry_of("/proc/self/status", "VmHWM:");
  return std::isfinite(kilobytes) ? 1024 * kilobytes : 0;
}

void give_freed_memory_back() {
#ifdef __GLIBC__
  malloc_trim(0);
#endif
}

std::string bytes_text(double bytes) {
  const char* const units[] = {"bytes", "kB", "MB", "GB", "TB", "PB", "EB"};
  std::size_t unit = 0;
  for (; bytes >= 999.5 && unit + 1 < std::size(units); ++unit) bytes /= 1000;
  return fmt::format("{:.3g} {}", bytes, units[unit]);
}

// Kokkos 3.4 to 4.4: Kokkos failed to allocate memory for label "NAME".  Allocation using MemorySpace named "Host"
// failed with the following error:  Allocation of size 3.725 G failed. Later: Kokkos ERROR: Host memory space failed to
// allocate 3.725 GiB (label="NAME").
bool is_refusal_of_kokkos(const char* said) {
  return std::strncmp(said, "Kokkos", 6) == 0 &&
         (std::strstr(said, " failed to allocate memory") || std::strstr(said, " memory space failed to allocate "));
}

std::string refused_by_kokkos(const std::string& said) {
  const auto find = [&said](const char* pattern) {
    std::smatch found;
    return std::regex_search(said, found, std::regex(pattern)) ? found[1].str() : std::string();
  };
  std::string wanted = find("(?:size|allocate) ([0-9.]+ ?[KMGT]?i?B?)");
  if (!wanted.empty() && wanted.back() != 'B') wanted += "iB";
  if (wanted.empty()) wanted = "memory";
  if (const std::string name = find("label[ =]\"([^\"]*)\""); !name.empty()) wanted += " for the array " + name;
  if (const std::string space = find("(?:MemorySpace named \"|ERROR: )(\\w+)"); !space.empty())
    wanted += ", in memory of " + space;
  return wanted;
}

void expect_memory(double bytes, const std::string& what, const std::string& mend, double available) {
  if (bytes <= available) return;
  throw MemoryShortage(fmt::format("{} about {} of memory, but this machine has {} left; {}", what, bytes_text(bytes),
                                   bytes_text(available), mend));
}

void expect_memory(double bytes, const std::string& what, const std::string& mend) {
  constexpr double always_there = 64e6;  // spares small wishes a look at the system's files
  if (bytes > always_there) expect_memory(bytes, what, mend, available_memory());
}

}  // namespace railwave
