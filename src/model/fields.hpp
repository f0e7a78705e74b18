#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "case/field_table.hpp"
#include "mesh/mesh.hpp"

// Readers of results need no more of the modules than their names.
namespace railwave {

struct ElementModel;
struct NodalState;
struct NodeArrays;
struct Ties;

/// Von Mises' equivalent of a stress xx, yy, zz, xy, yz, zx: sqrt(3/2) times the size of its deviator.
inline double von_mises(const double* s) {
  const double xy = s[0] - s[1], yz = s[1] - s[2], zx = s[2] - s[0];
  return std::sqrt(0.5 * (xy * xy + yz * yz + zx * zx) + 3 * (s[3] * s[3] + s[4] * s[4] + s[5] * s[5]));
}

/// A field brought to the host: `components` values per entry, entry by entry.
struct HostField {
  int components = 0;
  std::vector<double> values;
};

enum class NodeField { position, displacement, velocity, acceleration };

/// Motion of the model's nodes listed, at the present instant t_n: position and displacement at t_n, velocity and
/// acceleration as (v(n-1/2) + v(n+1/2))/2 and a(n), along the directions of a prescribed motion as that says.
/// Components: 3, m, m/s, m/s2.
HostField node_field(const NodalState& nodal, const Ties& ties, NodeField field, const std::vector<int>& nodes);

/// Several of them, by one copy from the device.
std::vector<HostField> node_fields(const NodalState& nodal, const Ties& ties, const std::vector<NodeField>& fields,
                                   const std::vector<int>& nodes);

/// Cauchy stress at the present instant of the elements wanted (model element numbers): xx, yy, zz, xy, yz, zx in Pa.
HostField element_stress(const ElementModel& elements, const NodeArrays& nodes, const std::vector<int>& wanted);

/// Equivalent plastic strain at the present instant of the elements wanted; zero in elastic parts. One component.
HostField element_plastic_strain(const ElementModel& elements, const std::vector<int>& wanted);

/// A field of the table at the present instant, of the nodes or elements listed (model numbers), in their order. Throws
/// std::logic_error for a row that has no fetch function: rows that serve `fields` all have one.
HostField output_field(const ElementModel& elements, const NodalState& nodal, const Ties& ties, const FieldRow& row,
                       const std::vector<int>& numbers);

}  // namespace railwave
