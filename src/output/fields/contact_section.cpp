#include "output/fields/contact_section.hpp"

#include <algorithm>
#include <limits>
#include <stdexcept>

namespace railwave {
namespace {

Vec3 position_of(const ContactSide& side, std::size_t node) {
  return {side.position[3 * node], side.position[3 * node + 1], side.position[3 * node + 2]};
}

bool feels_force(const ContactSide& side, std::size_t node) {
  for (std::size_t i = 3 * node; i < 3 * node + 3; ++i)
    if (side.normal_force[i] != 0 || side.tangential_force[i] != 0) return true;
  return false;
}

/// Around all nodes that touch, and by the margin wider; nothing is in it where none does.
Bounds box_of_contact(const ContactState& state, double margin) {
  Bounds box = no_bounds;
  for (const ContactSide* side : {&state.slave, &state.master})
    for (std::size_t n = 0; n < side->nodes.size(); ++n)
      if (feels_force(*side, n) || (side == &state.slave && state.slipping[n] != 0)) widen(box, position_of(*side, n));
  for (int i = 0; i < 3; ++i) {
    box[0][i] -= margin;
    box[1][i] += margin;
  }
  return box;
}

/// The values, and not-a-number for nodes outside the box.
std::vector<double> within(const std::optional<Bounds>& box, const ContactSide& side, std::vector<double> values) {
  if (!box || side.nodes.empty()) return values;
  const std::size_t components = values.size() / side.nodes.size();
  for (std::size_t n = 0; n < side.nodes.size(); ++n)
    if (!holds(*box, position_of(side, n)))
      std::fill_n(values.begin() + static_cast<long>(n * components), components,
                  std::numeric_limits<double>::quiet_NaN());
  return values;
}

void append(hdf5::Dataset& dataset, const std::vector<double>& values, std::size_t expected) {
  if (values.size() != expected) throw std::logic_error("a contact state has arrays of another length than its nodes");
  dataset.append(values.data(), 1);
}

}  // namespace

std::vector<double> nodal_pressure(const ContactSide& side) {
  std::vector<double> pressure(side.area.size(), 0.0);
  for (std::size_t i = 0; i < pressure.size(); ++i) {
    double outward = 0;
    for (int c = 0; c < 3; ++c) outward += side.normal_force[3 * i + c] * side.normal[3 * i + c];
    if (side.area[i] > 0 && outward != 0) pressure[i] = -outward / side.area[i];
  }
  return pressure;
}

std::vector<double> nodal_shear(const ContactSide& side) {
  std::vector<double> shear(3 * side.area.size(), 0.0);
  for (std::size_t i = 0; i < shear.size(); ++i)
    if (side.area[i / 3] > 0) shear[i] = side.tangential_force[i] / side.area[i / 3];
  return shear;
}

ContactSection::Side::Side(const hdf5::Group& group, const ContactSide& first, const FieldSource& source)
    : nodes(first.nodes), facet_count(first.facets.size()) {
  const hsize_t count = nodes.size();
  group.write("nodes", nodes, {count});
  std::vector<int> corners;
  for (const auto& facet : first.facets) corners.insert(corners.end(), facet.begin(), facet.end());
  group.write("facets", corners, {first.facets.size(), 4});
  std::vector<double> coordinates = first.position;
  const std::vector<double> moved = source.field(field_named("displacement"), nodes).values;
  for (std::size_t i = 0; i < coordinates.size(); ++i) coordinates[i] -= moved.at(i);
  group.write("coordinates", coordinates, {count, 3});
  area = group.create_growing<double>("area", {count}, each_time);
  pressure = group.create_growing<double>("pressure", {count}, each_time);
  for (auto [name, dataset] : {std::pair{"displacement", &displacement},
                               {"position", &position},
                               {"velocity", &velocity},
                               {"normal", &normal},
                               {"normal_force", &normal_force},
                               {"tangential_force", &tangential_force},
                               {"shear", &shear}})
    *dataset = group.create_growing<double>(name, {count, 3}, each_time);
}

void ContactSection::Side::add(const ContactSide& state, const FieldSource& source, const std::optional<Bounds>& box) {
  if (state.nodes != nodes) throw std::logic_error("the nodes of a contact surface changed during the run");
  const std::size_t count = nodes.size();
  const auto append_within = [&](hdf5::Dataset& dataset, const std::vector<double>& values, std::size_t components) {
    append(dataset, within(box, state, values), components * count);
  };
  append_within(area, state.area, 1);
  append_within(displacement, source.field(field_named("displacement"), nodes).values, 3);
  append_within(position, state.position, 3);
  append_within(velocity, state.velocity, 3);
  append_within(normal, state.normal, 3);
  append(normal_force, state.normal_force, 3 * count);
  append(tangential_force, state.tangential_force, 3 * count);
  append(pressure, nodal_pressure(state), count);
  append(shear, nodal_shear(state), 3 * count);
}

ContactSection::ContactSection(const hdf5::Group& contacts_group, const FieldSource& source, int contact,
                               std::optional<double> margin)
    : contact_(contact), margin_(margin) {
  const ContactState first = source.contact(contact);
  falling_friction_ = !first.friction_now.empty();
  const hdf5::Group group = contacts_group.create_group(first.name);
  group.set_attribute("friction", first.friction);
  const hdf5::Group slave_group = group.create_group("slave");
  slave_ = Side(slave_group, first.slave, source);
  master_ = Side(group.create_group("master"), first.master, source);
  const hsize_t count = first.slave.nodes.size();
  gap_ = slave_group.create_growing<double>("gap", {count}, each_time);
  slip_velocity_ = slave_group.create_growing<double>("slip_velocity", {count, 3}, each_time);
  if (falling_friction_) friction_ = slave_group.create_growing<double>("friction", {count}, each_time);
  slipping_ = slave_group.create_growing<signed char>("slipping", {count}, each_time);
  times_ = group.create_growing<double>("time", {}, times_in_block);
  steps_ = group.create_growing<long>("step", {}, times_in_block);
}

void ContactSection::add_values(const FieldSource& source, long step) {
  const ContactState state = source.contact(contact_);
  const std::size_t count = slave_.nodes.size();
  if (state.slipping.size() != count)
    throw std::logic_error("a contact state has arrays of another length than its nodes");
  std::optional<Bounds> box;
  if (margin_) box = box_of_contact(state, *margin_);
  slave_.add(state.slave, source, box);
  master_.add(state.master, source, box);
  append(gap_, within(box, state.slave, state.gap), count);
  append(slip_velocity_, within(box, state.slave, state.slip_velocity), 3 * count);
  if (falling_friction_) append(friction_, within(box, state.slave, state.friction_now), count);
  const std::vector<signed char> slipping(state.slipping.begin(), state.slipping.end());
  slipping_.append(slipping.data(), 1);
  steps_.append(&step, 1);
}

}  // namespace railwave
