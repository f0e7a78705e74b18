#include <algorithm>
#include <stdexcept>
#include <string>

#include "output/fields/contact_section.hpp"

namespace railwave {
namespace {

constexpr const char* friction = "friction";

struct Fetch {
  const char* name;
  std::vector<double> (*values)(const ContactState& state, const ContactSide& side);
};

template <std::vector<double> ContactSide::*member>
std::vector<double> of_side(const ContactState& /*state*/, const ContactSide& side) {
  return side.*member;
}

template <std::vector<double> ContactState::*member>
std::vector<double> of_slave(const ContactState& state, const ContactSide& /*side*/) {
  return state.*member;
}

/// One for each row of the table.
constexpr Fetch fetches[] = {
    {"area", of_side<&ContactSide::area>},
    {"position", of_side<&ContactSide::position>},
    {"displacement", of_side<&ContactSide::displacement>},
    {"velocity", of_side<&ContactSide::velocity>},
    {"normal", of_side<&ContactSide::normal>},
    {"normal_force", of_side<&ContactSide::normal_force>},
    {"tangential_force", of_side<&ContactSide::tangential_force>},
    {"pressure", [](const ContactState&, const ContactSide& side) { return nodal_pressure(side); }},
    {"shear", [](const ContactState&, const ContactSide& side) { return nodal_shear(side); }},
    {"gap", of_slave<&ContactState::gap>},
    {"slip_velocity", of_slave<&ContactState::slip_velocity>},
    {"slipping", [](const ContactState& state,
                    const ContactSide&) { return std::vector<double>(state.slipping.begin(), state.slipping.end()); }},
    {friction, of_slave<&ContactState::friction_now>},
};

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

std::vector<double> contact_values(const ContactState& state, bool slave, const ContactFieldRow& row) {
  const ContactSide& side = slave ? state.slave : state.master;
  for (const Fetch& fetch : fetches) {
    if (std::string(fetch.name) != row.name) continue;
    std::vector<double> values = fetch.values(state, side);
    if (values.size() != row.components * side.nodes.size())
      throw std::logic_error(std::string(row.name) + " of a contact has another length than its nodes");
    return values;
  }
  throw std::logic_error(std::string("the contact field ") + row.name + " has no entry in contact_values.cpp");
}

bool ContactOutput::has_any(std::initializer_list<const char*> names) const {
  return std::any_of(names.begin(), names.end(),
                     [&](const char* name) { return std::find(fields.begin(), fields.end(), name) != fields.end(); });
}

ContactWish ContactOutput::wish() const {
  return {margin, slave, master, has_any({"area", "position", "normal", "pressure", "shear"}), has_any({"gap"})};
}

bool has_values(const ContactFieldRow& row, bool slave, bool falling_friction) {
  return (slave || !row.of_slave_only) && (row.name != std::string(friction) || falling_friction);
}

}  // namespace railwave
