#include "output/fields/contact_section.hpp"

#include <algorithm>
#include <memory>
#include <stdexcept>

namespace railwave {
namespace {

// How rows of near nodes lie: some forty outputs of a patch together, which compress to seven tenths of what they take
// alone.
constexpr hdf5::Storage many_rows{16384, true};

const ContactFieldRow& row_named(const std::string& name) {
  for (const ContactFieldRow& row : contact_field_table())
    if (name == row.name) return row;
  throw std::logic_error("no contact field is called " + name);
}

hdf5::Dataset make_growing(const hdf5::Group& group, const ContactFieldRow& row, hdf5::Shape shape,
                           const NumberFormat& format, const hdf5::Storage& storage) {
  if (row.components > 1) shape.push_back(static_cast<hsize_t>(row.components));
  if (std::string(row.name) == "slipping") return group.create_growing<signed char>(row.name, shape, storage);
  return format.make_growing(group, row.name, shape, storage);
}

}  // namespace

ContactSection::Side ContactSection::make_side(const hdf5::Group& group, bool slave,
                                               const ContactDescription& contact) const {
  Side side;
  side.slave = slave;
  side.surface = slave ? &contact.slave_surface : &contact.master_surface;
  const hsize_t count = side.surface->nodes.size();
  group.write("nodes", side.surface->nodes, {count});
  std::vector<int> corners;
  for (const auto& facet : side.surface->facets) corners.insert(corners.end(), facet.begin(), facet.end());
  group.write("facets", corners, {side.surface->facets.size(), 4});
  group.write("coordinates", side.surface->coordinates, {count, 3});
  if (!output_.has_side(slave)) {
    group.set_attribute("fields", "");
    return side;
  }
  const hdf5::Group near = output_.near_only() ? group.create_group(hdf5::near_nodes) : hdf5::Group();
  const hdf5::Group& columns = output_.near_only() ? near : group;
  if (output_.near_only()) {
    side.rows = group.create_growing<long>("rows", {}, times_in_block);
    const std::vector<long> ends = side.rows.read<long>();
    side.row_count = ends.empty() ? 0 : ends.back();
    side.nodes = near.create_growing<int>("node", {}, many_rows);
  }
  std::string names;
  for (const std::string& name : output_.fields) {
    const ContactFieldRow& row = row_named(name);
    if (!has_values(row, slave, contact.falling_friction)) continue;
    names += (names.empty() ? "" : ", ") + name;
    side.columns.push_back({&row, output_.near_only()
                                      ? make_growing(columns, row, {}, output_.format, many_rows)
                                      : make_growing(columns, row, {count}, output_.format, each_time)});
  }
  group.set_attribute("fields", names);
  return side;
}

std::vector<double> ContactSection::Side::values_of(const Column& column, const ContactState& state,
                                                    const ContactOutput& output) const {
  std::vector<double> values = contact_values(state, slave, *column.row);
  output.format.round(column.row->name, values);
  return values;
}

void ContactSection::Side::add(const ContactState& state, const ContactOutput& output, const CompressedRows& packed) {
  const ContactSide& now = slave ? state.slave : state.master;
  if (output.near_only()) {
    row_count += static_cast<long>(now.nodes.size());
    rows.append(&row_count, 1);
    nodes.append(now.places.data(), now.places.size());
  } else if (now.nodes != surface->nodes) {
    throw std::logic_error("the nodes of a contact surface changed during the run");
  }
  for (Column& column : columns)
    if (!packed.append_to(column.dataset))
      column.dataset.append(values_of(column, state, output).data(), output.near_only() ? now.nodes.size() : 1);
}

ContactSection::ContactSection(const hdf5::Group& contacts_group, const ContactDescription& contact, int number,
                               const ContactOutput& output)
    : number_(number), output_(output) {
  const hdf5::Group group = contacts_group.create_group(contact.name);
  group.set_attribute("friction", contact.friction);
  const hdf5::Group slave = group.create_group("slave"), master = group.create_group("master");
  slave.set_attribute("surface", contact.slave);
  master.set_attribute("surface", contact.master.text());
  if (contact.master.size() > 1) {
    master.set_attribute("surfaces", contact.master.list());
    std::vector<int> surface_of_facet;
    for (std::size_t k = 0; k < contact.master_facets.size(); ++k)
      surface_of_facet.insert(surface_of_facet.end(), contact.master_facets[k], static_cast<int>(k));
    master.write("surface_of_facet", surface_of_facet, {surface_of_facet.size()});
  }
  sides_.push_back(make_side(slave, true, contact));
  sides_.push_back(make_side(master, false, contact));
  sides_.erase(
      std::remove_if(sides_.begin(), sides_.end(), [&](const Side& side) { return !output.has_side(side.slave); }),
      sides_.end());
  steps_ = group.create_growing<long>("step", {}, times_in_block);
  times_ = group.create_growing<double>("time", {}, times_in_block);  // last, see HistorySection
}

void ContactSection::add_rows(const FieldSource& source, CompressedRows& rows) const {
  if (output_.near_only()) return;  // many of their rows are a chunk
  const auto state = std::make_shared<const ContactState>(source.contact(number_));
  for (const Side& side : sides_)
    for (const Column& column : side.columns)
      rows.add(column.dataset, [this, &side, &column, state] { return side.values_of(column, *state, output_); });
}

void ContactSection::add_values(const FieldSource& source, long step, const CompressedRows& packed) {
  const ContactState state = source.contact(number_);
  for (Side& side : sides_) side.add(state, output_, packed);
  steps_.append(&step, 1);
}

}  // namespace railwave
