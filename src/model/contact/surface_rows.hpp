#pragma once

#include "mesh/vectors.hpp"
#include "model/lent_array.hpp"

/// Of all nodes' places or velocities those of a contact surface: a million nodes have some thousand.
namespace railwave {

struct GatherRows {
  Array<const double* [3]> values;
  Array<const int*> rows;
  Array<double* [3]> result;
  KOKKOS_INLINE_FUNCTION void operator()(const int i) const {
    for (int k = 0; k < 3; ++k) result(i, k) = values(rows(i), k);
  }
};

/// @param rows model node numbers
inline void gather_rows(const Array<double* [3]>& values, const Array<int*>& rows, const Array<double* [3]>& result) {
  Kokkos::parallel_for("gather_rows", Range(0, rows.extent(0)), GatherRows{values, rows, result});
}

/// @param rows model node numbers
inline Array<double* [3]> gathered_rows(const Array<double* [3]>& values, const Array<int*>& rows) {
  const auto result = unset_array<double* [3]>("rows", rows.extent(0));
  gather_rows(values, rows, result);
  return result;
}

/// The same on the host.
inline std::vector<Vec3> rows_on_host(const Array<double* [3]>& values, const Array<int*>& rows) {
  const LentArray<double* [3]> gathered(rows.extent(0));
  gather_rows(values, rows, *gathered);
  const auto host = to_host(*gathered);
  std::vector<Vec3> found(host.extent(0));
  for (std::size_t k = 0; k < found.size(); ++k) found[k] = {host(k, 0), host(k, 1), host(k, 2)};
  return found;
}

}  // namespace railwave
