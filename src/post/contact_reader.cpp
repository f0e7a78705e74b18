#include "post/contact_reader.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include <fmt/format.h>

#include "case/error.hpp"
#include "case/field_table.hpp"
#include "case/suggest.hpp"
#include "post/results_reader.hpp"

namespace railwave {
namespace {

std::vector<std::array<int, 4>> read_facets(const hdf5::Group& group, std::size_t node_count) {
  const std::vector<int> corners = group.dataset("facets").read<int>();
  if (corners.size() % 4 != 0) throw std::runtime_error("a facet has no four corners");
  std::vector<std::array<int, 4>> facets(corners.size() / 4);
  for (std::size_t i = 0; i < corners.size(); ++i) {
    if (corners[i] < 0 || corners[i] >= static_cast<int>(node_count))
      throw std::runtime_error("a facet has a corner that is no node");
    facets[i / 4][i % 4] = corners[i];
  }
  return facets;
}

/// Throws where a field is missing that the file says it has, or is there and not named. Files of earlier versions name
/// none: they have all, but the coefficient of friction where it is constant.
void expect_fields(const hdf5::Group& side, const hdf5::Group& fields, bool slave) {
  const bool names_them = side.has_attribute("fields");
  const std::string named = names_them ? ", " + side.text_attribute("fields") + ", " : "";
  for (const ContactFieldRow& row : contact_field_table()) {
    if (!names_them) {
      if (std::string(row.name) != "friction" && (slave || !row.of_slave_only)) fields.dataset(row.name);
      continue;
    }
    const bool is_named = named.find(", " + std::string(row.name) + ", ") != std::string::npos;
    if (is_named) fields.dataset(row.name);
    if (!is_named && fields.has(row.name))
      throw std::runtime_error(std::string("it does not say that it has ") + row.name);
  }
}

/// Leaves the nodes at `places`, ascending, and the facets between them.
void keep_nodes(ContactSide& side, const std::vector<int>& places) {
  std::vector<int> place_of(side.nodes.size(), -1), nodes;
  for (std::size_t k = 0; k < places.size(); ++k) {
    const int place = places[k];
    if (place < 0 || place >= static_cast<int>(side.nodes.size()) || (k > 0 && place <= places[k - 1]))
      throw std::runtime_error("a node near the contact is no node of its surface");
    place_of[place] = static_cast<int>(k);
    nodes.push_back(side.nodes[place]);
  }
  std::vector<std::array<int, 4>> facets;
  for (std::array<int, 4> facet : side.facets) {
    for (int& corner : facet) corner = place_of[corner];
    if (std::find(facet.begin(), facet.end(), -1) == facet.end()) facets.push_back(facet);
  }
  side.nodes = std::move(nodes);
  side.facets = std::move(facets);
  side.places = places;
}

}  // namespace

/// How many outputs are there: a kill in the middle of a flush may leave the arrays with different lengths.
std::size_t ContactReader::Side::outputs(std::size_t most) const {
  if (!written) return most;
  const auto there = [&](const char* name) { return static_cast<std::size_t>(group.dataset(name).shape().at(0)); };
  std::size_t least = near_only ? there("node") : most;
  for (const ContactFieldRow& row : contact_field_table())
    if (group.has(row.name)) least = std::min(least, there(row.name));
  if (near_only)
    least =
        static_cast<std::size_t>(std::upper_bound(rows.begin(), rows.end(), static_cast<long>(least)) - rows.begin());
  return std::min(most, least);
}

ContactReader::Side::Rows ContactReader::Side::rows_of(std::size_t output) const {
  if (!near_only) return {output, 1};
  const auto first = static_cast<hsize_t>(output == 0 ? 0 : rows.at(output - 1));
  return {first, static_cast<hsize_t>(rows.at(output)) - first};
}

template <class Value>
std::vector<Value> ContactReader::Side::values(const char* name, std::size_t output, std::size_t count) const {
  if (!has(name)) return {};
  const Rows there = rows_of(output);
  std::vector<Value> read = group.dataset(name).read_rows<Value>(there.first, there.count);
  if (read.size() != count) throw std::runtime_error("an array has another length than the nodes");
  return read;
}

ContactReader::Side ContactReader::side(const hdf5::Group& contact, bool slave) const {
  hdf5::Group group = contact.group(slave ? "slave" : "master");
  Side side;
  side.nodes = group.dataset("nodes").read<int>();
  side.facets = read_facets(group, side.nodes.size());
  side.coordinates = group.dataset("coordinates").read<double>();
  if (side.coordinates.size() != 3 * side.nodes.size())
    throw std::runtime_error("an array has another length than the nodes");
  side.near_only = group.has("rows");
  if (side.near_only) {
    side.rows = group.dataset("rows").read<long>();
    if (!std::is_sorted(side.rows.begin(), side.rows.end()) || (!side.rows.empty() && side.rows.front() < 0))
      throw std::runtime_error("rows of nodes near the contact are out of order");
    group = group.group(hdf5::near_nodes);
  }
  for (const ContactFieldRow& row : contact_field_table()) side.written = side.written || group.has(row.name);
  expect_fields(contact.group(slave ? "slave" : "master"), group, slave);
  side.group = std::move(group);
  return side;
}

ContactReader::ContactReader(const ResultsReader& results, const std::string& contact)
    : path_(results.path()), contact_(contact) {
  const std::vector<std::string> known = results.contacts();
  if (std::find(known.begin(), known.end(), contact) == known.end())
    throw InputError(
        fmt::format("results file {} has no contact '{}'; {}", path_, contact, suggestion(contact, known)));
  results.report_damage([&] {
    const hdf5::Group group = results.contact_group(contact);
    friction_ = group.number_attribute("friction");
    slave_ = side(group, true);
    master_ = side(group, false);
    times_ = group.dataset("time").read<double>();
    times_.resize(std::min(slave_.outputs(times_.size()), master_.outputs(times_.size())));
  });
  for (const char* needed : {"normal_force", "tangential_force"})
    if (!slave_.has(needed))
      throw InputError(
          fmt::format("results file {} has no {} of the slave surface of contact '{}'; name it in "
                      "output.contact_fields, and slave in output.contact_sides",
                      path_, needed, contact));
  if (!slave_.has("position") && !slave_.has("displacement"))
    throw InputError(
        fmt::format("results file {} has no positions of contact '{}'; name position or displacement in "
                    "output.contact_fields",
                    path_, contact));
}

ContactSide ContactReader::read_side(const Side& from, std::size_t index) const {
  ContactSide side;
  side.nodes = from.nodes;
  side.facets = from.facets;
  if (from.near_only) {
    const auto [first, count] = from.rows_of(index);
    keep_nodes(side, from.group.dataset("node").read_rows<int>(first, count));
  }
  const auto read = [&](const char* name, std::size_t components) {
    return from.values<double>(name, index, components * side.nodes.size());
  };
  side.displacement = read("displacement", 3);
  side.position = read("position", 3);
  if (side.position.empty() && !side.displacement.empty()) {
    side.position = side.displacement;
    for (std::size_t i = 0; i < side.nodes.size(); ++i)
      for (int c = 0; c < 3; ++c)
        side.position[3 * i + c] += from.coordinates[3 * (side.places.empty() ? i : side.places[i]) + c];
  }
  side.velocity = read("velocity", 3);
  side.area = read("area", 1);
  side.normal = read("normal", 3);
  if (!side.position.empty() && (side.area.empty() || side.normal.empty())) {
    SurfaceGeometry geometry = surface_geometry(side.position, side.facets);
    if (side.area.empty()) side.area = std::move(geometry.area);
    if (side.normal.empty()) side.normal = std::move(geometry.normal);
  }
  side.normal_force = read("normal_force", 3);
  side.tangential_force = read("tangential_force", 3);
  return side;
}

ContactState ContactReader::read(std::size_t index) const {
  ContactState state;
  state.name = contact_;
  state.friction = friction_;
  state.slave = read_side(slave_, index);
  if (master_.has("position") || master_.has("displacement")) state.master = read_side(master_, index);
  const std::size_t count = state.slave.nodes.size();
  state.gap = slave_.values<double>("gap", index, count);
  state.slip_velocity = slave_.values<double>("slip_velocity", index, 3 * count);
  const auto slipping = slave_.values<signed char>("slipping", index, count);
  state.slipping.assign(slipping.begin(), slipping.end());
  state.friction_now = slave_.values<double>("friction", index, count);
  return state;
}

ContactState ContactReader::state(std::size_t index) const {
  try {
    return read(index);
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    throw InputError(fmt::format("results file {} is damaged: contact '{}', output time {}: {}", path_, contact_, index,
                                 error.what()));
  }
}

}  // namespace railwave
