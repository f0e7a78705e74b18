#include "case/rules.hpp"

namespace railwave::case_file {

namespace {

template <class Set>
void check_place(const Set& set, EntryCheck& check) {
  if (!check.sound({"box", "position"})) return;
  if (set.box && set.position) check.complain("position", "has no effect beside box; leave one of them out");
  if (!set.box && !set.position)
    check.complain(
        "box", "is missing; must be a box [[x, y, z], [x, y, z]], lowest corner first in m, unless position is given");
  if (set.box && check.given("radius")) check.complain("radius", "belongs to position; leave it out of a set by box");
}

}  // namespace

void check_node_set(void* entry, EntryCheck& check) { check_place(*static_cast<scene::NodeSet*>(entry), check); }
void check_element_set(void* entry, EntryCheck& check) { check_place(*static_cast<scene::ElementSet*>(entry), check); }

void check_hammer(void* entry, EntryCheck& check) {
  const auto& hammer = *static_cast<scene::Hammer*>(entry);
  const bool measured = check.given("curve");
  if (!measured && check.sound({"duration"}) && !(hammer.duration > 0))
    check.complain("duration", "is missing; must be a number in s, above 0, unless curve is given");
  for (const char* key : {"duration", "start"})
    if (measured && check.given(key))
      check.complain(key, "has no effect beside curve, which has its own times; leave one of them out");
}

void check_probe(void* entry, EntryCheck& check) {
  const auto& probe = *static_cast<scene::Probe*>(entry);
  if (probe.quantities.empty() && check.sound({"quantities"}))
    check.complain("quantities",
                   "is empty, so nothing would be recorded; name for instance [\"stress\"], or leave it out");
  if (!check.sound({"count", "spacing"})) return;
  const bool no_spacing = probe.spacing == scene::Vec3{0, 0, 0};
  if (probe.count > 1 && no_spacing)
    check.complain(
        "spacing",
        "is missing or [0, 0, 0], so that all of the row would be at one place; give for instance [0.6, 0, 0]");
  if (probe.count == 1 && !no_spacing)
    check.complain("spacing", "has no effect on one probe; give count, or leave spacing out");
}

}  // namespace railwave::case_file
