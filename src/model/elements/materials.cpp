#include "model/elements/materials.hpp"

#include <algorithm>
#include <set>

#include "model/host_copy.hpp"

namespace railwave {

MaterialArrays material_arrays(int number, const std::vector<const scene::Material*>& materials) {
  MaterialArrays arrays;
  arrays.number = number;
  with_material_type(arrays, [&](auto type) {
    using Material = typename decltype(type)::type;
    using Constants = typename Material::Constants;
    constexpr std::size_t values = sizeof(Constants) / sizeof(double);
    std::vector<double> rows(values * materials.size());
    for (std::size_t r = 0; r < materials.size(); ++r) {
      const Constants constants = MaterialTrait<Material>::constants(*materials[r]);
      const auto* first = reinterpret_cast<const double*>(&constants);
      std::copy(first, first + values, rows.begin() + static_cast<std::ptrdiff_t>(values * r));
    }
    arrays.constants = to_device("material constants", rows);
    arrays.history_values = Material::history_values;
  });
  return arrays;
}

std::vector<std::string> materials_left_out(const scene::Scene& scene) {
  std::set<int> numbers;
  for (const auto& part : scene.parts)
    for (const auto& material : scene.materials)
      if (material.name == part.material) numbers.insert(material_number(material));
  bool any_elastic = false, any_flows = false;
  for_each_type(Materials{}, [&](int number, auto type) {
    (decltype(type)::type::history_values > 0 ? any_flows : any_elastic) |= numbers.count(number) > 0;
  });
  if (!any_flows) return {"plasticity: every part is elastic, no yield test and no stored stress"};
  std::vector<std::string> left_out;
  if (any_elastic) left_out.emplace_back("plasticity of the elastic parts: they have no yield test and no history");
  for_each_type(Materials{}, [&](int number, auto type) {
    const char* words = MaterialTrait<typename decltype(type)::type>::left_out_as;
    if (words != nullptr && numbers.count(number) == 0) left_out.emplace_back(words);
  });
  return left_out;
}

}  // namespace railwave
