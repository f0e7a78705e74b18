#include "solve/tasks/element_forces.hpp"

#include "model/elements/materials.hpp"

namespace railwave {

template <class S, class Nodes>
void element_forces(const Model& model, const ElementGroup& group, const Instant& instant,
                    const ElementLaunch& launch) {
  with_material_type(group.material, [&](auto type) {
    element_forces_of<S, Nodes, typename decltype(type)::type>(model, group, instant, launch);
  });
}

template void element_forces<double, NodeAdvance>(const Model&, const ElementGroup&, const Instant&,
                                                  const ElementLaunch&);
template void element_forces<float, NodeAdvance>(const Model&, const ElementGroup&, const Instant&,
                                                 const ElementLaunch&);
template void element_forces<float, CarriedAdvance>(const Model&, const ElementGroup&, const Instant&,
                                                    const ElementLaunch&);

}  // namespace railwave
