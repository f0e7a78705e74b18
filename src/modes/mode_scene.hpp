#pragma once

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

}  // namespace railwave
