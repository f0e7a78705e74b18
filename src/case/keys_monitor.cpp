#include "case/keys.hpp"

// Checks of the running solution and their limits.
namespace railwave::case_file {

Section monitor_section() {
  using scene::Monitor;
  auto section = single_section(
      "monitor", &scene::Scene::monitor,
      "Checks of the solution while it runs: some 64 in a run, more often at its beginning. A value beyond its limit "
      "brings a warning, once for each kind, with place, time and likely cause. A value beyond a fatal limit stops "
      "the run, which then writes its last state and, beside the results, the elements around the fault as "
      "NAME.fault.h5 and .xdmf. See docs/monitor.md.");
  section.former_name = "watch";
  section.keys = {
      key("active", &Monitor::active,
          "`false` leaves all of it out; a run whose solution is no longer finite stops even so"),
      key("energy_error", &Monitor::energy_error,
          "error of the energy balance, over what deformation, contacts and connectors have held and dissipated so "
          "far; rigid travel does not count")
          .within(above(0)),
      key("fatal_energy_error", &Monitor::fatal_energy_error,
          "the same, a gain or a loss, at which the run stops: a run that completes has stayed below it")
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
          "half the edge of the box around a fatal fault whose elements are written; 0 is six times the element's "
          "size")
          .in("m")
          .within(at_least(0)),
  };
  return section;
}

}  // namespace railwave::case_file
