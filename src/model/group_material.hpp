#pragma once

#include "model/model.hpp"

namespace railwave {

/// Calls `work(material)` with the material of a group's elements, in the type that their kernels are made for.
template <class Work>
void with_material(const ElementGroup& group, const Work& work) {
  if (group.plastic.active()) work(Bilinear{group.plastic.constants, group.plastic.history});
  else work(Elastic{group.constants});
}

}  // namespace railwave
