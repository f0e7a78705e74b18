#include "mesh/contact_zone.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <optional>

#include "case/expand.hpp"
#include "mesh/generators/rail.hpp"
#include "mesh/generators/wheel.hpp"
#include "mesh/mesh_checks.hpp"
#include "mesh/sections/profile_contact.hpp"
#include "mesh/sections/profiles.hpp"
#include "mesh/sections/section_columns.hpp"
#include "mesh/sections/wheel_section.hpp"

namespace railwave {
namespace {

constexpr double sampling = 1e-4;      // m, of profiles
constexpr double half_a_gauge = 0.15;  // m: a rail that lies farther from a wheel is not its own

using scene::MeshSource;
using scene::MeshType;

scene::WheelMesh* wheel_of(MeshSource& source) {
  if (source.type == MeshType::wheel) return &source.wheel;
  if (source.type == MeshType::wheelset) return &source.wheelset;
  return nullptr;
}

scene::RailMesh* rail_of(MeshSource& source) { return source.type == MeshType::rail ? &source.rail : nullptr; }

bool by_contact(MeshSource& source) {
  if (const auto* wheel = wheel_of(source)) return wheel->zone == scene::ZoneBand::contact;
  if (const auto* rail = rail_of(source)) return rail->zone == scene::ZoneBand::contact;
  return false;
}

/// A part and its mesh.
struct Body {
  const scene::Part* part = nullptr;
  MeshSource* source = nullptr;
  std::string surface;

  double mirrored() const { return part->mirror ? -1 : 1; }
};

Body body_of(scene::Scene& scene, const std::string& name) {
  const auto point = name.find('.');
  const scene::Part* part = find_entry(scene.parts, name.substr(0, point));
  if (!part) return {};
  for (MeshSource& source : scene.meshes)
    if (source.name == part->mesh) return {part, &source, name.substr(point + 1)};
  return {};
}

struct Range {
  double first = 1e300, last = -1e300;

