#pragma once

#include <vector>

#include "case/field_table.hpp"
#include "model/fields.hpp"

namespace railwave {

/// Where the results file gets its fields from: the running model, or in a test a made-up one. All at one instant.
class FieldSource {
 public:
  virtual ~FieldSource() = default;
  /// @param numbers of nodes or elements, whichever the field belongs to
  virtual HostField field(const FieldRow& row, const std::vector<int>& numbers) const = 0;
  virtual ContactState contact(int number) const = 0;
  /// Section forces and moments of all elements of beams, N and N m: six components.
  virtual HostField beams() const { return {6, {}}; }
};

}  // namespace railwave
