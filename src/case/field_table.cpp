#include "case/field_table.hpp"

#include <stdexcept>

namespace railwave {
namespace {

constexpr auto node = FieldRow::Place::node, element = FieldRow::Place::element;
constexpr unsigned both = FieldRow::fields | FieldRow::histories;

std::string listed(const std::vector<const FieldRow*>& rows) {
  std::string text;
  for (const FieldRow* row : rows) {
    text += (text.empty() ? "`" : "; `") + std::string(row->name) + '`';
    if (std::string(row->unit) != "1") text += std::string(" (") + row->unit + ')';
    if (*row->meaning != '\0') text += std::string(": ") + row->meaning;
  }
  return text;
}

}  // namespace

const std::vector<FieldRow>& field_table() {
  static const std::vector<FieldRow> table{
      {"displacement", node, 3, "m", both, "from the undeformed position"},
      {"velocity", node, 3, "m/s", both, ""},
      {"acceleration", node, 3, "m/s2", both, ""},
      {"stress", element, 6, "Pa", both, "Cauchy stress xx, yy, zz, xy, yz, zx"},
      {"mises", element, 1, "Pa", FieldRow::fields, "von Mises' equivalent of the stress"},
      {"strain", element, 6, "1", FieldRow::histories,
       "logarithmic strain ln V of the element's mean deformation gradient, elastic and plastic together, tensor "
       "components"},
      {"plastic_strain", element, 1, "1", both, "equivalent plastic strain, zero in elastic parts"},
  };
  return table;
}

std::vector<const FieldRow*> fields_for(FieldRow::Use use) {
  std::vector<const FieldRow*> rows;
  for (const FieldRow& row : field_table())
    if (row.serves(use)) rows.push_back(&row);
  return rows;
}

std::vector<const FieldRow*> fields_for(FieldRow::Use use, FieldRow::Place place) {
  std::vector<const FieldRow*> rows;
  for (const FieldRow* row : fields_for(use))
    if (row->place == place) rows.push_back(row);
  return rows;
}

const FieldRow* find_field(const std::string& name) {
  for (const FieldRow& row : field_table())
    if (name == row.name) return &row;
  return nullptr;
}

const FieldRow& field_named(const std::string& name) {
  const FieldRow* row = find_field(name);
  if (row == nullptr) throw std::logic_error("there is no field " + name);
  return *row;
}

std::vector<std::string> names_of(const std::vector<const FieldRow*>& rows) {
  std::vector<std::string> names;
  for (const FieldRow* row : rows) names.emplace_back(row->name);
  return names;
}

std::string fields_help(FieldRow::Use use) {
  return "Of nodes: " + listed(fields_for(use, node)) + ". Of elements: " + listed(fields_for(use, element));
}

const std::vector<ContactFieldRow>& contact_field_table() {
  static const std::vector<ContactFieldRow> table{
      {"area", 1, false, "a quarter of every facet around the node"},
      {"position", 3, false, ""},
      {"displacement", 3, false, "from the undeformed position"},
      {"velocity", 3, false, ""},
      {"normal", 3, false, "of the surface, outwards"},
      {"normal_force", 3, false, ""},
      {"tangential_force", 3, false, ""},
      {"pressure", 1, false, "normal force over area"},
      {"shear", 3, false, "tangential force over area"},
      {"gap", 1, true, ""},
      {"slip_velocity", 3, true, ""},
      {"slipping", 1, true, "0 no contact, 1 sticks, 2 slips"},
      {"friction", 1, true, "the coefficient that acts, where it falls with speed"},
  };
  return table;
}

std::vector<std::string> contact_field_names() {
  std::vector<std::string> names;
  for (const ContactFieldRow& row : contact_field_table()) names.emplace_back(row.name);
  return names;
}

std::string contact_fields_help() {
  std::string text;
  for (const ContactFieldRow& row : contact_field_table()) {
    text += (text.empty() ? "`" : "; `") + std::string(row.name) + '`';
    if (*row.meaning != '\0') text += std::string(": ") + row.meaning;
  }
  return text;
}

}  // namespace railwave
