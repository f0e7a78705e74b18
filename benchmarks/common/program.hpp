#pragma once

#include <CLI/CLI.hpp>

#include <cstdlib>
#include <functional>
#include <iostream>

#include "benchmarks/common/machine.hpp"
#include "benchmarks/common/records.hpp"
#include "kernels/support/spaces.hpp"

namespace railwave::bench {

/// What every benchmark program shares: its arguments are read, Kokkos lives while it works, its records are written.
/// `work` returns whether its results (not its times) are as they must be; the exit code tells.
inline int run_program(const std::string& name, const std::string& about, int count, char** arguments,
                       const std::function<void(CLI::App&)>& add_options, const std::function<bool(Records&)>& work) {
  CLI::App app{about};
  std::string path;
  app.add_option("--csv", path, "file to write the results to");
  app.set_help_flag("--help", "print this");
  app.allow_extras(false);
  add_options(app);
  try {
    app.parse(count, arguments);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  try {
    // Kokkos warns where threads are not bound. The OpenMP runtime has read the variable already.
    const bool unbound = std::getenv("OMP_PROC_BIND") == nullptr;
    setenv("OMP_PROC_BIND", "false", 0);
    const Kokkos::ScopeGuard kokkos;
    if (unbound) unsetenv("OMP_PROC_BIND");
    const auto facts = describe_machine(count, arguments);
    for (const auto& [fact, value] : facts) std::cout << fact << ": " << value << '\n';
    std::cout << std::endl;
    Records records(name, path, facts);
    const bool right = work(records);
    records.fact("load average after", load_average());
    records.write();
    return right ? 0 : 1;
  } catch (const std::exception& error) {
    std::cerr << name << ": " << error.what() << '\n';
    return 1;
  }
}

}  // namespace railwave::bench