  void add(const std::array<double, 2>& piece, double margin) {
    first = std::min(first, piece[0] - margin);
    last = std::max(last, piece[1] + margin);
  }
};

std::vector<ProfilePoint> sampled(double from, double to, const std::function<Point2(double)>& at) {
  const int pieces = std::max(2, static_cast<int>(std::ceil((to - from) / sampling)));
  std::vector<ProfilePoint> points;
  for (int i = 0; i <= pieces; ++i) {
    const double arc = from + (to - from) * i / pieces;
    points.push_back({arc, at(arc)});
  }
  return points;
}

/// A rail's running surface in the scene by the arc length from the crown's middle, up to where it turns back.
std::vector<ProfilePoint> rail_points(const Body& rail) {
  const scene::RailMesh& mesh = *rail_of(*rail.source);
  const RailOutline outline = rail_outline(mesh.section);
  const Placement lean = inclined(mesh.inclination);
  const auto at = [&](double arc) {
    Point2 upright = outline.head.at(std::abs(arc));
    if (arc < 0) upright.y = -upright.y;
    const Vec3 placed = lean(upright, 0);
    return Point2{rail.part->position[1] + rail.mirrored() * placed[1], rail.part->position[2] + placed[2]};
  };
  auto points = sampled(-outline.gauge_corner_end, outline.gauge_corner_end, at);
  const auto middle = points.begin() + static_cast<long>(points.size() / 2);
  const double way = rail.mirrored();
  const auto turns_back = [&](const ProfilePoint& a, const ProfilePoint& b) { return way * (b.at.y - a.at.y) <= 0; };
  const auto last = std::adjacent_find(middle, points.end(), turns_back);
  if (last != points.end()) points.erase(last + 1, points.end());
  const auto first = std::adjacent_find(std::make_reverse_iterator(middle + 1), points.rend(),
                                        [&](const ProfilePoint& a, const ProfilePoint& b) { return turns_back(b, a); });
  if (first != points.rend()) points.erase(points.begin(), first.base() - 1);
  return points;
}

/// By which the place along the axle is made of that along the profile: y = middle + way * s.
struct WheelSide {
  double middle = 0, way = 1;
};

/// That wheel of a body whose tape circle is nearest to the rail's middle.
std::optional<WheelSide> side_over(const Body& wheel, double rail_middle) {
  std::vector<WheelSide> sides{{0, 1}};
  if (wheel.source->type == MeshType::wheelset) {
    const double tape = tape_circle(wheel.source->wheelset);
    sides = {{tape, 1}};
    if (!wheel.source->wheelset.half) sides.push_back({-tape, -1});
  }
  for (WheelSide& side : sides) side = {wheel.mirrored() * side.middle, wheel.mirrored() * side.way};
  const auto off = [&](const WheelSide& side) { return std::abs(wheel.part->position[1] + side.middle - rail_middle); };
  const WheelSide nearest =
      *std::min_element(sides.begin(), sides.end(), [&](auto& a, auto& b) { return off(a) < off(b); });
  if (off(nearest) > half_a_gauge) return std::nullopt;
  return nearest;
}

std::string described(const scene::Contact& contact, double lateral, const ProfileMeeting& meeting,
                      const WheelSide& side, const Body& rail, const char* what) {
  const double rail_y = rail.mirrored() * (meeting.rail.y - rail.part->position[1]);
  return fmt::format(
      "[contacts.{}] wheel {:+.2f} mm along y: {} at {:.1f} mm from its tape circle and y = {:.1f} mm of the rail, "
      "contact angle {:.1f} deg, {:.1f} mm ahead of the axle",
      contact.name, 1e3 * lateral, what, 1e3 * side.way * (meeting.wheel.y - side.middle), 1e3 * rail_y,
      180 / M_PI * std::abs(meeting.angle), 1e3 * meeting.ahead);
}

/// What one wheel and one rail have in common.
void add_pieces(const scene::Contact& contact, const Body& wheel, const Body& rail, std::map<MeshSource*, Range>& bands,
                std::vector<std::string>& lines, bool& met) {
  const auto rail_profile = rail_points(rail);
  const auto side = side_over(wheel, rail_profile[rail_profile.size() / 2].at.y);
  if (!side) return;
  const Curve surface = wheel_running_surface(*wheel_of(*wheel.source));
  const ProfileContact profiles(sampled(0, surface.length,
                                        [&](double arc) {
                                          const Point2 p = surface.at(arc);
                                          return Point2{side->middle + side->way * p.y, p.z};
                                        }),
                                rail_profile);
  const auto [start, end] = std::minmax(contact.zone_lateral_start, contact.zone_lateral_end);
  const int steps = static_cast<int>(std::ceil((end - start) / contact_zone::lateral_step - 1e-9));
  std::optional<ProfileMeeting> before;
  for (int i = 0; i <= steps; ++i) {
    const double lateral = steps == 0 ? start : start + (end - start) * i / steps;
    const AxlePlace place{wheel.part->position[1] + lateral, wheel.part->angle_of_attack - rail.part->angle_of_attack,
                          contact.zone_roll};
    const auto meetings = profiles.meetings(place, contact_zone::opening);
    if (meetings.empty()) continue;
    met = true;
    const NearPieces pieces = profiles.near(place, contact_zone::opening);
    bands[wheel.source].add(pieces.wheel, contact.zone_margin);
    bands[rail.source].add(pieces.rail, contact.zone_margin);
    const ProfileMeeting& first = meetings.front();
    const bool jumped = before && std::abs(first.wheel_arc - before->wheel_arc) > contact_zone::jump;
    if (i == 0 || i == steps || jumped)
      lines.push_back(described(contact, lateral, first, *side, rail,
                                jumped ? "the profiles now meet elsewhere," : "the profiles meet"));
    before = first;
  }
}

/// A band of whole columns within the curve: its middle and width, m.
std::array<double, 2> fitted(const Range& range, double first, double last, double size) {
  constexpr double inside = 1e-6;  // m: the band's ends are found again from its middle
  first += inside;
  last -= inside;
  const double from = std::max(first, range.first), to = std::min(last, range.last);
  double width = zone_columns(to - from, size) * size;
  if (width > last - first) width = std::max(3.0, 3 * std::floor((last - first) / (3 * size))) * size;
  return {std::clamp((from + to) / 2, first + width / 2, last - width / 2), width};
}

std::string set_band(MeshSource& source, const Range& range) {
  double *centre = nullptr, *width = nullptr;
  if (scene::WheelMesh* wheel = wheel_of(source)) {
    const Curve surface = wheel_running_surface(*wheel);
    const auto band = fitted(range, 0, surface.length, wheel->zone_size);
    *(centre = &wheel->zone_centre) = surface.at(band[0]).y;
    *(width = &wheel->zone_width) = band[1];
    wheel->zone = scene::ZoneBand::given;
  } else {
    scene::RailMesh& rail = *rail_of(source);
    const RailOutline outline = rail_outline(rail.section);
    const auto band = fitted(range, -outline.gauge_corner_end, outline.gauge_corner_end, rail.zone_size);
    Point2 upright = outline.head.at(std::abs(band[0]));
    if (band[0] < 0) upright.y = -upright.y;
    *(centre = &rail.zone_centre) = inclined(rail.inclination)(upright, 0)[1];
    *(width = &rail.zone_width) = band[1];
    rail.zone = scene::ZoneBand::given;
  }
  return fmt::format("[meshes.{}] zone = \"contact\": zone_centre = {:.4f}, zone_width = {:.4f} m", source.name,
                     *centre, *width);
}

[[noreturn]] void refuse(const scene::Scene& scene, int line, const std::string& what) {
  throw InputError(fmt::format("{}:{}: {}", scene.path, line, what));
}

}  // namespace

std::vector<std::string> place_contact_zones(scene::Scene& scene) {
  std::vector<std::string> lines;
  std::map<MeshSource*, Range> bands;
  for (const scene::Contact& contact : scene.contacts) {
    std::vector<Body> bodies{body_of(scene, contact.slave)};
    for (const std::string& name : contact.master) bodies.push_back(body_of(scene, name));
    const bool wanted =
        std::any_of(bodies.begin(), bodies.end(), [](const Body& b) { return b.source && by_contact(*b.source); });
    if (!wanted) {
      if (contact.zone_lateral_start != 0 || contact.zone_lateral_end != 0 || contact.zone_roll != 0)
        refuse(scene, contact.line,
               fmt::format("[contacts.{}] zone_lateral_start, zone_lateral_end and zone_roll have no effect: neither "
                           "mesh has zone = \"contact\"; give one of them that, or leave these out",
                           contact.name));
      continue;
    }
    bool pair = false, met = false;
    for (const Body& wheel : bodies)
      for (const Body& rail : bodies) {
        if (!wheel.source || !rail.source || !wheel_of(*wheel.source) || !rail_of(*rail.source)) continue;
        pair = true;
        add_pieces(contact, wheel, rail, bands, lines, met);
      }
    if (pair && !met)
      refuse(scene, contact.line,
             fmt::format("[contacts.{}] zone = \"contact\" finds no place where wheel and rail meet: the wheel is not "
                         "over the rail's head; look at the `position` of both along y, and at zone_lateral_start and "
                         "zone_lateral_end",
                         contact.name));
  }
  for (MeshSource& source : scene.meshes) {
    if (!by_contact(source)) continue;
    const auto band = bands.find(&source);
    if (band == bands.end())
      refuse(scene, source.line,
             fmt::format("[meshes.{}] zone = \"contact\" needs a contact between a wheel and a rail, which alone have "
                         "profiles; give zone_centre and zone_width instead, or add the contact",
                         source.name));
    lines.push_back(set_band(source, band->second));
  }
  if (lines.empty()) return lines;
  case_file::Complaints complaints(scene.path);  // none: each names a rail, or the case would not have been read
  case_file::fit_to_rails(scene, complaints);
  return lines;
}

}  // namespace railwave
