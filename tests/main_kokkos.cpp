// Entry of the test programs that use Kokkos: it lives from before the first test until after the last.

#include <Kokkos_Core.hpp>
#include <catch2/catch_session.hpp>
#include <cstdlib>

int main(int argc, char* argv[]) {
  Catch::Session session;
  const int status = session.applyCommandLine(argc, argv);
  if (status != 0) return status;

  // A mere listing of the tests must work on a machine without the device that they need.
  const auto& options = session.configData();
  if (options.listTests || options.listTags || options.listReporters || options.listListeners || options.showHelp) {
    return session.run();
  }
  // Kokkos 3 warns on every start when this is not said. Several tests run at once, so no binding.
  setenv("OMP_PROC_BIND", "false", 0);
  const Kokkos::ScopeGuard kokkos;
  return session.run();
}
