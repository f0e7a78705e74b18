#include <algorithm>
#include <cmath>

#include "case/solid_pad.hpp"
#include "case/track_entries.hpp"

namespace railwave::case_file {
namespace {

using scene::Vec3;

/// More than half of any foot's width, m.
constexpr double half_foot = 0.08;

void add_springs(TrackEntries& entries, const scene::Sleeper& kind, const RailSeat& seat, const Vec3& stiffness,
                 const Vec3& damping) {
  scene::Connector fastening;
  fastening.name = entries.own("fastening", seat.number);
  fastening.from = seat.sleeper + ".z_max";
  fastening.to = seat.rail + ".foot";
  fastening.stiffness = stiffness;
  fastening.damping = damping;
  fastening.spread = kind.fastening_spread;
  const double x = entries.track.position[0] + seat.x, half = 0.5 * *kind.pad_length;
  fastening.area = {{{x - half, -unbounded, -unbounded}, {x + half, unbounded, unbounded}}};
  entries.add(entries.scene.connectors, "connectors", fastening);
}

void add_tie(TrackEntries& entries, const std::string& name, const std::string& slave, const std::string& master,
             double max_distance) {
  scene::Tie tie;
  tie.name = name;
  tie.slave = slave;
  tie.master = master;
  tie.max_distance = max_distance;
  entries.add(entries.scene.ties, "ties", tie);
}

void add_pad(TrackEntries& entries, const scene::Sleeper& kind, const RailSeat& seat, double damping) {
  scene::MeshSource mesh;
  mesh.name = entries.own("pad", seat.number);
  mesh.type = scene::MeshType::rail_pad;
  mesh.rail_pad.rail = seat.rail;
  mesh.rail_pad.start = std::max(seat.x - 0.5 * *kind.pad_length, seat.rail_start);
  mesh.rail_pad.end = std::min(seat.x + 0.5 * *kind.pad_length, seat.rail_end);
  mesh.rail_pad.thickness = *kind.pad_thickness;
  mesh.rail_pad.layers = kind.pad_layers;
  // Slaves must not be coarser than what they are tied to.
  mesh.rail_pad.size = std::min(*kind.width / (*kind.divisions)[0], *kind.half_length / (*kind.divisions)[1]);
  entries.add(entries.scene.meshes, "meshes", mesh);
  entries.add_part(mesh.name, mesh.name, seat.pad_material, entries.track.position);
  scene::Part& part = entries.scene.parts.back();
  part.stiffness_damping = damping;
  // Viscous control would let the layer's inner nodes creep under a lasting load.
  part.take_hourglass(scene::HourglassType::stiffness);
  // The pad lies on the foot; the sleeper's top is level, where a real seat leans with the rail.
  const double rounding = 1e-6, lean = half_foot * std::fabs(entries.track.rail.inclination);
  add_tie(entries, mesh.name + "_foot", mesh.name + ".z_max", seat.rail + ".foot", rounding);
  add_tie(entries, mesh.name + "_seat", mesh.name + ".z_min", seat.sleeper + ".z_max",
          lean + 0.1 * *kind.pad_thickness);
}

}  // namespace

void add_fastening(TrackEntries& entries, const scene::Sleeper& kind, const RailSeat& seat) {
  if (kind.pad == scene::Sleeper::Pad::springs)
    return add_springs(entries, kind, seat, *kind.fastening_stiffness, *kind.fastening_damping);
  const SolidPad pad = solid_pad(kind, entries.track.rail.section);
  add_pad(entries, kind, seat, pad.damping);
  if (pad.springs()) add_springs(entries, kind, seat, pad.stiffness, pad.dashpots);
}

}  // namespace railwave::case_file
