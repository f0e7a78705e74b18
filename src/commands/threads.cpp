#include "commands/threads.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <limits>
#include <optional>
#include <string>
#include <thread>

#ifdef _OPENMP
#include <omp.h>
#endif

#include "case/error.hpp"
#include "case/memory.hpp"
#include "case/number_text.hpp"
#include "commands/process.hpp"

namespace railwave {
namespace {

/// What a user has set; a variable that is set to nothing counts as not set.
std::optional<std::string> said(const char* name) {
  const char* const text = std::getenv(name);
  if (!text || !*text) return std::nullopt;
  return text;
}

/// A whole number without anything around it but blanks.
std::optional<double> whole_number(const std::string& text) {
  const auto first = text.find_first_not_of(" \t"), last = text.find_last_not_of(" \t");
  if (first == std::string::npos) return std::nullopt;
  const std::string digits = text.substr(first, last - first + 1);
  if (!std::all_of(digits.begin() + (digits[0] == '+'), digits.end(),
                   [](unsigned char c) { return std::isdigit(c); }) ||
      digits == "+")
    return std::nullopt;
  return parse_real(digits);
}

[[noreturn]] void refuse(const char* name, const std::string& text, const std::string& why) {
  constexpr std::size_t shown = 40;
  throw InputError(fmt::format("the environment variable {} is '{}': {}", name,
                               text.size() > shown ? text.substr(0, shown) + "..." : text, why));
}

/// The first of a list: OpenMP takes one number for each level of threads within threads, of which there is one here.
std::optional<int> threads_in(const char* name, bool list) {
  const auto text = said(name);
  if (!text) return std::nullopt;
  std::optional<double> first;
  for (std::size_t at = 0; at <= text->size();) {
    const std::size_t comma = list ? std::min(text->find(',', at), text->size()) : text->size();
    const auto number = whole_number(text->substr(at, comma - at));
    if (!number || *number < 1 || *number > most_threads)
      refuse(name, *text,
             fmt::format("a number of threads from 1 to {} is wanted; this machine has {} processors; unset it for a "
                         "thread on each",
                         most_threads, std::thread::hardware_concurrency()));
    if (!first) first = number;
    at = comma + 1;
  }
  return static_cast<int>(*first);
}

/// Bytes: a number and B, K, M or G; kilobytes without a letter.
void check_thread_stack(const char* name) {
  const auto text = said(name);
  if (!text) return;
  const std::string wanted =
      fmt::format("a size of at least {} kB is wanted, such as 8M; unset it for the usual one", smallest_stack / 1024);
  std::string number = *text;
  while (!number.empty() && std::isspace(static_cast<unsigned char>(number.back()))) number.pop_back();
  double unit = 1024;
  if (!number.empty() && std::isalpha(static_cast<unsigned char>(number.back()))) {
    const std::string letters = "BKMG";
    const auto letter = letters.find(static_cast<char>(std::toupper(static_cast<unsigned char>(number.back()))));
    if (letter == std::string::npos) refuse(name, *text, wanted);
    unit = std::pow(1024.0, static_cast<double>(letter));
    number.pop_back();
  }
  const auto size = whole_number(number);
  if (!size || *size * unit < static_cast<double>(smallest_stack)) refuse(name, *text, wanted);
  if (*size * unit > available_memory())
    refuse(name, *text,
           fmt::format("no thread can have a stack of {}; this machine has {} left; {}", bytes_text(*size * unit),
                       bytes_text(available_memory()), wanted));
}

/// Kokkos' own choice among devices. @param least of the first number; the second is the device to skip
void check_devices(const char* name, double least, bool second) {
  const auto text = said(name);
  if (!text) return;
  const std::size_t comma = second ? text->find(',') : std::string::npos;
  const auto number = whole_number(text->substr(0, comma));
  const bool rest = comma == std::string::npos || whole_number(text->substr(comma + 1));
  if (!number || !rest || *number < least || *number > std::numeric_limits<int>::max())
    refuse(name, *text,
           fmt::format("a whole number from {:.0f} on is wanted; unset it to leave the choice to Kokkos", least));
}

void check_device() {
  check_devices("KOKKOS_DEVICE_ID", 0, false);
  check_devices("KOKKOS_NUM_DEVICES", 1, true);
  check_devices("KOKKOS_RAND_DEVICES", 1, true);
  check_devices("KOKKOS_SKIP_DEVICE", 0, false);
  check_devices("KOKKOS_NUMA", 1, false);
  // An empty one Kokkos takes for a number that it cannot read.
  for (const char* name : {"KOKKOS_DEVICE_ID", "KOKKOS_NUM_DEVICES", "KOKKOS_RAND_DEVICES", "KOKKOS_SKIP_DEVICE",
                           "KOKKOS_NUMA", "KOKKOS_NUM_THREADS"})
    if (!said(name)) unsetenv(name);
}

void note(const std::string& text) { std::cerr << "railwave: " << text << '\n'; }

}  // namespace

KokkosScope::Prepared::Prepared() {
  const auto by_openmp = threads_in("OMP_NUM_THREADS", true), by_kokkos = threads_in("KOKKOS_NUM_THREADS", false);
  for (const char* name : {"OMP_STACKSIZE", "GOMP_STACKSIZE"}) check_thread_stack(name);
  check_device();
#ifdef _OPENMP
  const auto asked = by_kokkos ? by_kokkos : by_openmp;
  int count = asked ? *asked : std::min(omp_get_max_threads(), most_threads);
  if (count > omp_get_thread_limit()) {
    note(fmt::format("{} threads were asked for, OMP_THREAD_LIMIT allows {}, which are taken", count,
                     omp_get_thread_limit()));
    count = omp_get_thread_limit();
  }
  const int processors = omp_get_num_procs();
  if (count > processors)
    note(fmt::format("{} threads are asked for, but this process may use {} {}: they will wait for each other", count,
                     processors, processors == 1 ? "processor" : "processors"));
  // Kokkos counts on as many as it found at its start. It would tell the same as we, on stdout among the output.
  omp_set_dynamic(0);
  omp_set_num_threads(count);
  unsetenv("KOKKOS_NUM_THREADS");
  setenv("KOKKOS_DISABLE_WARNINGS", "1", 0);
#endif
}

KokkosScope::KokkosScope() = default;

}  // namespace railwave
