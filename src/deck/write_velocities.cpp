#include <fmt/format.h>

#include "deck/conversion.hpp"
#include "mesh/vectors.hpp"

namespace railwave::deck {
namespace {

using Of = InitialVelocity::Of;

std::vector<int> nodes_of(Conversion& conversion, const InitialVelocity& initial) {
  std::vector<int> nodes;
  if (initial.of == Of::node || initial.of == Of::node_set)
    return conversion.members({initial.number, initial.of == Of::node_set}, initial.source);
  if (initial.of == Of::all) {
    for (std::size_t n = 0; n < conversion.deck.own_nodes; ++n) nodes.push_back(static_cast<int>(n));
    return nodes;
  }
  const auto parts = conversion.parts_of(initial.number, initial.of == Of::part_set, initial.source);
  for (const int e : conversion.elements_of(parts))
    for (const int n : conversion.bodies.mesh().elements[e]) nodes.push_back(n);
  for (const Beam& beam : conversion.deck.beams)
    if (parts.count(beam.part) != 0)
      for (const int end : {0, 1}) nodes.push_back(conversion.node(beam.nodes[end], beam.source));
  sort_unique(nodes);
  return nodes;
}

bool same_motion(const InitialVelocity* a, const InitialVelocity* b) {
  if (a == b) return true;
  const InitialVelocity none;
  const InitialVelocity &one = a ? *a : none, &other = b ? *b : none;
  return one.velocity == other.velocity && one.axes == other.axes && one.turning == 0 && other.turning == 0;
}

/// Along x, y, z.
Vec3 velocity_of(const Conversion& conversion, const InitialVelocity& initial) {
  if (initial.axes == 0) return initial.velocity;
  const auto axes = conversion.axes(initial.axes, initial.source);
  Vec3 velocity{0, 0, 0};
  for (int k = 0; k < 3; ++k)
    for (int i = 0; i < 3; ++i) velocity[i] += initial.velocity[k] * axes[k][i];
  return velocity;
}

void write_velocity(Conversion& conversion, const std::string& mover, const InitialVelocity& initial) {
  const bool rests = length(initial.velocity) == 0 && initial.turning == 0;
  if (rests) return;
  const Units& units = conversion.units;
  CaseText& text = conversion.text;
  text.section("initial_motion." + mover);
  text.key("parts", toml(std::vector<std::string>{mover}));
  text.key("velocity", scaled(units.velocity(), velocity_of(conversion, initial)));
  if (initial.turning != 0) {
    if (!(length(initial.axis) > 0)) conversion.fail(initial.source, "OMEGA turns about no axis; give NX, NY, NZ");
    text.key("angular_velocity", scaled(initial.turning / units.time / length(initial.axis), initial.axis));
    text.key("centre", scaled(units.length, initial.centre));
  }
  conversion.report.add(Fate::taken, initial.source, fmt::format("[initial_motion.{}]", mover));
}

}  // namespace

void write_velocities(Conversion& conversion) {
  // What comes later holds, node by node; a body moves as one.
  std::vector<const InitialVelocity*> at(conversion.deck.mesh.node_count(), nullptr);
  for (const InitialVelocity& initial : conversion.deck.velocities)
    for (const int n : nodes_of(conversion, initial)) at[n] = &initial;
  const auto& bodies = conversion.bodies.all();
  std::vector<const InitialVelocity*> of_body(bodies.size(), nullptr);
  std::vector<char> seen(bodies.size(), 0), mixed(bodies.size(), 0);
  for (std::size_t n = 0; n < at.size(); ++n) {
    const int body = conversion.bodies.of_node(static_cast<int>(n));
    if (body < 0) continue;
    if (seen[body] != 0 && !same_motion(at[n], of_body[body])) mixed[body] = 1;
    if (seen[body] == 0 || of_body[body] == nullptr) of_body[body] = at[n];
    seen[body] = 1;
  }
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    if (of_body[b] == nullptr) continue;
    if (mixed[b] != 0)
      conversion.report.refuse_always(
          of_body[b]->source,
          fmt::format("it moves some nodes of [parts.{}] alone, or several of its nodes differently: bodies start as "
                      "rigid ones do, so name all nodes of the part in one keyword",
                      bodies[b].name));
    else
      write_velocity(conversion, bodies[b].name, *of_body[b]);
  }
  for (const auto& [n, point] : conversion.points)
    if (at[n] != nullptr && !point.ground) write_velocity(conversion, point.name, *at[n]);
}

}  // namespace railwave::deck
