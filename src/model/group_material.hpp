#pragma once

#include "model/model.hpp"

namespace railwave {

/// Calls `work(material)` with the material of a group's elements, in the type that their kernels are made for.
template <class Work>
void with_material(const ElementGroup& group, const Work& work) {
  const PlasticArrays& plastic = group.plastic;
  if (plastic.kinematic())
    work(KinematicBilinear{{plastic.constants, plastic.history}, plastic.isotropic_share, plastic.back_stress});
  else if (plastic.active())
    work(Bilinear{plastic.constants, plastic.history});
  else
    work(Elastic{group.constants});
}

}  // namespace railwave
