#include "kernels/support/vector3.hpp"
#include "solve/monitor/energies.hpp"

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

void queue_total(const NodalState& nodal, const LoadArrays& arrays, LoadTotals& totals, Reductions& sums) {
  const scene::Load& load = *arrays.load;
  const double factor = curve_value(arrays.curve, nodal.time);
  const auto forces = [&totals](double scale) {
    return [&totals, scale](const double* sum) {
      for (int i = 0; i < 3; ++i) totals.force[i] = scale * sum[i];
    };
  };
  switch (load.type) {
    case scene::LoadType::nodal_force:
      for (int i = 0; i < 3; ++i) totals.force[i] = factor * load.force[i];
      break;
    case scene::LoadType::traction:
      sums.sum(AmplitudeSum{arrays.amplitude}, arrays.count, forces(factor));
      break;
    case scene::LoadType::pressure:
      sums.sum(FacetSum{nodal.nodes.position, arrays.facets}, arrays.count, forces(-factor * load.pressure));
      break;
    case scene::LoadType::torque:
      totals.moment = factor * load.moment;
      break;
  }
}

}  // namespace

void queue_load_totals(const NodalState& nodal, const std::vector<LoadArrays>& loads, std::vector<LoadTotals>& totals,
                       Reductions& sums) {
  totals.resize(loads.size());
  for (std::size_t l = 0; l < totals.size(); ++l) queue_total(nodal, loads[l], totals[l], sums);
}

}  // namespace railwave
