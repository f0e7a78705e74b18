#pragma once

#include <vector>

#include "model/fields.hpp"

namespace railwave {

/// Where the results file gets its fields from: the running model, or in a test a made-up one. All at one instant.
class FieldSource {
 public:
  virtual ~FieldSource() = default;
  virtual HostField nodes(NodeField field, const std::vector<int>& node_numbers) const = 0;
  virtual HostField stress(const std::vector<int>& element_numbers) const = 0;
  virtual HostField plastic_strain(const std::vector<int>& element_numbers) const = 0;
  virtual ContactState contact(int number) const = 0;
  /// Section forces and moments of all elements of beams, N and N m: six components.
  virtual HostField beams() const { return {6, {}}; }
};

}  // namespace railwave
