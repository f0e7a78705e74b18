#pragma once

#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include "case/scene.hpp"

namespace railwave {

/// A scene as its small vibrations need it, and what that leaves aside.
struct ModeScene {
  scene::Scene scene;
  std::vector<std::string> notes;  ///< sentences for the reader
};

/// Loads, motions at the start, settling and output go; contacts stay only where a tie may need a gap closed. The rest
/// stays as far as it belongs to the named parts and point masses.
/// @param names parts and point masses; empty: all. Throws InputError for one that the scene does not have.
ModeScene mode_scene(const scene::Scene& scene, const std::vector<std::string>& names);

/// What `railwave modes` is asked for.
struct ModesRequest {
  std::vector<std::string> parts;          ///< and point masses; empty: all
  double up_to = 5000;                     ///< Hz
  std::optional<std::string> csv, shapes;  ///< files to write
  bool overwrite = false;                  ///< files of others too
};

/// Prints a table of the modes of a scene, and writes the files asked for; docs/modes.md describes them. Kokkos
/// must be up. Returns the exit code 0; throws InputError for a request that cannot be served.
int modes_command(const scene::Scene& scene, const ModesRequest& request, std::ostream& out);

}  // namespace railwave
