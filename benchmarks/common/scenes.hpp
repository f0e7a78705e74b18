#pragma once

#include <functional>
#include <string>
#include <vector>

#include "model/model.hpp"

namespace railwave::bench {

/// What a part can be computed with.
struct Choice {
  std::string hourglass = "viscous";  ///< or "stiffness"
  std::string precision = "double";   ///< or "mixed", "float"
  std::string material = "elastic";   ///< or "bilinear"
};

/// Folder of this project, where cases/ and benchmarks/cases/ lie.
std::string project_folder();

/// Overrides of a case file (`section.key=value`) for a choice; `part` and `material` as named in the file.
std::vector<std::string> overrides_of(const Choice& choice, const std::vector<std::string>& parts,
                                      const std::string& material);

/// A block of about `elements` cubes of 1 mm, without anything else. Throws InputError when this build does not know
/// the choice.
scene::Scene block_scene(long elements, const Choice& choice);

/// A block of given size and divisions.
scene::Scene block_scene(const Vec3& size, const std::array<int, 3>& divisions, const Choice& choice);

/// Gives every node a velocity by its reference place, m/s.
void set_velocity(Model& model, const std::function<Vec3(const Vec3&)>& field);

/// A smooth motion of a few mm/s of all nodes, so that every number in the loop is an ordinary one.
void stir(Model& model);

}  // namespace railwave::bench
