#include "case/expand_tracks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace railwave::case_file {
namespace {

using scene::Track;
using scene::Vec3;

template <class Entry>
const Entry* find(const std::vector<Entry>& entries, const std::string& name) {
  const auto found = std::find_if(entries.begin(), entries.end(), [&](const auto& entry) { return entry.name == name; });
  return found == entries.end() ? nullptr : &*found;
}

scene::Material made_of(const std::string& name, double modulus, double poissons_ratio, double density) {
  scene::Material material;
  material.name = name;
  material.youngs_modulus = modulus;
  material.poissons_ratio = poissons_ratio;
  material.density = density;
  return material;
}

/// The largest box of a connector's area that bounds nothing along y and z.
constexpr double far = 1e3;

class Expansion {
 public:
  Expansion(scene::Scene& scene, const Track& track, Complaints& complaints) : scene_(scene), track_(track), complaints_(complaints) {}

  void run() {
    add_rails();
    const auto places = sleeper_places(track_);
    if (places.empty())
      complaints_.add({track_.line}, "[tracks." + track_.name + "]: has no sleeper under its rail; make the rail longer than a pitch, or give positions");
    for (std::size_t k = 0; k < places.size(); ++k) add_sleeper(places[k], static_cast<int>(k) + 1);
  }

 private:
  template <class Entry>
  void add(std::vector<Entry>& entries, const char* section, Entry entry) {
    entry.line = track_.line;
    if (const Entry* other = find(entries, entry.name)) {
      complaints_.add({track_.line}, fmt::format("[tracks.{}]: makes [{}.{}], which is there already (line {}); rename one", track_.name,
                                                 section, entry.name, other->line));
      return;
    }
    entries.push_back(std::move(entry));
  }

  std::string own(const std::string& what) const { return track_.name + "_" + what; }
  std::string own(const char* what, int number) const { return fmt::format("{}_{}_{}", track_.name, what, number); }

  void add_rails() {
    auto material = track_.rail_material;
    if (material.empty()) add(scene_.materials, "materials", made_of(material = own("steel"), 210e9, 0.3, 7800));
    if (!track_.gap_position) return add_rail(own("rail"), material, track_.rail);
    scene::RailMesh before = track_.rail, behind = track_.rail;
    before.end = *track_.gap_position - 0.5 * track_.gap;
    behind.start = *track_.gap_position + 0.5 * track_.gap;
    before.zone_end = std::min(before.zone_end, before.end);
    behind.zone_start = std::max(behind.zone_start, behind.start);
    add_rail(own("rail"), material, before);
    add_rail(own("rail_2"), material, behind);
  }

  void add_rail(const std::string& name, const std::string& material, const scene::RailMesh& rail) {
    scene::MeshSource mesh;
    mesh.name = name;
    mesh.type = scene::MeshType::rail;
    mesh.rail = rail;
    add(scene_.meshes, "meshes", mesh);
    add_part(name, name, material, track_.position);
  }

  void add_part(const std::string& name, const std::string& mesh, const std::string& material, const Vec3& position) {
    scene::Part part;
    part.name = name;
    part.mesh = mesh;
    part.material = material;
    part.position = position;
    part.mirror = track_.mirror;
    add(scene_.parts, "parts", part);
  }

  void add_sleeper(const SleeperPlace& place, int number) {
    const scene::Sleeper kind = sleeper_of(scene_, *place.kind);
    const std::string name = own("sleeper", number);
    if (kinds_.insert(*place.kind).second) add_kind(*place.kind, kind);
    const Vec3& at = track_.position;
    add_part(name, own(*place.kind), kind.material.empty() ? own(*place.kind) : kind.material, {at[0] + place.x, at[1], at[2]});
    add_fastening(place, kind, name, number);
    add_bed(kind, name, number);
  }

  bool centre_is_left() const { return track_.rail.inclination >= 0; }

  /// The mesh of all sleepers of a kind, the sleeper's middle at x = 0; its material unless the case has one.
  void add_kind(const std::string& name, const scene::Sleeper& kind) {
    const bool timber = kind.base == scene::Sleeper::Base::timber;
    if (kind.material.empty()) {
      const auto material = timber ? made_of(own(name), 20e9, 0.3, 1300) : made_of(own(name), 38.4e9, 0.2, 2520);
      add(scene_.materials, "materials", material);
    }
    scene::MeshSource mesh;
    mesh.name = own(name);
    mesh.type = scene::MeshType::box;
    mesh.box.size = {*kind.width, *kind.half_length, *kind.height};
    mesh.box.origin = {-0.5 * *kind.width, centre_is_left() ? -track_.rail_distance : track_.rail_distance - *kind.half_length,
                       -*kind.pad_thickness - *kind.height};
    mesh.box.divisions = *kind.divisions;
    add(scene_.meshes, "meshes", mesh);
  }

  void add_fastening(const SleeperPlace& place, const scene::Sleeper& kind, const std::string& sleeper, int number) {
    const bool behind = track_.gap_position && place.x > *track_.gap_position;
    scene::Connector fastening;
    fastening.name = own("fastening", number);
    fastening.from = sleeper + ".z_max";
    fastening.to = own(behind ? "rail_2" : "rail") + ".foot";
    fastening.stiffness = *kind.fastening_stiffness;
    fastening.damping = *kind.fastening_damping;
    fastening.spread = kind.fastening_spread;
    const double x = track_.position[0] + place.x;
    fastening.area = {{{x - 0.5 * *kind.pad_length, -far, -far}, {x + 0.5 * *kind.pad_length, far, far}}};
    add(scene_.connectors, "connectors", fastening);
  }

  void add_bed(const scene::Sleeper& kind, const std::string& sleeper, int number) {
    scene::Connector ballast;
    ballast.name = own("ballast", number);
    ballast.from = "ground";
    ballast.to = sleeper + ".z_min";
    ballast.stiffness = {0, 0, *kind.ballast_stiffness};
    ballast.damping = {0, 0, *kind.ballast_damping};
    ballast.spread = kind.ballast_spread;
    add(scene_.connectors, "connectors", ballast);
    scene::Constraint bed;
    bed.name = own("bed", number);
    bed.target = sleeper + ".z_min";
    // Not along y: an underside that cannot stretch would not let the sleeper bend.
    bed.fixed = {true, false, false};
    add(scene_.constraints, "constraints", bed);
    scene::Constraint centre;
    centre.name = own("centre", number);
    centre.target = sleeper + (centre_is_left() ? ".y_min" : ".y_max");
    centre.fixed = {false, true, false};
    add(scene_.constraints, "constraints", centre);
  }

  scene::Scene& scene_;
  const Track& track_;
  Complaints& complaints_;
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
    for (int k = 0; first + k * pitch >= start - slack && first + k * pitch <= end + slack; ++k) put(first + k * pitch, track.sleeper);
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
  const scene::Sleeper* given = find(scene.sleepers, name);
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
  otherwise(kind.fastening_stiffness, timber ? Vec3{150e6, 150e6, 86.7e6} : Vec3{100e6, 100e6, 195e6});
  otherwise(kind.fastening_damping, timber ? Vec3{40e3, 40e3, 45e3} : Vec3{40e3, 40e3, 67.5e3});
  otherwise(kind.ballast_stiffness, 45e6);
  otherwise(kind.ballast_damping, 32e3);
  return kind;
}

void expand_tracks(scene::Scene& scene, Complaints& complaints) {
  for (const Track& track : scene.tracks) Expansion(scene, track, complaints).run();
}

}  // namespace railwave::case_file
