#pragma once

#include <array>
#include <string>
#include <vector>

#include "case/field_table.hpp"
#include "model/assembly.hpp"

namespace railwave {

/// Means over a set's elements by undeformed volume.
struct ElementMeans {
  std::array<double, 6> stress{};  ///< Pa, Cauchy: xx, yy, zz, xy, yz, zx
  std::array<double, 6> strain{};  ///< logarithmic strain ln V, likewise (tensor components)
  double plastic_strain = 0;       ///< equivalent
};

/// One of scene.output.history_sets, and what its history holds.
struct HistorySet {
  std::string name;
  /// In the order of case/field_table.hpp: of nodes means by mass, of elements means by volume.
  std::vector<const FieldRow*> quantities;
  std::string asked_by;       ///< "hammer NAME" or "probe NAME", where one of these made the set
  std::vector<int> elements;  ///< ascending; empty unless a quantity is one of elements
  Vec3 element_centre{};      ///< m, undeformed, mean of their centres by volume
  Vec3 asked_position{};      ///< m, of a probe: as the case has it
  bool of_probe() const { return asked_by.compare(0, 6, "probe ") == 0; }
  bool has(const std::string& quantity) const;
  std::vector<const FieldRow*> quantities_of(FieldRow::Place place) const;
  bool motion() const { return !quantities_of(FieldRow::Place::node).empty(); }
  bool inside() const { return !quantities_of(FieldRow::Place::element).empty(); }
};

/// What each of scene.output.history_sets means, in their order: a node set or point mass has its motion written, an
/// element set stress and strain, and plastic strain where a material of its elements yields; a name that is both has
/// all of it; a probe what it asks for. Throws InputError for a name that is no node or element set, with the nearest
/// that is.
std::vector<HistorySet> resolve_history_sets(const scene::Scene& scene, const Assembly& assembly);

/// Undeformed volume of each of the elements over that of all.
std::vector<double> volume_shares(const Assembly& assembly, const std::vector<int>& elements);

}  // namespace railwave
