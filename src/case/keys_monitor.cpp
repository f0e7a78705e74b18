#include "case/keys.hpp"

// What a run is monitored for.
namespace railwave::case_file {

Section monitor_section() {
  using scene::Monitor;
  auto section = single_section("monitor", &scene::Scene::monitor,
                                "What a run is monitored for, some 64 times and at its beginning more often. Beyond a "
                                "limit it warns, once for each kind, and tells "
                                "where, when and the likely cause; beyond a fatal one it stops, writes its last state, "
                                "and the culprit's surroundings beside the "
                                "results as NAME.fault.h5 and .xdmf. docs/monitor.md tells more.");
  section.former_name = "watch";
  section.keys = {
      key("active", &Monitor::active,
          "`false` leaves all of it out; a run whose solution is no longer finite stops even so"),
      key("energy_error", &Monitor::energy_error,
          "error of the energy balance, over what deformation, contacts and connectors have held and dissipated so "
          "far; rigid travel does not count")
          .within(above(0)),
      key("fatal_energy_error", &Monitor::fatal_energy_error,
          "the same, a gain or a loss, at which the run stops: a run that completes has an account below this")
          .within(above(0)),
      key("kinetic_growth", &Monitor::kinetic_growth,
          "kinetic energy beyond what the run was given, over what deformation has held and dissipated so far")
          .within(above(0)),
      key("hourglass_share", &Monitor::hourglass_share,
          "hourglass energy of a part, stored or dissipated within a millisecond, over that of its deformation")
          .within(above(0)),
      key("hourglass_distortion", &Monitor::hourglass_distortion,
          "how far an hourglass mode moves an element's corners, over its size")
          .within(above(0)),
      key("penetration", &Monitor::penetration, "of a contact node, over the size of the face under it")
          .within(above(0)),
      key("volume_ratio", &Monitor::volume_ratio,
          "smallest Jacobian of an element over that of the undeformed one; the run stops at 0")
          .within(inside(0, 1)),
      key("speed", &Monitor::speed, "of a node").in("m/s").within(above(0)).unlimited(),
      key("fatal_speed", &Monitor::fatal_speed, "of a node, at which the run stops")
          .in("m/s")
          .within(above(0))
          .unlimited(),
      key("contact_edge", &Monitor::contact_edge,
          "normal force of a contact node at the end of its surface, beyond which the other body goes on, over the "
          "contact's largest")
          .within(above(0)),
      key("fine_zone", &Monitor::fine_zone,
          "normal force of a contact node outside the fine zone of a wheel, rail, roller or crowned block, over the "
          "contact's largest")
          .within(above(0)),
      key("chatter", &Monitor::chatter, "times that a contact node was seen to open and to close again")
          .within(at_least(1)),
      key("box", &Monitor::box,
          "half the edge of the box about a fatal fault that is written; 0 is six times the element's size")
          .in("m")
          .within(at_least(0)),
  };
  return section;
}

}  // namespace railwave::case_file
