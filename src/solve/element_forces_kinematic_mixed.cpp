#include "solve/element_forces_of.hpp"

namespace railwave {

template void forces_of_material<float, NodeAdvance>(const Model&, const ElementGroup&, const Instant&,
                                                     const ElementLaunch&, const KinematicBilinear&);

}  // namespace railwave
