#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <utility>

#include "case/expand.hpp"
#include "case/solid_pad.hpp"
#include "case/track_entries.hpp"

namespace railwave::case_file {
namespace {

using scene::Track;
using scene::Vec3;

scene::Material made_of(const std::string& name, double modulus, double poissons_ratio, double density) {
  scene::Material material;
  material.name = name;
  material.youngs_modulus = modulus;
  material.poissons_ratio = poissons_ratio;
  material.density = density;
  return material;
}

/// One rail, whole or in two with a gap, and its fastenings.
class RailExpansion {
 public:
  explicit RailExpansion(TrackEntries entries) : entries_(std::move(entries)), track_(entries_.track) {}

  void add_rails(const std::string& material) {
    if (!track_.gap_position) return add_rail("rail", material, track_.rail);
    scene::RailMesh before = track_.rail, behind = track_.rail;
    before.end = *track_.gap_position - 0.5 * track_.gap;
    behind.start = *track_.gap_position + 0.5 * track_.gap;
    before.zone_end = std::min(before.zone_end, before.end);
    behind.zone_start = std::max(behind.zone_start, behind.start);
    if (before.path_end) before.path_end = before.end;
    if (behind.path_start) behind.path_start = behind.start;
    add_rail("rail", material, before);
    add_rail("rail_2", material, behind);
    if (track_.fishplates) add_joint(entries_, material);
  }

  void fasten(RailSeat seat, const scene::Sleeper& kind) {
    const Range& rail = track_.gap_position && seat.x > *track_.gap_position ? rails_.back() : rails_.front();
    seat.rail = rail.name;
    seat.rail_start = rail.start;
    seat.rail_end = rail.end;
    add_fastening(entries_, kind, seat);
  }

 private:
  struct Range {
    std::string name;
    double start, end;
  };

  void add_rail(const char* what, const std::string& material, const scene::RailMesh& rail) {
    scene::MeshSource mesh;
    mesh.name = entries_.own(what);
    mesh.type = scene::MeshType::rail;
    mesh.rail = rail;
    entries_.add(entries_.scene.meshes, "meshes", mesh);
    entries_.add_part(mesh.name, mesh.name, material, track_.position);
    entries_.scene.parts.back().stiffness_damping = track_.rail_stiffness_damping;
    rails_.push_back({mesh.name, rail.start, rail.end});
  }

  TrackEntries entries_;
  const Track& track_;
  std::vector<Range> rails_;
};

class TrackExpansion : private TrackEntries {
 public:
  TrackExpansion(scene::Scene& into, const Track& of, Complaints& complaints)
      : TrackEntries(into, of, complaints), far_(far_side(of)) {
    rails_.emplace_back(TrackEntries(into, of, complaints));
    if (of.both_rails) rails_.emplace_back(TrackEntries(into, far_, complaints, own("far")));
  }

  void run() {
    auto material = track.rail_material;
    if (material.empty()) add(scene.materials, "materials", made_of(material = own("steel"), 210e9, 0.3, 7800));
    for (RailExpansion& rail : rails_) rail.add_rails(material);
    const auto places = sleeper_places(track);
    if (places.empty()) complain("has no sleeper under its rail; make the rail longer than a pitch, or give positions");
    for (std::size_t k = 0; k < places.size(); ++k) add_sleeper(places[k], static_cast<int>(k) + 1);
  }

 private:
  static bool centre_is_left(const Track& track) { return track.rail.inclination >= 0; }
  /// y of the track's centre plane in the axes of its meshes.
  static double centre(const Track& track) {
    return centre_is_left(track) ? -track.rail_distance : track.rail_distance;
  }
  static double across(const Track& track, double y) { return track.position[1] + (track.mirror ? -y : y); }

  /// The track as its mirror image at the centre plane.
  static Track far_side(const Track& track) {
    Track far = track;
    far.mirror = !track.mirror;
    far.position[1] = across(track, 2 * centre(track));
    return far;
  }

