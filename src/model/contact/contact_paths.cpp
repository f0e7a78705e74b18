#include "model/checks/doubts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "kernels/contact/contact_ends.hpp"
#include "mesh/vectors.hpp"
#include "model/assembled_scene.hpp"
#include "model/checks/round_part.hpp"
#include "model/contact/rolling.hpp"
#include "model/contact/surface_ends.hpp"
#include "model/loads/load_model.hpp"

namespace railwave {
namespace {

constexpr double elements_ahead = 3;  ///< of a patch's middle
constexpr double least_way = 0.25;    ///< of a facet's side: less is no way
constexpr int most_steps = 20000;
constexpr double near_share = 1e-3;  ///< of the radius: as near as the nearest place of a round part

Vec3 turned(const Vec3& x, const Vec3& axis, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  return sum(sum(scaled(c, x), scaled(s, cross(axis, x))), scaled((1 - c) * dot(axis, x), axis));
}

/// How a part goes on as a rigid body.
class BodyWay {
 public:
  /// @param place on the axis of a round part, else at the contact
  BodyWay(const AssembledScene& assembled, const std::string& part, const Vec3& place)
      : assembled_(assembled), centre_(place) {
    velocity_ = initial_velocity(assembled, part, place);
    for (int i = 0; i < 3; ++i) {
      Vec3 unit{0, 0, 0};
      unit[i] = 1;
      spin_ = sum(spin_,
                  scaled(0.5, cross(unit, difference(initial_velocity(assembled, part, sum(place, unit)), velocity_))));
    }
    for (const scene::PrescribedMotion& motion : assembled.scene.prescribed_motions)
      if (part_of_name(motion.target) == part) drive(motion, place);
  }

  /// m, of the centre
  Vec3 travel(double time) const {
    Vec3 way = scaled(time, velocity_);
    for (const Driven& driven : driven_) {
      const scene::PrescribedMotion& motion = *driven.motion;
      const Vec3 wanted = sum(scaled(curve_integral(curve_of(assembled_.scene, motion.curve), time), driven.velocity),
                              scaled(motion.displacement_curve.empty()
                                         ? 0
                                         : curve_value(curve_of(assembled_.scene, motion.displacement_curve), time),
                                     motion.displacement));
      for (int a = 0; a < 3; ++a)
        if (motion.directions[a]) way = sum(way, scaled(dot(difference(wanted, way), motion.axes[a]), motion.axes[a]));
    }
    return way;
  }

  /// Where the material that is at `x` then was when the run began, m.
  Vec3 material(const Vec3& x, double time) const {
    const Vec3 arm = difference(difference(x, centre_), travel(time));
    const double speed = length(spin_),
                 angle = speed * (spin_curve_ != nullptr ? curve_integral(spin_curve_, time) : time);
    return sum(centre_, speed > 0 ? turned(arm, scaled(1 / speed, spin_), -angle) : arm);
  }

 private:
  struct Driven {
    const scene::PrescribedMotion* motion;
    Vec3 velocity;  ///< m/s, of the centre, where the motion's curve is 1
  };

  void drive(const scene::PrescribedMotion& motion, const Vec3& place) {
    const auto& nodes = find_node_set(assembled_.scene, assembled_.assembly, motion, "target", motion.target);
    const Vec3 own = centre_of_rotation(assembled_, motion, nodes);
    driven_.push_back({&motion, sum(motion.velocity, cross(motion.angular_velocity, difference(place, own)))});
    if (length(motion.angular_velocity) > 0) {
      spin_ = motion.angular_velocity;
      spin_curve_ = curve_of(assembled_.scene, motion.curve);
    }
  }

