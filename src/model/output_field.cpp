#include <stdexcept>
#include <string>

#include "model/boundaries/ties.hpp"
#include "model/elements/element_model.hpp"
#include "model/fields.hpp"
#include "model/nodal_state.hpp"

namespace railwave {
namespace {

template <NodeField field>
HostField motion(const ElementModel& /*elements*/, const NodalState& nodal, const Ties& ties,
                 const std::vector<int>& nodes) {
  return node_field(nodal, ties, field, nodes);
}

HostField stress(const ElementModel& elements, const NodalState& nodal, const Ties& /*ties*/,
                 const std::vector<int>& wanted) {
  return element_stress(elements, nodal.nodes, wanted);
}

HostField plastic_strain(const ElementModel& elements, const NodalState& /*nodal*/, const Ties& /*ties*/,
                         const std::vector<int>& wanted) {
  return element_plastic_strain(elements, wanted);
}

HostField mises(const ElementModel& elements, const NodalState& nodal, const Ties& /*ties*/,
                const std::vector<int>& wanted) {
  const std::vector<double> all = element_stress(elements, nodal.nodes, wanted).values;
  HostField field{1, std::vector<double>(wanted.size())};
  for (std::size_t i = 0; i < wanted.size(); ++i) field.values[i] = von_mises(&all[6 * i]);
  return field;
}

struct Fetch {
  const char* name;
  HostField (*values)(const ElementModel& elements, const NodalState& nodal, const Ties& ties,
                      const std::vector<int>& numbers);
};

/// One for each row of the table that serves `fields`.
constexpr Fetch fetches[] = {
    {"displacement", motion<NodeField::displacement>},
    {"velocity", motion<NodeField::velocity>},
    {"acceleration", motion<NodeField::acceleration>},
    {"stress", stress},
    {"mises", mises},
    {"plastic_strain", plastic_strain},
};

}  // namespace

HostField output_field(const ElementModel& elements, const NodalState& nodal, const Ties& ties, const FieldRow& row,
                       const std::vector<int>& numbers) {
  for (const Fetch& fetch : fetches)
    if (std::string(fetch.name) == row.name) return fetch.values(elements, nodal, ties, numbers);
  throw std::logic_error(std::string("the field ") + row.name + " has no fetch function in output_field.cpp");
}

}  // namespace railwave
