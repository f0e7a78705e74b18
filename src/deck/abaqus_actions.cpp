#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "deck/abaqus_deck.hpp"
#include "mesh/files/text_file.hpp"
#include "mesh/vectors.hpp"

namespace railwave::deck {
namespace {

std::array<bool, 6> named_condition(const std::string& name, bool& known) {
  known = true;
  if (name == "encastre") return {true, true, true, true, true, true};
  if (name == "pinned") return {true, true, true, false, false, false};
  if (name == "xsymm") return {true, false, false, false, true, true};
  if (name == "ysymm") return {false, true, false, true, false, true};
  if (name == "zsymm") return {false, false, true, true, true, false};
  known = false;
  return {};
}

Number kind_of_motion(const std::string& type) { return type == "velocity" ? 0 : type == "acceleration" ? 1 : 2; }

void move(AbaqusDeckReader& reader, const AbaqusKeyword& keyword, const Nodes& nodes, Number first, Number last,
          double magnitude) {
  const Number kind = kind_of_motion(keyword.value("TYPE"));
  if (kind == 2 && !keyword.has("AMPLITUDE"))
    return reader.report.refuse_always(
        reader.here(keyword),
        "a displacement without AMPLITUDE jumps at the start; give it an amplitude that begins with 0");
  for (Number direction = first; direction <= last; ++direction) {
    Motion motion;
    motion.source = reader.here(keyword);
    motion.nodes = nodes;
    motion.direction = direction;
    motion.kind = kind;
    motion.curve = reader.curve(keyword);
    motion.scale = magnitude;
    reader.deck.motions.push_back(motion);
  }
}

}  // namespace

void read_abaqus_boundary(AbaqusDeckReader& reader, const AbaqusKeyword& keyword) {
  const std::string type = keyword.value("TYPE");
  if (!type.empty() && type != "displacement" && type != "velocity" && type != "acceleration")
    reader.report.refuse(reader.source(keyword), "BOUNDARY.TYPE",
                         "TYPE is read of DISPLACEMENT, VELOCITY, ACCELERATION");
  if (keyword.value("OP") == "new")
    reader.report.refuse(reader.source(keyword), "BOUNDARY.OP",
                         "OP=NEW takes conditions away that stand before the step; leave these out instead");
  while (reader.lines.has_data()) {
    std::vector<std::string> fields;
    for (const auto field : reader.lines.take_fields()) fields.push_back(lower_case(field));
    const Nodes nodes = reader.nodes(fields[0]);
    if (fields.size() < 2)
      reader.fail(reader.lines.place(), "write node or set, first direction, last direction, size");
    Constraint constraint{reader.here(keyword), nodes, 0, {}};
    bool known = false;
    constraint.fixed = named_condition(fields[1], known);
    if (!known) {
      const Number first = reader.whole(fields[1], "direction");
      const Number last = fields.size() > 2 && !fields[2].empty() ? reader.whole(fields[2], "direction") : first;
      if (first < 1 || last < first || last > 6)
        reader.fail(reader.lines.place(), fmt::format("directions {} to {}; they run from 1 to 6", first, last));
      const double magnitude = fields.size() > 3 ? reader.real(fields[3], "size") : 0;
      if (magnitude != 0) {
        if (last > 3)
          reader.fail(reader.lines.place(), "rotations of nodes can't be prescribed; nodes of solids have none");
        move(reader, keyword, nodes, first, last, magnitude);
        continue;
      }
      for (Number i = first; i <= last; ++i) constraint.fixed[static_cast<std::size_t>(i - 1)] = true;
    }
    reader.deck.constraints.push_back(constraint);
  }
}

void read_abaqus_velocity(AbaqusDeckReader& reader, const AbaqusKeyword& keyword) {
  if (keyword.value("TYPE") != "velocity") {
    reader.report.refuse(reader.source(keyword), "INITIALCONDITIONS", "initial conditions are read of TYPE=VELOCITY");
    while (reader.lines.has_data()) reader.lines.take_fields();
    return;
  }
  while (reader.lines.has_data()) {
    std::vector<std::string> fields;
    for (const auto field : reader.lines.take_fields()) fields.push_back(lower_case(field));
    if (fields.size() < 3) reader.fail(reader.lines.place(), "write node or set, direction, velocity");
    const Nodes nodes = reader.nodes(fields[0]);
    const Number direction = reader.whole(fields[1], "direction");
    if (direction < 1 || direction > 3) reader.fail(reader.lines.place(), "velocities are along 1, 2 or 3");
    const auto of = nodes.is_set ? InitialVelocity::Of::node_set : InitialVelocity::Of::node;
    auto& all = reader.deck.velocities;
    // Its other directions stand in other lines.
    auto same = std::find_if(all.rbegin(), all.rend(),
                             [&](const InitialVelocity& one) { return one.of == of && one.number == nodes.number; });
    if (same == all.rend()) {
      InitialVelocity initial;
      initial.source = reader.here(keyword);
      initial.of = of;
      initial.number = nodes.number;
      all.push_back(initial);
      same = all.rbegin();
    }
    same->velocity[static_cast<std::size_t>(direction - 1)] = reader.real(fields[2], "velocity");
  }
}

void read_abaqus_nodal_load(AbaqusDeckReader& reader, const AbaqusKeyword& keyword) {
  if (keyword.has("FOLLOWER"))
    reader.report.refuse(reader.source(keyword), "CLOAD.FOLLOWER", "forces here keep their direction");
  while (reader.lines.has_data()) {
    std::vector<std::string> fields;
    for (const auto field : reader.lines.take_fields()) fields.push_back(lower_case(field));
    if (fields.size() < 3) reader.fail(reader.lines.place(), "write node or set, direction, force");
    NodalLoad load;
    load.source = reader.here(keyword);
    load.nodes = reader.nodes(fields[0]);
    load.direction = reader.whole(fields[1], "direction");
    load.curve = reader.curve(keyword);
    load.scale = reader.real(fields[2], "force");
    reader.deck.nodal_loads.push_back(load);
  }
}

void read_abaqus_distributed_load(AbaqusDeckReader& reader, const AbaqusKeyword& keyword) {
  while (reader.lines.has_data()) {
    std::vector<std::string> fields;
    for (const auto field : reader.lines.take_fields()) fields.push_back(lower_case(field));
    if (fields.size() < 3) reader.fail(reader.lines.place(), "write elements, kind of load, size");
    const double size = reader.real(fields[2], "size");
    const auto elements = reader.elements(fields[0]);
    if (fields[1] == "grav") {
      if (elements.size() != reader.file.mesh.elements.size())
        reader.report.refuse(reader.here(keyword), "DLOAD.GRAV", "gravity acts on all here; name no elements");
      Vec3 direction{0, 0, 0};
      for (std::size_t i = 0; i < 3; ++i)
        direction[i] = fields.size() > 3 + i ? reader.real(fields[3 + i], "direction") : 0;
      if (!(length(direction) > 0)) reader.fail(reader.lines.place(), "gravity has no direction; write three numbers");
      for (int i = 0; i < 3; ++i)
        if (direction[i] != 0)  // as an acceleration of the base, which pushes the other way
          reader.deck.body_loads.push_back(
              {reader.here(keyword), i, reader.curve(keyword), -size * direction[i] / length(direction)});
    } else if (fields[1].size() == 2 && fields[1][0] == 'p' && fields[1][1] >= '1' && fields[1][1] <= '6') {
      Pressure pressure;
      pressure.source = reader.here(keyword);
      pressure.curve = reader.curve(keyword);
      pressure.scale = size;
      for (const int e : elements) {
        const auto corners = reader.file.mesh.face_nodes({e, fields[1][1] - '1'});
        Segment segment{};
        for (int i = 0; i < 4; ++i) segment[i] = reader.file.numbered.node_numbers()[corners[i]];
        pressure.segments.push_back(segment);
      }
      reader.deck.pressures.push_back(pressure);
    } else {
      reader.report.refuse(reader.here(keyword), "DLOAD",
                           fmt::format("load '{}' isn't read, only P1 to P6 and GRAV", for_message(fields[1])));
    }
  }
}

void read_abaqus_surface_load(AbaqusDeckReader& reader, const AbaqusKeyword& keyword) {
  while (reader.lines.has_data()) {
    std::vector<std::string> fields;
    for (const auto field : reader.lines.take_fields()) fields.push_back(lower_case(field));
    if (fields.size() < 3) reader.fail(reader.lines.place(), "write surface, kind of load, size");
    if (fields[1] != "p") {
      reader.report.refuse(reader.here(keyword), "DSLOAD",
                           fmt::format("load '{}' isn't read, only P", for_message(fields[1])));
      continue;
    }
    Pressure pressure;
    pressure.source = reader.here(keyword);
    pressure.curve = reader.curve(keyword);
    pressure.set = reader.surface(fields[0], reader.lines.place());
    pressure.scale = reader.real(fields[2], "pressure");
    reader.deck.pressures.push_back(pressure);
  }
}

}  // namespace railwave::deck
