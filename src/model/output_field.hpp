#pragma once

#include "case/field_table.hpp"
#include "model/fields.hpp"

namespace railwave {

/// A field of the table at the present instant, of the nodes or elements listed (model numbers), in their order. Throws
/// std::logic_error for a row that has no fetch function: rows that serve `fields` all have one.
HostField output_field(const Model& model, const FieldRow& row, const std::vector<int>& numbers);

}  // namespace railwave
