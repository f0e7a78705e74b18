#include "post/facet_stress.hpp"

namespace railwave {

FacetStress facet_stress(const ContactSide& side, int facet, const std::vector<double>& pressure) {
  FacetStress stress;
  for (const int corner : side.facets[facet]) {
    if (!(pressure[corner] > 0)) continue;
    stress.pressure += 0.25 * pressure[corner];
    stress.shear += 0.25 / side.area[corner] * entry(side.tangential_force, corner);
  }
  return stress;
}

double facet_area(const ContactSide& side, int facet) {
  const auto& c = side.facets[facet];
  const Vector one = entry(side.position, c[2]) - entry(side.position, c[0]);
  const Vector other = entry(side.position, c[3]) - entry(side.position, c[1]);
  return 0.5 * one.cross(other).norm();
}

}  // namespace railwave