  const AssembledScene& assembled_;
  Vec3 centre_, velocity_{0, 0, 0}, spin_{0, 0, 0};
  std::vector<Driven> driven_;
  const scene::Curve* spin_curve_ = nullptr;
};

/// Facets and places as WayOverFacets wants them.
struct FacetRows {
  const std::vector<std::array<int, 4>>& rows;
  int operator()(int facet, int k) const { return rows[facet][k]; }
};
struct Places {
  const std::vector<Vec3>& nodes;
  double operator()(int n, int i) const { return nodes[n][i]; }
};
using Way = WayOverFacets<FacetRows, Places>;

Way way_over(const Assembly& assembly, const SurfaceEnds& ends) {
  return {{ends.corners}, {ends.beyond}, {assembly.nodes}};
}

Vector3 as_vector(const Vec3& x) { return {{x[0], x[1], x[2]}}; }

Vec3 middle_of(const Assembly& assembly, const std::array<int, 4>& corners) {
  Vec3 middle{0, 0, 0};
  for (int n : corners) middle = sum(middle, scaled(0.25, assembly.nodes[n]));
  return middle;
}

int nearest_facet(const Assembly& assembly, const SurfaceEnds& ends, const Vec3& place) {
  int nearest = 0;
  double least = 1e300;
  for (std::size_t f = 0; f < ends.corners.size(); ++f) {
    const double distance = length(difference(middle_of(assembly, ends.corners[f]), place));
    if (distance >= least) continue;
    least = distance;
    nearest = static_cast<int>(f);
  }
  return nearest;
}

double side_of(const Assembly& assembly, const std::array<int, 4>& corners) {
  const auto& x = assembly.nodes;
  return std::min(length(difference(x[corners[1]], x[corners[0]])), length(difference(x[corners[2]], x[corners[1]])));
}

/// Where a way over a surface meets something.
struct Met {
  double time = 0;      ///< s
  Vec3 place{0, 0, 0};  ///< m, undeformed
  bool end = false;     ///< else the fine zone
  Beyond beyond = Beyond::goes_on;
};

/// Follows a place over one surface, from where the run begins.
/// @param place place(t): the patch's or node's place among the surface's undeformed nodes
/// @param ahead how many elements beyond it count
/// @return the end of the fine zone, if it passes that, and of the surface
template <class Place>
std::vector<Met> follow(const AssembledScene& assembled, const SurfaceEnds& ends, const std::string& part, double ahead,
                        const Place& place) {
  const double end_time = assembled.scene.time.end, wanted = finest_wanted(assembled.scene, part);
  int facet = nearest_facet(assembled.assembly, ends, place(0)), side = -1;
  const Way way = way_over(assembled.assembly, ends);
  const double size = side_of(assembled.assembly, ends.corners[facet]);
  // It may begin beside the surface, as over the rail before: then what it comes to first is this facet.
  const int begin = facet;
  bool over = false, fine = false;
  const auto arrive = [&](const Vec3& x) {
    facet = begin;
    over = !way.leads_out(as_vector(x), least_way * size, facet, side) && side < 0;
    fine = over && wanted > 0 && longest_side(assembled.assembly.nodes, ends.corners[facet]) <= wanted;
  };
  arrive(place(0));
  double travelled = 0;
  constexpr int coarse_steps = 200;
  for (int i = 0; i < coarse_steps; ++i)
    travelled += length(difference(place(end_time * (i + 1) / coarse_steps), place(end_time * i / coarse_steps)));
  std::vector<Met> met;
  if (travelled < least_way * size) return met;
  const int steps = static_cast<int>(std::min<double>(most_steps, std::max<double>(coarse_steps, travelled / size)));
  for (int i = 0; i < steps; ++i) {
    const double before = end_time * i / steps, time = end_time * (i + 1) / steps;
    const Vec3 from = place(before), here = place(time), step = difference(here, from);
    const double moved = length(step);
    if (!(moved > 0)) continue;
    if (!over) arrive(here);
    if (!over) continue;
    if (way.leads_out(as_vector(here), least_way * side_of(assembled.assembly, ends.corners[facet]), facet, side)) {
      met.push_back({time, here, true, static_cast<Beyond>(ends.beyond[facet][side])});
      return met;
    }
    if (side >= 0) return met;  // over a gap, or too far to be followed
    const double own_size = side_of(assembled.assembly, ends.corners[facet]);
    const Vec3 foremost = sum(here, scaled(ahead * own_size / moved, step));
    int last = facet;
    if (ahead > 0 && way.leads_out(as_vector(foremost), least_way * own_size, last, side)) {
      met.push_back({time, foremost, true, static_cast<Beyond>(ends.beyond[last][side])});
      return met;
    }
    if (!fine || longest_side(assembled.assembly.nodes, ends.corners[last]) <= wanted) continue;
    met.push_back({time, foremost, false});
    fine = false;  // reported once
  }
  return met;
}

std::string describe(const scene::Scene& scene, const scene::Contact& contact, const std::string& surface,
                     const std::string& part, const Met& met) {
  const std::string head =
      fmt::format("[contacts.{}] (line {}): if its parts go on as initial and prescribed motions say, its patch ",
                  contact.name, contact.line);
  const std::string where =
      fmt::format("near ({:.4g}, {:.4g}, {:.4g}) m at t = {:.4g} s, and the run ends at {:.4g} s; ", met.place[0],
                  met.place[1], met.place[2], met.time, scene.time.end);
  if (!met.end)
    return head + fmt::format("leaves the fine zone of '{}' ", part) + where +
           fmt::format(
               "beyond it elements are longer than {:.3g} m: make the zone of its mesh reach farther, or end the run "
               "before",
               finest_wanted(scene, part));
  return head + fmt::format("comes to the end of '{}' ", surface) + where +
         (met.beyond == Beyond::set_ends
              ? fmt::format("the body goes on there, but contact beyond is not seen: name a surface that reaches "
                            "farther in contacts.{}, or end the run before",
                            contact.name)
              : std::string("the body ends there: make it longer, begin farther from its end, or end the run before"));
}

/// How far a surface reaches along a direction, m.
double extent(const Assembly& assembly, const std::vector<int>& nodes, const Vec3& along) {
  double low = 1e300, high = -1e300;
  for (int n : nodes) {
    const double at = dot(assembly.nodes[n], along);
    low = std::min(low, at);
    high = std::max(high, at);
  }
  return high - low;
}

class PairPath {
 public:
  PairPath(const AssembledScene& assembled, const std::vector<ContactPair>& contacts, const ContactPair& pair)
      : assembled_(assembled),
        contacts_(contacts),
        pair_(pair),
        contact_(*pair.contact),
        slave_(part_name(pair.slave_nodes)),
        master_(part_name(pair.master_nodes)) {}

