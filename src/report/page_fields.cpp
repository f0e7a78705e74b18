#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "case/field_table.hpp"
#include "post/contact_tables.hpp"
#include "report/body_surface.hpp"
#include "report/page.hpp"

namespace railwave::page {
namespace {

/// Component `c` of `components` of the entries at `places`.
std::vector<double> component(const std::vector<double>& values, const std::vector<std::size_t>& places,
                              std::size_t components, std::size_t c) {
  std::vector<double> chosen;
  chosen.reserve(places.size());
  for (const std::size_t place : places) chosen.push_back(values[components * place + c]);
  return chosen;
}

/// One output of a field, each component by itself.
Json field_at(const BodySurface& body, const FieldRow& row, std::size_t output, PageBlocks& blocks) {
  const auto components = static_cast<std::size_t>(row.components);
  const std::vector<double> values = body.group.dataset(row.name).read_row<double>(output);
  if (values.size() != components * (row.of_nodes() ? body.set_nodes : body.set_cells))
    throw std::runtime_error(fmt::format("{} has another number of values than {}", row.name,
                                         row.of_nodes() ? "three a node" : "its cells"));
  Json references = Json::array();
  for (std::size_t c = 0; c < components; ++c)
    references.push_back(
        blocks.add_in_levels(component(values, row.of_nodes() ? body.node_places : body.face_places, components, c)));
  return references;
}

/// The displacement as a rigid motion and what that leaves, each axis by itself.
void add_displacement(const BodySurface& body, std::size_t output, PageBlocks& blocks, Json& members) {
  const std::vector<double> all = body.group.dataset("displacement").read_row<double>(output);
  if (all.size() != 3 * body.set_nodes)
    throw std::runtime_error("displacement has another number of values than three a node");
  std::vector<double> displacements;
  for (const std::size_t node : body.node_places)
    displacements.insert(displacements.end(), &all[3 * node], &all[3 * node] + 3);
  const RigidMotion rigid = nearest_rigid_motion(body.nodes, displacements);
  std::vector<std::vector<double>> rest(3);
  for (std::size_t i = 0; i < body.nodes.size(); ++i) {
    const Eigen::Vector3d left = body.nodes[i] + Eigen::Vector3d(&displacements[3 * i]) - rigid.moved(body.nodes[i]);
    for (std::size_t axis = 0; axis < 3; ++axis) rest[axis].push_back(left[static_cast<Eigen::Index>(axis)]);
  }
  Json turn = Json::array(), shift = Json::array(), references = Json::array();
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c) turn.push_back(rigid.turn(r, c));
  for (int axis = 0; axis < 3; ++axis) shift.push_back(rigid.shift[axis]);
  for (const auto& values : rest) references.push_back(blocks.add_in_levels(values));
  members["turn"] = turn;
  members["shift"] = shift;
  members["rest"] = references;
}

Json output_of(const BodySurface& body, std::size_t output, PageBlocks& blocks) {
  Json members{{"time", body.times[output]}}, fields = Json::object();
  for (const FieldRow* row : fields_for(FieldRow::fields)) {
    if (!body.group.has(row->name)) continue;
    if (std::string(row->name) == "displacement") {
      add_displacement(body, output, blocks, members);
    } else {
      fields[row->name] = field_at(body, *row, output, blocks);
    }
  }
  members["fields"] = fields;
  return members;
}

Json body_json(const BodySurface& body, bool contained, const Limits& limits, PageBlocks& blocks) {
  std::vector<double> coordinates;
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (const Eigen::Vector3d& node : body.nodes) coordinates.push_back(node[static_cast<Eigen::Index>(axis)]);
  std::vector<std::uint32_t> corners;
  for (std::size_t corner = 0; corner < 4; ++corner)
    for (const auto& face : body.faces) corners.push_back(face[corner]);
  Json outputs = Json::array();
  for (const std::size_t output : evenly_chosen(body.times.size(), limits.instants))
    outputs.push_back(output_of(body, output, blocks));
  return {{"name", body.name},
          {"contained", contained},
          {"nodes", body.nodes.size()},
          {"faces", body.faces.size()},
          {"coordinates", blocks.add(coordinates)},
          {"corners", blocks.add(corners)},
          {"outputs", outputs}};
}

/// Whether another set has all elements of this one, and more, or has the same and comes first.
bool is_contained(const std::vector<BodySurface>& bodies, std::size_t one) {
  for (std::size_t other = 0; other < bodies.size(); ++other) {
    const auto &a = bodies[one].elements, &b = bodies[other].elements;
    if (other == one || !std::includes(b.begin(), b.end(), a.begin(), a.end())) continue;
    if (b.size() > a.size() || other < one) return true;
  }
  return false;
}

Json units() {
  Json members = Json::object();
  for (const FieldRow* row : fields_for(FieldRow::fields)) members[row->name] = row->unit;
  return members;
}

Section read(const ResultsReader& results, const Limits& limits, PageBlocks& blocks) {
  const hdf5::Group root = results.root();
  std::vector<BodySurface> bodies;
  if (root.has("fields"))
    for (const std::string& name : root.group("fields").names())
      bodies.push_back(read_surface(name, root.group("fields")));
  Section section;
  Json items = Json::array();
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const std::size_t outputs = bodies[i].times.size();
    section.there.instants = std::max(section.there.instants, outputs);
    if (outputs > limits.instants)
      section.notes.push_back(
          fmt::format("fields of {}: {} of {} output times, evenly chosen", bodies[i].name, limits.instants, outputs));
    if (bodies[i].faces.size() != bodies[i].set_cells)
      section.notes.push_back(
          fmt::format("fields of {}: the outer faces of its {} elements", bodies[i].name, bodies[i].set_cells));
    items.push_back(body_json(bodies[i], is_contained(bodies, i), limits, blocks));
  }
  section.json = {{"units", units()}, {"bodies", items}};
  return section;
}

}  // namespace

Section field_section(const ResultsReader& results, const Limits& limits, PageBlocks& blocks) {
  return results.report_damage([&] { return read(results, limits, blocks); });
}

}  // namespace railwave::page
