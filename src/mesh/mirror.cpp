#include "mesh/mirror.hpp"

#include <utility>

namespace railwave {

void mirror(Mesh& mesh) {
  for (Vec3& x : mesh.nodes) x[1] = -x[1];
  for (auto& corners : mesh.elements)
    for (int i = 0; i < 4; ++i) std::swap(corners[i], corners[i + 4]);
  for (auto& [name, faces] : mesh.surfaces)
    for (Face& face : faces)
      if (face.side < 2) face.side = 1 - face.side;
}

}  // namespace railwave