  void add_sleeper(const SleeperPlace& place, int number) {
    const scene::Sleeper kind = sleeper_of(scene, *place.kind);
    const std::string name = own("sleeper", number);
    if (kinds_.insert(*place.kind).second) add_kind(*place.kind, kind);
    const Vec3& at = track.position;
    add_part(name, own(*place.kind), kind.material.empty() ? own(*place.kind) : kind.material,
             {at[0] + place.x, at[1], at[2]});
    RailSeat seat;
    seat.x = place.x;
    seat.sleeper = name;
    seat.pad_material = own(*place.kind + "_pad");
    seat.number = number;
    for (RailExpansion& rail : rails_) rail.fasten(seat, kind);
    add_bed(kind, name, number);
    hold_middle(place, kind, name, number);
  }

  /// The mesh of all sleepers of a kind, the sleeper's middle at x = 0; its materials unless the case has them.
  void add_kind(const std::string& name, const scene::Sleeper& kind) {
    const bool timber = kind.base == scene::Sleeper::Base::timber;
    if (kind.material.empty()) {
      const auto material = timber ? made_of(own(name), 20e9, 0.3, 1300) : made_of(own(name), 38.4e9, 0.2, 2520);
      add(scene.materials, "materials", material);
    }
    if (kind.pad == scene::Sleeper::Pad::solid)
      add(scene.materials, "materials",
          made_of(own(name + "_pad"), solid_pad(kind, track.rail.section).modulus, kind.pad_poissons_ratio,
                  kind.pad_density));
    scene::MeshSource mesh;
    mesh.name = own(name);
    mesh.type = scene::MeshType::box;
    const double first = track.both_rails || !centre_is_left(track) ? -*kind.half_length : 0;
    mesh.box.size = {*kind.width, sides() * *kind.half_length, *kind.height};
    mesh.box.origin = {-0.5 * *kind.width, centre(track) + first, -*kind.pad_thickness - *kind.height};
    mesh.box.divisions = *kind.divisions;
    mesh.box.divisions[1] *= sides();
    add(scene.meshes, "meshes", mesh);
  }

  /// Halves of each sleeper.
  int sides() const { return track.both_rails ? 2 : 1; }

  void add_bed(const scene::Sleeper& kind, const std::string& sleeper, int number) {
    scene::Connector ballast;
    ballast.name = own("ballast", number);
    ballast.from = "ground";
    ballast.to = sleeper + ".z_min";
    ballast.stiffness = {0, sides() * kind.ballast_lateral_stiffness.value_or(0), sides() * *kind.ballast_stiffness};
    ballast.damping = {0, sides() * kind.ballast_lateral_damping.value_or(0), sides() * *kind.ballast_damping};
    ballast.spread = kind.ballast_spread;
    ballast.spread[1] *= sides();
    add(scene.connectors, "connectors", ballast);
    scene::Constraint bed;
    bed.name = own("bed", number);
    bed.target = sleeper + ".z_min";
    // Not along y: an underside that cannot stretch would not let the sleeper bend.
    bed.fixed = {true, false, false};
    add(scene.constraints, "constraints", bed);
  }

  /// Half a sleeper is held where its other half would hold it. Of a whole one the middle of the underside is, unless
  /// the ballast has a lateral stiffness: only a line along x, about which it may roll.
  void hold_middle(const SleeperPlace& place, const scene::Sleeper& kind, const std::string& sleeper, int number) {
    scene::Constraint middle;
    middle.name = own("centre", number);
    middle.fixed = {false, true, false};
    if (!track.both_rails) {
      middle.target = sleeper + (centre_is_left(track) ? ".y_min" : ".y_max");
    } else {
      if (kind.ballast_lateral_stiffness) return;
      scene::NodeSet line;
      line.name = "centre";
      line.line = track.line;
      line.part = sleeper;
      line.surface = "z_min";
      const double x = track.position[0] + place.x, y = across(track, centre(track)), slack = 1e-6;
      line.box = {{{x - *kind.width, y - slack, -unbounded}, {x + *kind.width, y + slack, unbounded}}};
      // All sleepers have a set of this name.
      scene.node_sets.push_back(line);
      middle.target = sleeper + ".centre";
    }
    add(scene.constraints, "constraints", middle);
  }

