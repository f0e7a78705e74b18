#include "model/output_field.hpp"

#include <stdexcept>
#include <string>

#include "model/von_mises.hpp"

namespace railwave {
namespace {

template <NodeField field>
HostField motion(const Model& model, const std::vector<int>& nodes) {
  return node_field(model, field, nodes);
}

HostField mises(const Model& model, const std::vector<int>& elements) {
  const std::vector<double> stress = element_stress(model, elements).values;
  HostField field{1, std::vector<double>(elements.size())};
  for (std::size_t i = 0; i < elements.size(); ++i) field.values[i] = von_mises(&stress[6 * i]);
  return field;
}

struct Fetch {
  const char* name;
  HostField (*values)(const Model& model, const std::vector<int>& numbers);
};

/// One for each row of the table that serves `fields`.
constexpr Fetch fetches[] = {
    {"displacement", motion<NodeField::displacement>},
    {"velocity", motion<NodeField::velocity>},
    {"acceleration", motion<NodeField::acceleration>},
    {"stress", element_stress},
    {"mises", mises},
    {"plastic_strain", element_plastic_strain},
};

}  // namespace

HostField output_field(const Model& model, const FieldRow& row, const std::vector<int>& numbers) {
  for (const Fetch& fetch : fetches)
    if (std::string(fetch.name) == row.name) return fetch.values(model, numbers);
  throw std::logic_error(std::string("the field ") + row.name + " has no fetch function in output_field.cpp");
}

}  // namespace railwave
