#include "model/output_field.hpp"

#include <stdexcept>
#include <string>

namespace railwave {
namespace {

template <NodeField field>
HostField motion(const Model& model, const std::vector<int>& nodes) {
  return node_field(model, field, nodes);
}

struct Fetch {
  const char* name;
  HostField (*values)(const Model& model, const std::vector<int>& numbers);
};

/// One for each row of the table that serves `fields`.
constexpr Fetch fetches[] = {
    {"displacement", motion<NodeField::displacement>}, {"velocity", motion<NodeField::velocity>},
    {"acceleration", motion<NodeField::acceleration>}, {"stress", element_stress},
    {"plastic_strain", element_plastic_strain},
};

}  // namespace

HostField output_field(const Model& model, const FieldRow& row, const std::vector<int>& numbers) {
  for (const Fetch& fetch : fetches)
    if (std::string(fetch.name) == row.name) return fetch.values(model, numbers);
  throw std::logic_error(std::string("the field ") + row.name + " has no fetch function in output_field.cpp");
}

}  // namespace railwave
