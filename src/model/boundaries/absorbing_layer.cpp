#include "model/boundaries/absorbing_boundaries.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "case/error.hpp"
#include "mesh/vectors.hpp"

namespace railwave {
namespace {

/// Cosine of the angle, 10 degrees, by which faces of an end may lean from its plane.
constexpr double leaning = 0.985;
/// A layer absorbs a bending wave as well over so many wavelengths as it absorbs a longitudinal wave over one.
constexpr double lengths_of_bending = 2;
/// Elements along a layer, at least: with fewer, damping grows from one to the next in large steps, which reflect
/// waves.
constexpr double few_elements = 6;
/// A part is a bar if its length along an end's normal is more than so many times its largest extent across.
constexpr double slender = 3;

using Zone = AbsorbingLayers::Zone;

[[noreturn]] void refuse(const scene::Scene& scene, const scene::AbsorbingLayer& layer, const std::string& what) {
  throw InputError(fmt::format("{}:{}: [absorbing_layers.{}] {}", scene.path, layer.line, layer.name, what));
}

struct Plane {
  Vec3 middle{0, 0, 0}, normal{0, 0, 0};
};

/// Middle and mean normal of a surface, weighted by area.
Plane plane_of(const Assembly& assembly, const std::vector<Face>& surface) {
  Plane plane;
  double area = 0;
  for (const Face& face : surface) {
    const Vec3 own = doubled_area(assembly.nodes, assembly.face_nodes(face));
    area += length(own);
    for (int n : assembly.face_nodes(face))
      for (int i = 0; i < 3; ++i) plane.middle[i] += 0.25 * length(own) * assembly.nodes[n][i];
    for (int i = 0; i < 3; ++i) plane.normal[i] += own[i];
  }
  const double size = length(plane.normal);
  for (int i = 0; i < 3; ++i) {
    plane.middle[i] /= area;
    plane.normal[i] = size > 0 ? plane.normal[i] / size : 0;
  }
  return plane;
}

double distance_from(const Plane& plane, const Vec3& x) { return dot(difference(plane.middle, x), plane.normal); }

/// Longest of the elements at an end along its normal, m.
double element_at(const Assembly& assembly, const std::vector<Face>& surface, const Plane& plane) {
  double most = 0;
  for (const Face& face : surface)
    for (int n : assembly.elements[face.element]) most = std::max(most, distance_from(plane, assembly.nodes[n]));
  return most;
}

Zone zone_of(const scene::Scene& scene, const Assembly& assembly, int number, std::vector<double>& rate) {
  const scene::AbsorbingLayer& layer = scene.absorbing_layers[number];
  const auto& surface = find_surface(scene, assembly, layer, "target", layer.target);
  const Plane plane = plane_of(assembly, surface);
  for (const Face& face : surface)
    if (const Vec3 own = doubled_area(assembly.nodes, assembly.face_nodes(face));
        !(dot(own, plane.normal) > leaning * length(own)))
      refuse(scene, layer,
             fmt::format("target: '{}' is no plane: its faces lean from each other by more than 10 degrees, so that no "
                         "distance from it is meant; name a plane end",
                         layer.target));
  Zone zone;
  zone.layer = number;
  zone.part = part_of_element(assembly, surface[0].element);
  zone.end = plane.middle;
  zone.outwards = plane.normal;
  zone.element = element_at(assembly, surface, plane);
  const auto& part = assembly.parts[zone.part];
  zone.rate = 4 * scene.materials[part.material].dilatational_speed() * std::log(1 / layer.reflection) / layer.length;
  const double rounding = 1e-6 * zone.element;
  int inner = 0;
  for (int n = part.first_node; n < part.first_node + part.node_count; ++n) {
    const double away = distance_from(plane, assembly.nodes[n]);
    if (away < -rounding || away > layer.length - rounding) continue;
    const double share = std::min(1.0, 1 - away / layer.length);
    rate[n] = std::max(rate[n], zone.rate * share * share * share);
    ++zone.nodes;
    inner += away > 0.5 * zone.element;
  }
  if (inner == 0)
    refuse(scene, layer,
           fmt::format("length: {:.4g} m is less than the elements at '{}' are long ({:.4g} m), so that the layer "
                       "holds no more than the end's own nodes; make it at least {:.4g} m "
                       "({:.0f} elements)",
                       layer.length, layer.target, zone.element, few_elements * zone.element, few_elements));
  return zone;
}

void refuse_filled_parts(const scene::Scene& scene, const Assembly& assembly, const AbsorbingLayers& layers) {
  for (const Zone& zone : layers.zones) {
    const auto& part = assembly.parts[zone.part];
    const auto begin = layers.rate.begin() + part.first_node;
    if (std::all_of(begin, begin + part.node_count, [](double rate) { return rate > 0; })) {
      const scene::AbsorbingLayer& layer = scene.absorbing_layers[zone.layer];
      refuse(
          scene, layer,
          fmt::format("length: {:.4g} m leaves nothing of part {} undamped; make the layer shorter, or the part longer",
                      layer.length, part.name));
    }
  }
}

/// The length of a part along a direction, and its largest extent across it, m.
struct Extents {
  double along = 0, across = 0;
};

Extents extents_of(const Assembly& assembly, const std::vector<Face>& surface, const Plane& plane) {
  Extents extents;
  const auto& part = assembly.parts[part_of_element(assembly, surface[0].element)];
  for (int n = part.first_node; n < part.first_node + part.node_count; ++n)
    extents.along = std::max(extents.along, distance_from(plane, assembly.nodes[n]));
  Vec3 low{1e300, 1e300, 1e300}, high{-1e300, -1e300, -1e300};
  for (int n : surface_nodes(assembly, surface))
    for (int i = 0; i < 3; ++i) {
      low[i] = std::min(low[i], assembly.nodes[n][i]);
      high[i] = std::max(high[i], assembly.nodes[n][i]);
    }
  for (int i = 0; i < 3; ++i) extents.across = std::max(extents.across, high[i] - low[i]);
  return extents;
}

/// Upper bound of the share of amplitude that a layer reflects of a longitudinal wave as long as itself: what damping
/// leaves, or what the growth of damping reflects (docs/verification.md).
double sent_back(double reflection) { return reflection < 0.005 ? 0.05 : std::max(0.02, reflection); }

double bar_speed(const scene::Material& material) { return std::sqrt(material.youngs_modulus / material.density); }

}  // namespace

AbsorbingLayers absorbing_layers(const scene::Scene& scene, const Assembly& assembly) {
  AbsorbingLayers layers;
  if (scene.absorbing_layers.empty()) return layers;
  layers.rate.assign(assembly.nodes.size(), 0.0);
  for (int k = 0; k < static_cast<int>(scene.absorbing_layers.size()); ++k)
    layers.zones.push_back(zone_of(scene, assembly, k, layers.rate));
  refuse_filled_parts(scene, assembly, layers);
  return layers;
}

std::vector<std::string> describe_absorbing_layers(const AssembledScene& assembled, const AbsorbingLayers& absorbing) {
  std::vector<std::string> lines;
  for (const Zone& zone : absorbing.zones) {
    const scene::AbsorbingLayer& layer = assembled.scene.absorbing_layers[zone.layer];
    const double speed = bar_speed(assembled.scene.materials[assembled.assembly.parts[zone.part].material]);
    lines.push_back(
        fmt::format("[absorbing_layers.{}]: {} nodes of {} within {:.4g} m of '{}', {:.1f} elements deep, damped by up "
                    "to {:.4g} 1/s; of waves no longer "
                    "than the layer (longitudinal: above {:.4g} Hz), and of bending waves no longer than {:.4g} m, it "
                    "sends back {:.2g} % at most",
                    layer.name, zone.nodes, assembled.assembly.parts[zone.part].name, layer.length, layer.target,
                    layer.length / zone.element, zone.rate, speed / layer.length, layer.length / lengths_of_bending,
                    100 * sent_back(layer.reflection)));
  }
  return lines;
}

std::vector<std::string> describe_slender_ends(const AssembledScene& assembled, const AbsorbingLayers& absorbing) {
  std::vector<std::string> lines;
  for (const scene::NonReflecting& end : assembled.scene.non_reflecting) {
    const auto& surface = find_surface(assembled.scene, assembled.assembly, end, "target", end.target);
    const int part = part_of_element(assembled.assembly, surface[0].element);
    const Plane plane = plane_of(assembled.assembly, surface);
    const auto covers = [&](const Zone& zone) {
      return zone.part == part && dot(zone.outwards, plane.normal) > leaning &&
             std::fabs(distance_from(plane, zone.end)) < zone.element;
    };
    if (std::any_of(absorbing.zones.begin(), absorbing.zones.end(), covers)) continue;
    const Extents extents = extents_of(assembled.assembly, surface, plane);
    if (!(extents.along > slender * extents.across)) continue;
    const scene::Material& material = assembled.scene.materials[assembled.assembly.parts[part].material];
    lines.push_back(
        fmt::format("[non_reflecting.{}] (line {}) lets out waves of the continuum ({:.0f} and {:.0f} m/s), but part "
                    "{} is slender ({:.3g} m long, {:.3g} m across): its longitudinal "
                    "waves go at {:.0f} m/s and come back by {:.0f} % of their amplitude at least, and bending waves "
                    "by more; [absorbing_layers.{}] with target = \"{}\" and a length of "
                    "one or two wavelengths takes these too",
                    end.name, end.line, material.dilatational_speed(), material.shear_speed(),
                    assembled.assembly.parts[part].name, extents.along, extents.across, bar_speed(material),
                    100 * (material.dilatational_speed() - bar_speed(material)) /
                        (material.dilatational_speed() + bar_speed(material)),
                    end.name, end.target));
  }
  return lines;
}

std::vector<std::string> absorbing_doubts(const AssembledScene& assembled, const AbsorbingLayers& absorbing) {
  std::vector<std::string> doubts;
  for (const Zone& zone : absorbing.zones) {
    const scene::AbsorbingLayer& layer = assembled.scene.absorbing_layers[zone.layer];
    const std::string& part = assembled.assembly.parts[zone.part].name;
    if (layer.length < few_elements * zone.element)
      doubts.push_back(
          fmt::format("[absorbing_layers.{}] (line {}) is {:.2g} elements deep ({:.4g} m of {:.4g} m each), over which "
                      "its damping grows in large steps that send waves back; make it at "
                      "least {:.0f} elements deep",
                      layer.name, layer.line, layer.length / zone.element, layer.length, zone.element, few_elements));
    for (const scene::InitialMotion& motion : assembled.scene.initial_motions)
      if (std::find(motion.parts.begin(), motion.parts.end(), part) != motion.parts.end() &&
          (length(motion.velocity) > 0 || length(motion.angular_velocity) > 0))
        doubts.push_back(
            fmt::format("[absorbing_layers.{}] (line {}) is in part {}, which [initial_motion.{}] (line {}) sets off: "
                        "the layer slows its rigid motion as well as waves; absorb in "
                        "bodies that rest",
                        layer.name, layer.line, part, motion.name, motion.line));
  }
  return doubts;
}

}  // namespace railwave
