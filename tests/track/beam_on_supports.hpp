#pragma once

#include <Eigen/Dense>
#include <algorithm>

#include "case/expand.hpp"
#include "mesh/sections/section.hpp"
#include "model/host_copy.hpp"
#include "model/model.hpp"

/// A rail on sleepers as a beam on discrete supports, and what a model's ballast carries.
namespace railwave::verify {

/// Timoshenko's beam of n equal elements with exact nodal values: deflection and slope at each node.
inline Eigen::MatrixXd beam_stiffness(int elements, double length, double bending, double shear) {
  Eigen::MatrixXd whole = Eigen::MatrixXd::Zero(2 * elements + 2, 2 * elements + 2);
  const double l = length / elements, phi = 12 * bending / (shear * l * l), a = 6 * l, b = (4 + phi) * l * l,
               c = (2 - phi) * l * l;
  Eigen::Matrix4d one;
  one << 12, a, -12, a, a, b, -a, c, -12, -a, 12, -a, a, c, -a, b;
  one *= bending / ((1 + phi) * l * l * l);
  for (int e = 0; e < elements; ++e) whole.block<4, 4>(2 * e, 2 * e) += one;
  return whole;
}

/// Deflection of a sleeper's seat under a unit force spread over the foot: half a beam on a bed, without slope at the
/// middle of the track.
inline double seat_compliance(const scene::Sleeper& kind, const scene::Material& material, double rail_distance,
                              double foot) {
  const int elements = 200;
  const double area = *kind.width * *kind.height,
               bending = material.youngs_modulus * area * *kind.height * *kind.height / 12;
  Eigen::MatrixXd k = beam_stiffness(elements, *kind.half_length, bending, 5.0 / 6 * material.shear_modulus() * area);
  Eigen::VectorXd load = Eigen::VectorXd::Zero(k.rows());
  for (int n = 0; n <= elements; ++n) {
    k(2 * n, 2 * n) += *kind.ballast_stiffness / elements * (n == 0 || n == elements ? 0.5 : 1);
    if (std::fabs(*kind.half_length * n / elements - rail_distance) <= 0.5 * foot) load[2 * n] = 1;
  }
  load /= load.sum();
  k(1, 1) *= 1e9;
  return load.dot(k.ldlt().solve(load));
}

/// A track's half sleepers and rail as beams. Loads are in N, downwards, and so are deflections in m.
struct BeamOnSupports {
  Eigen::MatrixXd stiffness;
  double start, length;
  static constexpr int elements = 480;

  /// @param material of the sleepers, by name; of one kind all
  BeamOnSupports(const scene::Scene& scene, const Model& model, const std::string& rail, const std::string& sleepers)
      : start(scene.tracks[0].rail.start), length(scene.tracks[0].rail.end - start) {
    const scene::Track& track = scene.tracks[0];
    const auto part = std::find_if(model.assembly.parts.begin(), model.assembly.parts.end(),
                                   [&](const auto& p) { return p.name == rail; });
    const scene::Material& steel = scene.materials[part->material];
    Mesh mesh;
    mesh.nodes = model.assembly.nodes;
    mesh.elements = model.assembly.elements;
    const SectionProperties section = section_properties(mesh, model.assembly.surfaces.at(rail + ".start_face"));
    // Cowper's shear coefficient for rails is close to 0.4 (vertical, 54E1).
    stiffness = beam_stiffness(elements, length, steel.youngs_modulus * section.moment_y,
                               0.4 * steel.shear_modulus() * section.area);
    const scene::Sleeper kind = case_file::sleeper_of(scene, track.sleeper);
    const auto& material = *std::find_if(scene.materials.begin(), scene.materials.end(),
                                         [&](const auto& m) { return m.name == sleepers; });
    support = 1 / (1 / (*kind.fastening_stiffness)[2] + seat_compliance(kind, material, track.rail_distance, 0.14));
    for (const auto& place : case_file::sleeper_places(track)) supports.push_back(node_at(place.x));
    for (int n : supports) stiffness(2 * n, 2 * n) += support;
    weight_per_length = steel.density * section.area;
    sleeper_drop = material.density * *kind.half_length * *kind.width * *kind.height / *kind.ballast_stiffness;
  }

  int node_at(double x) const { return static_cast<int>(std::lround((x - start) / length * elements)); }

  /// Deflection under a force at x; and, if gravity (m/s2) is given, under the weights of rail and sleepers too.
  double deflection(double x, double force, double gravity = 0) const {
    Eigen::VectorXd load = Eigen::VectorXd::Zero(stiffness.rows());
    load[2 * node_at(x)] = force;
    for (int n = 0; n <= elements; ++n)
      load[2 * n] += gravity * weight_per_length * length / elements * (n == 0 || n == elements ? 0.5 : 1);
    for (int n : supports) load[2 * n] += support * gravity * sleeper_drop;
    return stiffness.ldlt().solve(load)[2 * node_at(x)];
  }

  double support = 0;            ///< N/m: fastening and sleeper on its ballast
  double weight_per_length = 0;  ///< kg/m
  double sleeper_drop = 0;       ///< s2: how far a sleeper's own weight sinks it, over gravity
  std::vector<int> supports;
};

/// Vertical force of the ballast on the sleepers, N.
inline double ballast_force(const Model& model) {
  const auto force = to_host(model.connectors.arrays.force);
  double sum = 0;
  for (int c = 0; c < model.connectors.arrays.count; ++c)
    if (model.scene.connectors[model.connectors.cells[c].connector].name.find("ballast") != std::string::npos)
      sum += force(c, 2);
  return sum;
}

}  // namespace railwave::verify
