#include "solve/load_totals.hpp"

#include "kernels/block_sum.hpp"
#include "kernels/vector3.hpp"

namespace railwave {
namespace {

struct AmplitudeSum {
  static constexpr int values = 3;
  Array<const double* [3]> amplitude;
  KOKKOS_INLINE_FUNCTION void operator()(int i, double* sum) const {
    for (int k = 0; k < 3; ++k) sum[k] += amplitude(i, k);
  }
};

/// Area of facets along the outward normal, as they lie now (thesis eq. 2.18, one point).
struct FacetSum {
  static constexpr int values = 3;
  Array<const double* [3]> position;
  Array<const int* [4]> facets;
  KOKKOS_INLINE_FUNCTION void operator()(int f, double* sum) const {
    const Vector3 p0 = row(position, facets(f, 0)), p1 = row(position, facets(f, 1));
    const Vector3 p2 = row(position, facets(f, 2)), p3 = row(position, facets(f, 3));
    const Vector3 area = 0.5 * cross(p2 - p0, p3 - p1);
    for (int k = 0; k < 3; ++k) sum[k] += area[k];
  }
};

LoadTotals totals_of(const Model& model, const LoadArrays& arrays) {
  const scene::Load& load = *arrays.load;
  const double factor = curve_value(arrays.curve, model.time);
  LoadTotals totals;
  double sum[3] = {};
  switch (load.type) {
    case scene::LoadType::nodal_force:
      for (int i = 0; i < 3; ++i) totals.force[i] = factor * load.force[i];
      break;
    case scene::LoadType::traction:
      block_sum(AmplitudeSum{arrays.amplitude}, arrays.count, sum, model.sum_space);
      for (int i = 0; i < 3; ++i) totals.force[i] = factor * sum[i];
      break;
    case scene::LoadType::pressure:
      block_sum(FacetSum{model.nodes.position, arrays.facets}, arrays.count, sum, model.sum_space);
      for (int i = 0; i < 3; ++i) totals.force[i] = -factor * load.pressure * sum[i];
      break;
    case scene::LoadType::torque:
      totals.moment = factor * load.moment;
      break;
  }
  return totals;
}

}  // namespace

std::vector<LoadTotals> load_totals(const Model& model) {
  std::vector<LoadTotals> totals;
  for (const LoadArrays& load : model.loads) totals.push_back(totals_of(model, load));
  return totals;
}

}  // namespace railwave