  void report(std::vector<std::string>& doubts) {
    if (slave_.empty() || master_.empty() || slave_ == master_) return;
    if (!moves(slave_) && !moves(master_)) return;
    ends_ = pair_ends(assembled_.assembly, contacts_, pair_);
    for (const bool reversed : {false, true})
      if (const auto round = round_part(assembled_, reversed ? master_ : slave_)) {
        if (const auto place = where_it_rolls(*round)) return report_rolling(*round, reversed, *place, doubts);
        return;  // it hangs in the air
      }
    report_sliding(doubts);
  }

 private:
  std::string part_name(const std::vector<int>& nodes) const {
    const int part = nodes.empty() ? -1 : part_of_node(assembled_.assembly, nodes.front());
    return part < 0 ? "" : assembled_.assembly.parts[part].name;
  }

  bool moves(const std::string& part) const {
    const auto named = [&](const std::string& name) { return part_of_name(name) == part; };
    return std::any_of(
               assembled_.scene.initial_motions.begin(), assembled_.scene.initial_motions.end(),
               [&](const auto& motion) { return std::any_of(motion.parts.begin(), motion.parts.end(), named); }) ||
           std::any_of(assembled_.scene.prescribed_motions.begin(), assembled_.scene.prescribed_motions.end(),
                       [&](const auto& motion) { return named(motion.target); });
  }

  std::string surface(bool of_master) const {
    return of_master != pair_.reversed ? contact_.master.text() : contact_.slave;
  }

  /// Where the round part stands on the other; where it does not stand on that first of all, its nearest place on
  /// anything.
  std::optional<Vec3> where_it_rolls(const RoundPart& round) const {
    std::optional<Vec3> place, nearest;
    double least = 1e300, own = 1e300;
    for (const Touch& touch : touches(assembled_, round)) {
      if (touch.gap < least) {
        least = touch.gap;
        nearest = touch.place;
      }
      if (touch.contact->name != contact_.name || touch.gap >= own) continue;
      own = touch.gap;
      place = touch.place;
    }
    return own > least + near_share * round.nominal_radius ? nearest : place;
  }

