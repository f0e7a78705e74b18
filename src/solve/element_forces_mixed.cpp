#include "solve/element_forces_of.hpp"

namespace railwave {

template void element_forces<float, NodeAdvance>(const Model&, const ElementGroup&, const Instant&,
                                                 const ElementLaunch&);

}  // namespace railwave
