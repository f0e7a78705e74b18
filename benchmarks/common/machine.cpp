#include "benchmarks/common/machine.hpp"

#include <chrono>
#include <cstdlib>
#include <ctime>
#include <fstream>

#include "kernels/support/spaces.hpp"

namespace railwave::bench {
namespace {

constexpr bool on_device = !Kokkos::SpaceAccessibility<Kokkos::HostSpace, MemorySpace>::accessible;

std::string processor_name() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);)
    if (line.rfind("model name", 0) == 0) return line.substr(line.find(':') + 2);
  return "unknown processor";
}

std::string processor_family() {
  std::string family, model;
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);) {
    if (line.rfind("cpu family", 0) == 0 && family.empty()) family = line.substr(line.find(':') + 2);
    if (line.rfind("model\t", 0) == 0 && model.empty()) model = line.substr(line.find(':') + 2);
  }
  return "family " + family + " model " + model;
}

std::string device_name() {
#ifdef KOKKOS_ENABLE_CUDA
  return ExecutionSpace().cuda_device_prop().name;
#else
  return processor_name() + " (" + processor_family() + ")";
#endif
}

std::string compiler() {
#if defined(__clang__)
  std::string name = std::string("clang ") + __clang_version__;
#elif defined(__GNUC__)
  std::string name = std::string("g++ ") + __VERSION__;
#else
  std::string name = "unknown";
#endif
#ifdef RAILWAVE_BENCH_CUDA_COMPILER
  name = std::string("nvcc ") + RAILWAVE_BENCH_CUDA_COMPILER + " with " + name;
#endif
  return name;
}

/// The widest vectors that the compiler was allowed to use.
std::string vectors() {
#if defined(KOKKOS_ENABLE_CUDA)
  return "none (device)";
#elif defined(__AVX512F__)
  return "AVX-512";
#elif defined(__AVX2__)
  return "AVX2";
#elif defined(__SSE2__)
  return "SSE2";
#elif defined(__ARM_FEATURE_SVE)
  return "SVE";
#elif defined(__ARM_NEON)
  return "NEON";
#else
  return "plain";
#endif
}

std::string environment(const char* name) {
  const char* value = std::getenv(name);
  return value == nullptr ? "unset" : value;
}

std::string now() {
  const std::time_t time = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
  char text[32];
  std::strftime(text, sizeof text, "%Y-%m-%d %H:%M UTC", std::gmtime(&time));
  return text;
}

/// Without the folders before the program's name, which differ from machine to machine.
std::string command(int count, char** arguments) {
  std::string line = arguments[0];
  line = line.substr(line.rfind('/') + 1);
  for (int i = 1; i < count; ++i) {
    const std::string argument = arguments[i];
    if (argument == "--csv") {
      ++i;
      continue;
    }
    line += " " + argument;
  }
  return line;
}

}  // namespace

int host_threads() { return on_device ? 0 : ExecutionSpace().concurrency(); }

std::string load_average() {
  std::ifstream file("/proc/loadavg");
  std::string value;
  return file >> value ? value : "unknown";
}

std::vector<std::pair<std::string, std::string>> describe_machine(int count, char** arguments) {
  std::vector<std::pair<std::string, std::string>> facts;
  facts.emplace_back("command", command(count, arguments));
  facts.emplace_back("date", now());
  facts.emplace_back("back end", ExecutionSpace::name());
  facts.emplace_back("device", device_name());
  if (on_device) {
    facts.emplace_back("host", processor_name() + " (" + processor_family() + ")");
  } else {
    facts.emplace_back("threads", std::to_string(host_threads()));
    facts.emplace_back("OMP_PROC_BIND", environment("OMP_PROC_BIND"));
  }
  facts.emplace_back("vectors", vectors());
  facts.emplace_back("compiler", compiler());
  facts.emplace_back("options", RAILWAVE_BENCH_OPTIONS);
  facts.emplace_back("Kokkos", std::to_string(KOKKOS_VERSION / 10000) + "." +
                                   std::to_string(KOKKOS_VERSION / 100 % 100) + "." +
                                   std::to_string(KOKKOS_VERSION % 100));
  facts.emplace_back("load average before", load_average());
  return facts;
}

}  // namespace railwave::bench
