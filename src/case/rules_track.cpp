#include <fmt/format.h>

#include <cmath>

#include "case/expand.hpp"
#include "case/rules.hpp"

namespace railwave::case_file {

namespace {

void check_pad(const scene::Sleeper& kind, EntryCheck& check) {
  if (!check.sound({"pad"})) return;
  if (kind.pad == scene::Sleeper::Pad::springs) {
    for (const char* key : {"pad_modulus", "pad_poissons_ratio", "pad_density", "pad_damping", "pad_layers"})
      if (check.given(key))
        check.complain(key, fmt::format("has no effect without pad = \"solid\"; set that, or leave {} out", key));
    return;
  }
  if (!check.given("pad_modulus") && check.given("fastening_stiffness") && check.sound({"fastening_stiffness"}) &&
      !((*kind.fastening_stiffness)[2] > 0))
    check.complain(
        "fastening_stiffness",
        "has no vertical part, of which a solid pad's modulus would be made; give one above 0, or pad_modulus");
}

}  // namespace

void check_sleeper(void* entry, EntryCheck& check) {
  auto& kind = *static_cast<scene::Sleeper*>(entry);
  // A section that changes the timber sleeper is not based on the concrete one.
  if (!check.given("base") && kind.name == "timber") kind.base = scene::Sleeper::Base::timber;
  check_pad(kind, check);
  if (!check.sound({"width", "pad_length"})) return;
  const double width = kind.width.value_or(0.25), pad_length = kind.pad_length.value_or(0.16);  // as the tables say
  if (pad_length <= width) return;
  const bool blame_width = check.given("width") && !check.given("pad_length");
  check.complain(blame_width ? "width" : "pad_length",
                 blame_width ? fmt::format("is {}, must be at least pad_length ({})", width, pad_length)
                             : fmt::format("is {}, must be at most width ({})", pad_length, width));
}

namespace {

void check_sleepers_of(const scene::Track& track, EntryCheck& check) {
  for (const char* key : {"pitch", "first_sleeper"})
    if (check.given(key) && check.given("positions"))
      check.complain(key, "has no effect beside positions; leave one of them out");
  if (!check.given("pair_position")) {
    if (check.given("pair_distance"))
      check.complain("pair_distance", "has no effect without pair_position; give that too, or leave pair_distance out");
  } else if (check.given("first_sleeper")) {
    check.complain("first_sleeper",
                   "has no effect beside pair_position, from which the regular sleepers go on; leave one of them out");
  } else if (check.given("positions")) {
    check.complain("pair_position", "has no place among given positions; give other_positions instead");
  }
  if (!check.sound({"start", "end", "positions", "other_positions", "pair_position", "pitch"})) return;
  for (const auto* places : {&track.positions, &track.other_positions})
    for (double x : *places)
      if (x < track.rail.start || x > track.rail.end)
        check.complain(places == &track.positions ? "positions" : "other_positions",
                       fmt::format("has {}, must be under the rail, from start = {} to end = {}", x, track.rail.start,
                                   track.rail.end));
  constexpr double least_distance = 0.2;
  // Before they are laid out one by one.
  if (track.positions.empty() && track.pitch < least_distance) {
    check.complain("pitch", fmt::format("is {}, must be at least {} m", track.pitch, least_distance));
    return;
  }
  constexpr double most_sleepers = 10000;
  if (const double count = (track.rail.end - track.rail.start) / track.pitch;
      track.positions.empty() && count > most_sleepers) {
    check.complain(
        "pitch",
        fmt::format("makes {:.3g} sleepers under a rail of {:.3g} m, at most {} are made; make the rail shorter", count,
                    track.rail.end - track.rail.start, most_sleepers));
    return;
  }
  const auto places = sleeper_places(track);
  for (std::size_t k = 1; k < places.size(); ++k) {
    if (places[k].x - places[k - 1].x >= least_distance) continue;
    check.complain(check.given("other_positions") ? "other_positions"
                   : check.given("positions")     ? "positions"
                                                  : "pitch",
                   fmt::format("puts sleepers at x = {:.6g} and {:.6g}, which are less than {} m apart",
                               places[k - 1].x, places[k].x, least_distance));
    return;
  }
}

void check_gap(const scene::Track& track, EntryCheck& check) {
  if (!check.given("gap_position")) {
    if (check.given("gap"))
      check.complain("gap", "has no effect without gap_position; give that too, or leave gap out");
    return;
  }
  if (!check.sound({"gap", "gap_position", "zone_start", "zone_end", "zone_size"})) return;
  const double first = *track.gap_position - 0.5 * track.gap, last = *track.gap_position + 0.5 * track.gap;
  if (!(track.rail.zone_start + track.rail.zone_size <= first && track.rail.zone_end - track.rail.zone_size >= last))
    check.complain(
        "gap_position",
        fmt::format(
            "makes a gap from {} to {}, which must lie within the solution zone, from zone_start = {} to zone_end = {}",
            first, last, track.rail.zone_start, track.rail.zone_end));
}

void check_joint(const scene::Track& track, EntryCheck& check) {
  if (!track.fishplates) {
    for (const char* key :
         {"fishplate_fit", "fishplate_friction", "fishplate_material", "fishplate_length", "fishplate_thickness",
          "fishplate_clearance", "fishplate_size", "bolt_positions", "bolt_height", "bolt_diameter", "bolt_pretension"})
      if (check.given(key))
        check.complain(key, fmt::format("has no effect without fishplates = true; set that, or leave {} out", key));
    return;
  }
  if (!check.given("gap_position")) {
    check.complain("fishplates", "has no effect without gap_position; give that too, or leave fishplates out");
    return;
  }
  if (check.given("fishplate_friction") && check.sound({"fishplate_fit"}) &&
      track.fishplate_fit == scene::FishplateFit::tie)
    check.complain(
        "fishplate_friction",
        "has no effect on plates that are tied; set fishplate_fit = \"contact\", or leave fishplate_friction out");
  if (!check.sound({"gap", "gap_position", "fishplate_length", "bolt_positions", "bolt_diameter", "start", "end"}))
    return;
  const double half = 0.5 * track.fishplate_length;
  if (*track.gap_position - half < track.rail.start || *track.gap_position + half > track.rail.end)
    check.complain("fishplate_length",
                   fmt::format("is {}, so that the plates reach from {} to {}, beyond the rails",
                               track.fishplate_length, *track.gap_position - half, *track.gap_position + half));
  const double least = 0.5 * track.gap + 0.5 * track.bolt_diameter, most = half - track.bolt_diameter;
  for (double x : track.bolt_positions)
    if (std::fabs(x) < least || std::fabs(x) > most)
      check.complain(
          "bolt_positions",
          fmt::format(
              "has {}, must be {:.4g} to {:.4g} m away from the gap's middle: in the plates, and not in the gap", x,
              least, most));
}

}  // namespace

void check_track(void* entry, EntryCheck& check) {
  const auto& track = *static_cast<scene::Track*>(entry);
  check_rail(track.rail, check);
  check_sleepers_of(track, check);
  check_gap(track, check);
  check_joint(track, check);
}

}  // namespace railwave::case_file
