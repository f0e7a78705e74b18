#include "solve/monitor/fault.hpp"

#include <fmt/format.h>

namespace railwave {

const char* name_of(FaultKind kind) {
  switch (kind) {
    case FaultKind::not_finite:
      return "the solution is no longer finite";
    case FaultKind::inversion:
      return "an element is squeezed or inverted: its smallest Jacobian over the undeformed one";
    case FaultKind::energy:
      return "energy balance: its error over what deformation has held and dissipated";
    case FaultKind::speed:
      return "speed of a node, m/s";
    case FaultKind::kinetic:
      return "kinetic energy without work: what is beyond the energy that the run was given, over what deformation has "
             "held and dissipated";
    case FaultKind::hourglass_share:
      return "hourglass energy of a part, stored or dissipated within a millisecond, over that of its deformation";
    case FaultKind::hourglass_distortion:
      return "hourglass mode of an element over its size";
    case FaultKind::penetration:
      return "contact penetration over the size of the face under it";
    case FaultKind::chatter:
      return "contact chatter: times that a node was seen to open and to close";
    case FaultKind::material:
      return "wave speed of a material, m/s";
    case FaultKind::yield:
      return "yield stress of a material over its Young's modulus";
    case FaultKind::size:
      return "mean size of a part's elements, m";
    case FaultKind::contact_edge:
      return "a contact's patch is at the end of its surface: largest nodal force there over the contact's largest";
    case FaultKind::contact_zone:
      return "a contact's patch is outside the fine mesh: largest nodal force there over the contact's largest";
    case FaultKind::contact_lost:
      return "a closed contact has lost all its nodes over the end of its surface";
    case FaultKind::shape:
      return "an element badly shaped before anything moves: its smallest Jacobian at a corner over the mean";
  }
  return "";
}

const char* key_of(FaultKind kind) {
  switch (kind) {
    case FaultKind::inversion:
      return "volume_ratio";
    case FaultKind::energy:
      return "energy_error";
    case FaultKind::speed:
      return "speed";
    case FaultKind::kinetic:
      return "kinetic_growth";
    case FaultKind::hourglass_share:
      return "hourglass_share";
    case FaultKind::hourglass_distortion:
      return "hourglass_distortion";
    case FaultKind::penetration:
      return "penetration";
    case FaultKind::chatter:
      return "chatter";
    case FaultKind::contact_edge:
      return "contact_edge";
    case FaultKind::contact_zone:
      return "fine_zone";
    case FaultKind::contact_lost:
    case FaultKind::not_finite:
    case FaultKind::material:
    case FaultKind::yield:
    case FaultKind::size:
    case FaultKind::shape:
      break;
  }
  return nullptr;
}

std::string Fault::summary() const {
  std::string text = name_of(kind);
  if (kind != FaultKind::not_finite && kind != FaultKind::contact_lost)
    text += fmt::format(": {:.4g}, limit {:.4g}", value, limit);
  text += fmt::format("; at t = {:.6g} s, step {}", time, step);
  if (!contact.empty()) text += fmt::format(", contact {}", contact);
  if (!part.empty()) text += fmt::format(", part {}", part);
  if (element_in_part >= 0) text += fmt::format(", element {}", element_in_part);
  if (element >= 0 || node >= 0) text += fmt::format(" near ({:.4g}, {:.4g}, {:.4g}) m", place[0], place[1], place[2]);
  if (!causes.empty()) text += "; likely cause: " + causes[0].text;
  if (causes.size() > 1) text += "; or else: " + causes[1].text;
  return text;
}

}  // namespace railwave
