#pragma once

#include <vector>

#include "case/key.hpp"

namespace railwave::case_file {

/// Keys of a rail's mesh, for each section whose entries have one.
template <class Entry>
std::vector<Key> rail_keys(scene::RailMesh Entry::*rail) {
  using Rail = scene::RailMesh;
  const auto any = [=](auto name, auto field, auto help) { return key(name, rail, field, help); };
  const auto position = [=](auto name, auto field, auto help) { return any(name, field, help).in("m"); };
  const auto length = [=](auto name, auto field, auto help) { return position(name, field, help).within(above(0)); };
  return {
      any("section", &Rail::section, "rail section").one_of({"54E1", "60E1"}),
      any("inclination", &Rail::inclination, "slope towards -y, the track's centre; 0.025 is 1:40")
          .within(between(-0.2, 0.2)),
      position("start", &Rail::start, "x of the rail's beginning"),
      position("end", &Rail::end, "x of the rail's end"),
      length("zone_size", &Rail::zone_size, "element size in the solution zone").within(between(1e-4, 0.01)),
      position("zone_start", &Rail::zone_start, "x where the solution zone begins"),
      position("zone_end", &Rail::zone_end, "x where the solution zone ends"),
      any("zone", &Rail::zone,
          "where the contact band lies: `given`, by zone_centre and zone_width; `contact`, where its profile and that "
          "of the wheel meet with which it has a contact, see zone_lateral_start there")
          .one_of({"given", "contact"}),
      position("zone_centre", &Rail::zone_centre, "y of the contact band's middle"),
      length("zone_width", &Rail::zone_width, "width of the contact band").within(between(1e-4, 0.09)),
      any("zone_layers", &Rail::zone_layers,
          "layers of zone_size below the running surface; with 2.4 more at most 0.024 m deep")
          .within(between(1, 20)),
      any("growth", &Rail::growth, "largest ratio of neighbouring element sizes").within(between(1.05, 2)),
      length("coarse_size", &Rail::coarse_size, "largest element size along the head's surface, far from the zone")
          .within(between(1e-4, 0.2)),
      length("core_size", &Rail::core_size,
             "largest element size along the rail, below the head's surface; at least three times zone_size")
          .within(between(3e-4, 0.5)),
      length("section_size", &Rail::section_size, "largest element size across the head's surface; at least zone_size")
          .within(between(0.002, 0.012)),
      position("path_start", &Rail::path_start,
               "x where the path begins that a wheel rolls over; surface `head` reaches as far")
          .otherwise("zone_start"),
      position("path_end", &Rail::path_end, "x where it ends").otherwise("zone_end"),
      length("path_size", &Rail::path_size, "largest element size along the head on that path, outside the zone")
          .within(between(1e-4, 0.2)),
      any("web_columns", &Rail::web_columns, "elements through the web's thickness").within(between(1, 9)),
      any("height_map", &Rail::height_map,
          "measured surface: a CSV file with the columns x, y, dz in m, a height for each place of a grid of x and "
          "y; nodes of the running surface within the grid move up by dz, those below by less")
          .path()
          .otherwise("the nominal surface"),
      length("height_map_depth", &Rail::height_map_depth,
             "below the surface, from which down nodes stay where they are"),
  };
}

}  // namespace railwave::case_file