  void report_rolling(const RoundPart& round, bool round_is_master, const Vec3& place,
                      std::vector<std::string>& doubts) const {
    // Abreast of the contact.
    const Vec3 on_axis = sum(round.origin, scaled(dot(difference(place, round.origin), round.axis), round.axis));
    const BodyWay carrier(assembled_, round.part->name, on_axis);
    const std::string& other = round_is_master ? slave_ : master_;
    const auto other_round = round_part(assembled_, other);
    const Vec3 other_place =
        other_round ? sum(other_round->origin,
                          scaled(dot(difference(place, other_round->origin), other_round->axis), other_round->axis))
                    : place;
    const BodyWay carried(assembled_, other, other_place);
    // Of both surfaces what comes first, end and zone apart.
    std::optional<Met> first[2];
    std::string line[2];
    for (const bool own : {false, true}) {
      const bool of_master = own == round_is_master;
      const BodyWay& body = own ? carrier : carried;
      const auto all = follow(assembled_, ends_[of_master], own ? round.part->name : other, elements_ahead,
                              [&](double time) { return body.material(sum(place, carrier.travel(time)), time); });
      for (const Met& met : all) {
        if (first[met.end] && first[met.end]->time <= met.time) continue;
        first[met.end] = met;
        line[met.end] = describe(assembled_.scene, contact_, surface(of_master), own ? round.part->name : other, met);
      }
    }
    for (const int end : {0, 1})
      if (first[end]) doubts.push_back(line[end]);
  }

  void report_sliding(std::vector<std::string>& doubts) const {
    const auto mean = [&](const std::vector<int>& nodes) {
      Vec3 middle{0, 0, 0};
      for (int n : nodes)
        middle = sum(middle, scaled(1.0 / static_cast<double>(nodes.size()), assembled_.assembly.nodes[n]));
      return middle;
    };
    const BodyWay ways[2] = {{assembled_, slave_, mean(pair_.slave_nodes)},
                             {assembled_, master_, mean(pair_.master_nodes)}};
    const double end = assembled_.scene.time.end;
    // By the way at the end: what goes forth and back is at its foremost at some other time, which its curve knows.
    Vec3 way{0, 0, 0};
    for (int i = 1; i <= 200; ++i) {
      const Vec3 now = difference(ways[0].travel(end * i / 200), ways[1].travel(end * i / 200));
      if (length(now) > length(way)) way = now;
    }
    if (!(length(way) > 0)) return;
    way = scaled(1 / length(way), way);
    const bool master_is_short =
        extent(assembled_.assembly, pair_.master_nodes, way) < extent(assembled_.assembly, pair_.slave_nodes, way);
    const auto& nodes = master_is_short ? pair_.master_nodes : pair_.slave_nodes;
    const SurfaceEnds& ends = ends_[!master_is_short];
    const BodyWay &carrier = ways[master_is_short], &under = ways[!master_is_short];
    const Vec3 forward = master_is_short ? scaled(-1, way) : way;
    // The foremost of the nodes that lie over the other surface.
    const Way over = way_over(assembled_.assembly, ends);
    int foremost = -1;
    const int start = nearest_facet(assembled_.assembly, ends, mean(nodes));
    for (int n : nodes) {
      const Vec3& x = assembled_.assembly.nodes[n];
      if (foremost >= 0 && dot(x, forward) <= dot(assembled_.assembly.nodes[foremost], forward)) continue;
      int facet = start, side = -1;
      bool out = false;
      for (int leap = 0; leap < 1000; ++leap) {
        out = over.leads_out(as_vector(x), least_way * side_of(assembled_.assembly, ends.corners[facet]), facet, side);
        if (out || side < 0 || ends.beyond[facet][side] < 0) break;
      }
      if (!out) foremost = n;
    }
    if (foremost < 0) return;
    const Vec3 from = assembled_.assembly.nodes[foremost];
    const bool over_master = !master_is_short;
    for (const Met& met : follow(assembled_, ends, over_master ? master_ : slave_, 0,
                                 [&](double time) { return under.material(sum(from, carrier.travel(time)), time); }))
      doubts.push_back(describe(assembled_.scene, contact_, surface(over_master), over_master ? master_ : slave_, met));
  }

  const AssembledScene& assembled_;
  const std::vector<ContactPair>& contacts_;
  const ContactPair& pair_;
  const scene::Contact& contact_;
  std::string slave_, master_;
  std::array<SurfaceEnds, 2> ends_;
};

}  // namespace

std::vector<std::string> path_doubts(const AssembledScene& assembled, const std::vector<ContactPair>& contacts) {
  std::vector<std::string> doubts;
  for (const ContactPair& pair : contacts)
    if (!pair.reversed) PairPath(assembled, contacts, pair).report(doubts);
  return doubts;
}

}  // namespace railwave
