#include <fmt/format.h>

#include <cmath>

#include "case/error.hpp"
#include "mesh/hexahedron.hpp"
#include "model/build_steps.hpp"
#include "model/host_copy.hpp"

namespace railwave {
namespace {

/// Stiffness hourglass control of a set whose own control is viscous, while it settles.
constexpr double settling_coefficient = 0.05;

double viscous_scale(double coefficient, double density, double wave_speed, double volume) {
  return 0.25 * coefficient * density * wave_speed * std::pow(volume, 2.0 / 3.0);
}

double stiffness_scale(double coefficient, double modulus, double volume) {
  return coefficient * modulus * std::cbrt(volume) / 16.0;
}

/// Elements whose Jacobian is not positive at the eight Gauss points cannot be integrated; a mere concave corner can
/// (the inner nodes of MacNeal & Harder's patch have one), and `railwave check` reports it.
void check_element(const Model& model, const Assembly::PartRange& part, int element, const HexahedronCorners& corners) {
  const double g = 1 / std::sqrt(3.0);
  for (const auto& s : hexahedron_corner_signs) {
    if (hexahedron_jacobian(corners, g * s[0], g * s[1], g * s[2]) > 0) continue;
    throw InputError(fmt::format(
        "{}: part '{}': element {} (counted from 0 in its mesh) near ({:.6g}, {:.6g}, {:.6g}) m is inverted or flat; "
        "mend the mesh there, or number the element's corners bottom face first, then the top face, both turning the same way",
        model.scene.path, part.name, element - part.first_element, corners[0][0], corners[0][1], corners[0][2]));
  }
}

}  // namespace

void build_elements(Model& model) {
  const Assembly& assembly = model.assembly;
  model.mass.assign(assembly.nodes.size(), 0);
  model.element_length.resize(assembly.elements.size());
  long force_offset = 0;
  for (std::size_t p = 0; p < assembly.parts.size(); ++p) {
    const auto& range = assembly.parts[p];
    const scene::Part& part = model.scene.parts[p];
    const scene::Material& material = model.scene.materials[range.material];
    ElementSet set;
    set.part = range.name;
    set.first_element = range.first_element;
    set.hourglass = part.hourglass;
    const double modulus = material.dilatational_modulus(), wave_speed = material.dilatational_speed();
    set.constants = {modulus - 2 * material.shear_modulus(), material.shear_modulus()};

    const int count = range.element_count;
    const int tiles = (count + tile_width - 1) / tile_width;
    std::vector<int> corners(static_cast<std::size_t>(tiles) * tile_width * 8);
    std::vector<double> scale(static_cast<std::size_t>(tiles) * tile_width), settling(scale.size());
    for (int slot = 0; slot < tiles * tile_width; ++slot) {
      const int e = range.first_element + std::min(slot, count - 1);
      const int tile = slot / tile_width, lane = slot % tile_width;
      for (int N = 0; N < 8; ++N)
        corners[(static_cast<std::size_t>(tile) * 8 + N) * tile_width + lane] = assembly.elements[e][N];
      const HexahedronCorners x = corners_of(assembly.nodes, assembly.elements[e]);
      const auto integrals = hexahedron_shape_integrals(x);
      double volume = 0;
      for (double part_of_it : integrals) volume += part_of_it;
      const double own = part.hourglass_coefficient;
      const bool viscous = part.hourglass == scene::HourglassType::viscous;
      scale[slot] = viscous ? viscous_scale(own, material.density, wave_speed, volume) : stiffness_scale(own, modulus, volume);
      settling[slot] = stiffness_scale(viscous ? settling_coefficient : own, modulus, volume);
      if (slot >= count) continue;
      check_element(model, range, e, x);
      model.element_length[e] = hexahedron_length(x);
      // Lumped mass by row sums (thesis 2.2.2).
      for (int N = 0; N < 8; ++N) model.mass[assembly.elements[e][N]] += material.density * integrals[N];
    }
    set.arrays.element_count = count;
    set.arrays.tile_count = tiles;
    set.arrays.force_offset = force_offset;
    set.arrays.corners = to_device("corners", corners);
    set.arrays.hourglass_scale = to_device("hourglass scale", scale);
    set.arrays.hourglass_energy = Array<double*>("hourglass energy", scale.size());
    set.settling_hourglass = to_device("hourglass scale while settling", settling);
    force_offset += static_cast<long>(tiles) * tile_width * 24;
    model.elements.push_back(set);
  }
  for (std::size_t i = 0; i < model.scene.points.size(); ++i)
    model.mass[assembly.point_nodes[i]] = model.scene.points[i].mass;
  model.corner_force = Array<double*>("corner force", force_offset);
}

}  // namespace railwave
