#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "deck/conversion.hpp"
#include "mesh/vectors.hpp"

namespace railwave::deck {
namespace {

const char* const axis_names[] = {"x", "y", "z"};

std::string directions_text(const std::array<bool, 6>& fixed, int first) {
  std::vector<std::string> names;
  for (int i = 0; i < 3; ++i)
    if (fixed[first + i]) names.push_back(axis_names[i]);
  return toml(names);
}

std::string matrix_text(const std::array<Vec3, 3>& axes) {
  return fmt::format("[{}, {}, {}]", toml(axes[0]), toml(axes[1]), toml(axes[2]));
}

/// Constraints of single nodes that hold alike go together: decks of many nodes have one card each.
struct Held {
  Source source;
  std::string name;
  std::array<bool, 6> fixed;
  Number axes;
  std::vector<int> nodes;
};

std::vector<Held> held_nodes(Conversion& conversion) {
  std::vector<Held> all;
  std::map<std::tuple<std::string, std::array<bool, 6>, Number>, std::size_t> single;
  for (const Constraint& constraint : conversion.deck.constraints) {
    const auto nodes = conversion.members(constraint.nodes, constraint.source);
    if (!constraint.nodes.is_set) {
      const auto [entry, is_new] =
          single.try_emplace({constraint.source.keyword, constraint.fixed, constraint.axes}, all.size());
      if (!is_new) {
        all[entry->second].nodes.push_back(nodes.front());
        continue;
      }
    }
    all.push_back(
        {constraint.source,
         constraint.nodes.is_set ? conversion.name_of(constraint.nodes) : fmt::format("held_{}", all.size() + 1),
         constraint.fixed, constraint.axes, nodes});
  }
  return all;
}

bool any(const std::array<bool, 6>& fixed, int first) { return fixed[first] || fixed[first + 1] || fixed[first + 2]; }

}  // namespace

void write_constraints(Conversion& conversion) {
  int count = 0;
  std::set<int> own_axes;  // points that a constraint has held in axes of its own
  for (const Held& held : held_nodes(conversion)) {
    const Target target = conversion.target(held.nodes);
    const auto write = [&](const std::string& name, bool turns) {
      CaseText& text = conversion.text;
      text.section(fmt::format("constraints.spc_{}", ++count));
      text.key("target", toml(name));
      if (any(held.fixed, 0)) text.key("fixed", directions_text(held.fixed, 0));
      if (turns) text.key("fixed_rotation", directions_text(held.fixed, 3));
      if (held.axes != 0) text.key("axes", matrix_text(conversion.axes(held.axes, held.source)));
    };
    const int first = count + 1;
    if (any(held.fixed, 0))
      for (const auto& [body, nodes] : target.of_body) write(conversion.mesh.node_set(body, nodes, held.name), false);
    for (const int n : target.points) {
      const Point& point = conversion.points.at(n);
      if (point.ground) continue;
      const bool turns = point.beam && any(held.fixed, 3);
      if (any(held.fixed, 0) || turns) write(point.name, turns);
    }
    std::string said = count < first ? "holds nothing that moves" : fmt::format("[constraints.spc_{}]", first);
    if (count > first) said += fmt::format(" to [constraints.spc_{}]", count);
    if (any(held.fixed, 3) && !target.of_body.empty()) said += "; nodes of hexahedra have no rotations to be held";
    if (!target.unused.empty()) said += fmt::format("; {} nodes of nothing left out", target.unused.size());
    conversion.report.add(count < first ? Fate::dropped : Fate::taken, held.source, said);
  }
}

namespace {

/// Motions that concern one node or set, or several nodes alike.
struct MotionGroup {
  std::string name;
  std::vector<const Motion*> motions;
  std::vector<int> nodes;
};

std::vector<MotionGroup> motion_groups(Conversion& conversion) {
  std::map<std::pair<bool, Number>, std::vector<const Motion*>> of_target;
  for (const Motion& motion : conversion.deck.motions)
    of_target[{motion.nodes.is_set, motion.nodes.number}].push_back(&motion);
  using Signature = std::vector<std::tuple<Number, Number, Number, double>>;
  std::map<Signature, std::size_t> of_nodes;
  std::vector<MotionGroup> groups;
  for (const auto& [target, motions] : of_target) {
    const Nodes nodes{target.second, target.first};
    const auto members = conversion.members(nodes, motions.front()->source);
    if (!nodes.is_set) {
      Signature signature;
      for (const Motion* one : motions) signature.emplace_back(one->direction, one->kind, one->curve, one->scale);
      const auto [entry, is_new] = of_nodes.emplace(signature, groups.size());
      if (!is_new) {
        groups[entry->second].nodes.push_back(members.front());
        continue;
      }
    }
    groups.push_back({conversion.name_of(nodes), motions, members});
  }
  return groups;
}

/// The velocity that an acceleration makes, as points of a curve: parabolas are taken to straight pieces.
std::vector<std::array<double, 2>> integral_of(const Curve& curve, double end) {
  constexpr int pieces = 32;
  auto points = curve.points;
  if (points.front()[0] > 0) points.insert(points.begin(), {0, points.front()[1]});
  if (points.back()[0] < end) points.push_back({end, points.back()[1]});
  std::vector<std::array<double, 2>> result{{points.front()[0], 0}};
  for (std::size_t i = 1; i < points.size(); ++i) {
    const double from = points[i - 1][0], width = points[i][0] - from, first = points[i - 1][1],
                 slope = (points[i][1] - first) / width, before = result.back()[1];
    for (int k = 1; k <= pieces; ++k) {
      const double t = width * k / pieces;
      result.push_back({from + t, before + first * t + slope * t * t / 2});
    }
  }
  return result;
}

/// An entry of the case for motions of a group: velocities of one curve, displacements of one.
struct CaseMotion {
  std::array<bool, 3> directions{};
  Vec3 velocity{0, 0, 0}, displacement{0, 0, 0};
  std::string curve, displacement_curve;
  std::vector<Source> sources;
};

/// Adds a motion to the first entry that has its curve or none, or to a new one.
bool add_motion(Conversion& conversion, const Motion& motion, std::vector<CaseMotion>& entries) {
  const Source& source = motion.source;
  if (motion.direction < 1 || motion.direction > 3) {
    conversion.report.refuse_always(
        source, fmt::format("DOF {} isn't read, only 1, 2 and 3 (x, y, z); turn the model, or move by these",
                            motion.direction));
    return false;
  }
  const int axis = static_cast<int>(motion.direction) - 1;
  std::string curve;
  if (motion.kind == 0 || motion.kind == 2) {
    curve = conversion.use_curve(motion.curve, source);
  } else if (motion.kind == 1) {
    curve = conversion.add_curve(fmt::format("integral_of_curve_{}", motion.curve),
                                 integral_of(conversion.curve(motion.curve, source), *conversion.deck.control.end));
    conversion.report.add(Fate::replaced, source, "its acceleration: the velocity that this makes, in straight pieces");
  } else {
    conversion.report.refuse_always(source, fmt::format("VAD {} isn't read, only 0 (velocity), 1 (acceleration) and 2 "
                                                        "(displacement)",
                                                        motion.kind));
    return false;
  }
  const bool moves = motion.kind == 2;
  const auto taken = [&](CaseMotion& made) -> std::string& { return moves ? made.displacement_curve : made.curve; };
  if (std::any_of(entries.begin(), entries.end(), [&](const CaseMotion& made) { return made.directions[axis]; })) {
    conversion.report.refuse_always(source, "a direction of these nodes has a motion already; keep one");
    return false;
  }
  auto entry = std::find_if(entries.begin(), entries.end(),
                            [&](CaseMotion& made) { return taken(made).empty() || taken(made) == curve; });
  if (entry == entries.end()) entry = entries.insert(entry, CaseMotion{});
  CaseMotion& made = *entry;
  taken(made) = curve;
  made.directions[axis] = true;
  made.sources.push_back(source);
  const double unit = motion.kind == 2   ? conversion.units.length
                      : motion.kind == 1 ? conversion.units.acceleration() * conversion.units.time
                                         : conversion.units.velocity();
  (moves ? made.displacement : made.velocity)[axis] = motion.scale * unit;
  return true;
}

void write_motion(Conversion& conversion, const std::string& target, const CaseMotion& made, int number) {
  const std::string name = fmt::format("prescribed_motion.motion_{}", number);
  CaseText& text = conversion.text;
  text.section(name);
  text.key("target", target);
  text.key("directions", directions_text({made.directions[0], made.directions[1], made.directions[2]}, 0));
  if (!made.curve.empty()) {
    text.key("velocity", made.velocity);
    text.key("curve", toml(made.curve));
  }
  if (!made.displacement_curve.empty()) {
    text.key("displacement", made.displacement);
    text.key("displacement_curve", toml(made.displacement_curve));
  }
  for (const Source& source : made.sources) conversion.report.add(Fate::taken, source, "[" + name + "]");
}

}  // namespace

void write_motions(Conversion& conversion) {
  int count = 0;
  std::map<int, std::array<bool, 3>> moved;
  for (const MotionGroup& group : motion_groups(conversion)) {
    const Source& source = group.motions.front()->source;
    std::vector<CaseMotion> entries;
    bool good = true;
    for (const Motion* motion : group.motions) good = add_motion(conversion, *motion, entries) && good;
    if (!good) continue;
    for (const CaseMotion& made : entries)
      for (const int n : group.nodes)
        for (int axis = 0; axis < 3; ++axis) {
          bool& taken = moved[n][axis];
          if (taken && made.directions[axis])
            return conversion.report.refuse_always(
                source, fmt::format("node {} is moved along {} by another set's motion already; leave it out of one "
                                    "of the two",
                                    conversion.deck.mesh.node_numbers()[n], axis_names[axis]));
          taken = taken || made.directions[axis];
        }
    const Target target = conversion.target(group.nodes);
    if (!target.points.empty())
      conversion.report.refuse_always(source,
                                      "points, nodes of no hexahedron, can't be moved here; name nodes of bodies");
    for (const auto& [body, of_body] : target.of_body) {
      const std::string set = toml(conversion.mesh.node_set(body, of_body, group.name));
      for (const CaseMotion& made : entries) write_motion(conversion, set, made, ++count);
    }
    if (target.of_body.empty() && target.points.empty())
      conversion.report.add(Fate::dropped, source, "its nodes belong to nothing");
  }
}

void write_non_reflecting(Conversion& conversion) {
  int count = 0;
  for (const NonReflecting& end : conversion.deck.non_reflecting)
    for (const auto& [body, faces] : conversion.by_body(conversion.faces_of_set(end.set, end.source))) {
      const std::string name = fmt::format("non_reflecting.end_{}", ++count);
      conversion.text.section(name);
      conversion.text.key("target", toml(conversion.mesh.surface(body, faces, conversion.name_of_segments(end.set))));
      conversion.report.add(Fate::taken, end.source, "[" + name + "]");
    }
}

}  // namespace railwave::deck