  Track far_;
  std::vector<RailExpansion> rails_;
  std::set<std::string> kinds_;  ///< whose mesh is there
};

}  // namespace

std::vector<SleeperPlace> sleeper_places(const Track& track) {
  const double start = track.rail.start, end = track.rail.end;
  // Rounding must not lose the last one of a rail that ends with half a pitch.
  const double slack = 1e-9 * (end - start);
  std::vector<SleeperPlace> places;
  const auto put = [&](double x, const std::string& kind) {
    if (x >= start - slack && x <= end + slack) places.push_back({x, &kind});
  };
  const auto row = [&](double first, double pitch) {
    for (int k = 0; first + k * pitch >= start - slack && first + k * pitch <= end + slack; ++k)
      put(first + k * pitch, track.sleeper);
  };
  if (!track.positions.empty()) {
    for (double x : track.positions) put(x, track.sleeper);
  } else if (track.pair_position) {
    row(*track.pair_position - 0.5 * track.pair_distance - track.pitch, -track.pitch);
    row(*track.pair_position + 0.5 * track.pair_distance + track.pitch, track.pitch);
  } else {
    row(track.first_sleeper.value_or(start + 0.5 * track.pitch), track.pitch);
  }
  if (track.pair_position)
    for (double side : {-0.5, 0.5}) put(*track.pair_position + side * track.pair_distance, track.other_sleeper);
  for (double x : track.other_positions) put(x, track.other_sleeper);
  std::sort(places.begin(), places.end(), [](const auto& a, const auto& b) { return a.x < b.x; });
  return places;
}

scene::Sleeper sleeper_of(const scene::Scene& scene, const std::string& name) {
  const scene::Sleeper* given = find_entry(scene.sleepers, name);
  scene::Sleeper kind = given ? *given : scene::Sleeper{};
  if (!given) {
    kind.name = name;
    kind.base = name == "timber" ? scene::Sleeper::Base::timber : scene::Sleeper::Base::concrete;
  }
  const bool timber = kind.base == scene::Sleeper::Base::timber;
  const auto otherwise = [](auto& field, auto value) {
    if (!field) field = value;
  };
  otherwise(kind.half_length, timber ? 1.3 : 1.26);
  otherwise(kind.width, 0.25);
  otherwise(kind.height, timber ? 0.15 : 0.18);
  otherwise(kind.divisions, std::array<int, 3>{3, 14, 2});
  otherwise(kind.pad_thickness, 0.007);
  otherwise(kind.pad_length, 0.16);
  const Vec3 stiffness = timber ? Vec3{150e6, 150e6, 86.7e6} : Vec3{100e6, 100e6, 195e6};
  const Vec3 damping = timber ? Vec3{40e3, 40e3, 45e3} : Vec3{40e3, 40e3, 67.5e3};
  // Beside a pad of known modulus are clips, of which the table knows nothing.
  const bool clips = kind.pad == scene::Sleeper::Pad::solid && kind.pad_modulus;
  if (clips) otherwise(kind.pad_damping, damping[2] / stiffness[2]);
  otherwise(kind.fastening_stiffness, clips ? Vec3{} : stiffness);
  otherwise(kind.fastening_damping, clips ? Vec3{} : damping);
  otherwise(kind.ballast_stiffness, 45e6);
  otherwise(kind.ballast_damping, 32e3);
  return kind;
}

void expand_tracks(scene::Scene& scene, Complaints& complaints) {
  for (const Track& track : scene.tracks) TrackExpansion(scene, track, complaints).run();
}

}  // namespace railwave::case_file
