#include "solve/element_forces_of.hpp"

namespace railwave {

template void element_forces<double, NodeAdvance>(const Model&, const ElementGroup&, const Instant&,
                                                  const ElementLaunch&);

}  // namespace railwave
