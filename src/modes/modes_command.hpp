#pragma once

#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include "case/scene.hpp"

namespace railwave {

/// What `railwave modes` is asked for.
struct ModesRequest {
  std::vector<std::string> parts;          ///< and point masses; empty: all
  double up_to = 5000;                     ///< Hz
  std::optional<std::string> csv, shapes;  ///< files to write
  bool overwrite = false;                  ///< files of others too
};

/// Prints a table of the modes of a scene, and writes the files asked for; docs/modes.md tells what they hold. Kokkos
/// must be up. Returns the exit code 0; throws InputError for a request that cannot be served.
int modes_command(const scene::Scene& scene, const ModesRequest& request, std::ostream& out);

}  // namespace railwave
