#include <algorithm>
#include <cmath>

#include "case/track_entries.hpp"

namespace railwave::case_file {
namespace {

using scene::RailSide;
using scene::Track;
using scene::Vec3;

// Of the bolt's diameter.
constexpr double head_reach = 0.75;  ///< from its axis to the side of a nut
constexpr double head_height = 0.6;  ///< of the beam's end above the plate
constexpr double spoke_radius = 0.125;
/// Of a node set that nothing bounds across the plate.
constexpr double wide = 0.05;

const char* text_of(RailSide side) { return side == RailSide::left ? "left" : "right"; }

double middle_of_chamber(const std::string& section) { return section == "60E1" ? 0.076 : 0.070; }

/// Where a point of the upright section lies, y counted outwards; sides are those before a mirrored track is mirrored.
Vec3 placed(const Track& track, double x, RailSide side, double outwards, double z) {
  const double angle = std::atan(track.rail.inclination), y = side == RailSide::left ? -outwards : outwards;
  const Vec3& at = track.position;
  const double across = y * std::cos(angle) - z * std::sin(angle);
  return {at[0] + x, at[1] + (track.mirror ? -across : across), at[2] + y * std::sin(angle) + z * std::cos(angle)};
}

void add_plate(TrackEntries& entries, const std::string& material, RailSide side) {
  const Track& track = entries.track;
  scene::Scene& scene = entries.scene;
  scene::MeshSource mesh;
  mesh.name = entries.own(std::string("fishplate_") + text_of(side));
  mesh.type = scene::MeshType::fishplate;
  auto& plate = mesh.fishplate;
  plate.rail = entries.own("rail");
  plate.side = side;
  plate.start = *track.gap_position - 0.5 * track.fishplate_length;
  plate.end = *track.gap_position + 0.5 * track.fishplate_length;
  plate.thickness = track.fishplate_thickness;
  plate.clearance = track.fishplate_clearance;
  plate.size = track.fishplate_size;
  plate.gap_start = *track.gap_position - 0.5 * track.gap;
  plate.gap_end = *track.gap_position + 0.5 * track.gap;
  entries.add(scene.meshes, "meshes", mesh);
  entries.add_part(mesh.name, mesh.name, track.fishplate_material.empty() ? material : track.fishplate_material,
                   track.position);
  // Bolts press on single nodes, and go on doing so: viscous control would give way for ever.
  scene.parts.back().take_hourglass(scene::HourglassType::stiffness);

  for (const char* behind : {"", "_2"}) {
    const auto fit = [&](auto one) {
      one.name = mesh.name + behind;
      one.slave = mesh.name + ".fishing" + behind;
      one.master = entries.own("rail") + behind + ".fishing_" + text_of(side);
      return one;
    };
    if (track.fishplate_fit == scene::FishplateFit::tie) {
      auto tie = fit(scene::Tie{});
      if (track.fishplate_clearance > 0) tie.max_distance = 1.5 * track.fishplate_clearance;
      entries.add(scene.ties, "ties", tie);
    } else {
      auto contact = fit(scene::Contact{});
      contact.friction = track.fishplate_friction;
      entries.add(scene.contacts, "contacts", contact);
    }
  }
}

void add_bolt(TrackEntries& entries, const std::string& material, double x, int number) {
  const Track& track = entries.track;
  scene::Scene& scene = entries.scene;
  const double d = track.bolt_diameter, z = track.bolt_height.value_or(middle_of_chamber(track.rail.section));
  const double outside = half_web(track.rail.section) + track.fishplate_clearance + track.fishplate_thickness;
  scene::Beam shank;
  shank.name = entries.own("bolt", number);
  shank.material = material;
  shank.radius = 0.5 * d;
  shank.pretension = track.bolt_pretension;
  shank.from = shank.name + "_left";
  shank.to = shank.name + "_right";
  entries.add(scene.beams, "beams", shank);
  for (RailSide side : {RailSide::left, RailSide::right}) {
    scene::PointMass end;
    end.name = shank.name + "_" + text_of(side);
    end.position = placed(track, x, side, outside + head_height * d, z);
    entries.add(scene.points, "points", end);

    scene::NodeSet head;
    head.name = fmt::format("bolt_{}", number);
    head.part = entries.own(std::string("fishplate_") + text_of(side));
    head.surface = "outer";
    const Vec3 middle = placed(track, x, side, outside, z);
    // However coarse the plate is, some nodes must be under the head.
    const Vec3 half{std::max(head_reach * d, 0.51 * track.fishplate_size.value_or(3 * track.rail.zone_size)), wide,
                    std::max(head_reach * d, 0.75 * track.rail.section_size)};
    head.box.emplace();
    for (int i = 0; i < 3; ++i) (*head.box)[0][i] = middle[i] - half[i], (*head.box)[1][i] = middle[i] + half[i];
    // Both plates have a set of this name.
    head.line = track.line;
    scene.node_sets.push_back(head);

    scene::Beam spokes;
    spokes.name = end.name;
    spokes.material = material;
    spokes.radius = spoke_radius * d;
    spokes.from = end.name;
    spokes.to = head.part + "." + head.name;
    entries.add(scene.beams, "beams", spokes);
  }
}

}  // namespace

double half_web(const std::string& section) { return section == "60E1" ? 0.00825 : 0.008; }

void add_joint(TrackEntries& entries, const std::string& material) {
  for (RailSide side : {RailSide::left, RailSide::right}) add_plate(entries, material, side);
  const Track& track = entries.track;
  for (std::size_t k = 0; k < track.bolt_positions.size(); ++k)
    add_bolt(entries, material, *track.gap_position + track.bolt_positions[k], static_cast<int>(k) + 1);
}

}  // namespace railwave::case_file
