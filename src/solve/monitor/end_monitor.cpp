#include "solve/monitor/end_monitor.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "mesh/vectors.hpp"
#include "model/host_copy.hpp"

namespace railwave {
namespace {

constexpr double opposite = -0.5;         ///< cosine between the directions of two ends that lie opposite
constexpr double nearly_touching = 0.05;  ///< gap over the largest segment's diagonal
constexpr double slid = 0.25;             ///< of the distance of two slave nodes
constexpr double most_of = 0.5;           ///< of the nodes that touched last: so many beyond the end have fallen off it
constexpr double moved_out = 0.5;         ///< of the largest segment's diagonal

/// Slaves around each slave over its facets.
void link_slaves(const ContactPair& pair, std::vector<int>& first, std::vector<int>& around) {
  std::vector<std::vector<int>> linked(pair.slave_nodes.size());
  for (const auto& facet : pair.slave_facets)
    for (int a : facet)
      for (int b : facet)
        if (a != b && std::find(linked[a].begin(), linked[a].end(), b) == linked[a].end()) linked[a].push_back(b);
  first.assign(1, 0);
  for (const auto& list : linked) {
    around.insert(around.end(), list.begin(), list.end());
    first.push_back(static_cast<int>(around.size()));
  }
}

Vec3 mean_place(const std::vector<Vec3>& nodes, const Assembly::PartRange& part) {
  Vec3 sum{0, 0, 0};
  for (int n = part.first_node; n < part.first_node + part.node_count; ++n)
    for (int i = 0; i < 3; ++i) sum[i] += nodes[n][i] / part.node_count;
  return sum;
}

const char* direction_name(const Vec3& out) {
  int axis = 0;
  for (int i : {1, 2})
    if (std::fabs(out[i]) > std::fabs(out[axis])) axis = i;
  static const char* const names[2][3] = {{"-x", "-y", "-z"}, {"+x", "+y", "+z"}};
  return names[out[axis] > 0][axis];
}

/// Of several facets, mostly of one part: whether each is outside its part's fine zone.
std::vector<int> coarse(const AssembledScene& assembled, const std::vector<std::array<int, 4>>& facets) {
  std::vector<int> result;
  int known = -1;
  double wanted = 0;
  for (const auto& facet : facets) {
    const int part = part_of_node(assembled.assembly, facet[0]);
    if (part != known) wanted = part < 0 ? 0 : finest_wanted(assembled.scene, assembled.assembly.parts[part].name);
    known = part;
    result.push_back(wanted > 0 && longest_side(assembled.assembly.nodes, facet) > wanted);
  }
  return result;
}

}  // namespace

EndMonitor::EndMonitor(const AssembledScene& assembled, const NodalState& nodal,
                       const std::vector<ContactPair>& contacts, SampledRanks* others)
    : assembled_(assembled),
      nodal_(nodal),
      contacts_(contacts),
      others_(others),
      sightings_(assembled.scene.contacts.size()),
      ever_closed_(assembled.scene.contacts.size(), 0) {
  const Assembly& assembly = assembled.assembly;
  for (const ContactPair& pair : contacts) {
    Pair made;
    made.ends = pair_ends(assembly, contacts, pair);
    const SurfaceEnds &slave = made.ends[0], &master = made.ends[1];
    const std::vector<int> coarse_facet = coarse(assembled, master.corners),
                           coarse_slave = coarse(assembled, slave.corners);
    std::vector<int> kind(pair.slave_nodes.size(), 0), fine(pair.slave_nodes.size(), 0), first, around;
    for (std::size_t f = 0; f < slave.corners.size(); ++f)
      for (int k = 0; k < 4; ++k) {
        const auto& corner = pair.slave_facets[f];
        if (slave.beyond[f][k] == static_cast<int>(Beyond::set_ends))
          kind[corner[k]] |= 1, kind[corner[(k + 1) % 4]] |= 1;
        if (coarse_slave[f] == 0) fine[corner[k]] = 1;
      }
    for (std::size_t s = 0; s < kind.size(); ++s)
      if (fine[s] == 0) kind[s] |= 2;
    link_slaves(pair, first, around);
    made.arrays = {to_device("facets' corners", master.corners),
                   to_device("beyond facets", master.beyond),
                   to_device("coarse facets", coarse_facet),
                   to_device("kinds of slaves", kind),
                   to_device("first around slaves", first),
                   to_device("around slaves", around),
                   Array<int*>("touched at checks", pair.slave_nodes.size())};
    made.part = {part_of_node(assembly, pair.slave_nodes.front()), part_of_node(assembly, pair.master_nodes.front())};
    if (made.part[0] >= 0 && made.part[1] >= 0) {
      const Vec3 way = difference(mean_place(assembly.nodes, assembly.parts[made.part[0]]),
                                  mean_place(assembly.nodes, assembly.parts[made.part[1]]));
      std::copy(way.begin(), way.end(), made.way_start);
    }
    pairs_.push_back(std::move(made));
  }
}

/// A touching slave from which the way to one beside it leads over an end of the master.
struct EndMonitor::Crossing {
  int slave, facet, side;
  double force;   ///< N; 0 where the other lies hardly beyond the end
  Vec3 out;       ///< unit
  bool slid_out;  ///< the slave has moved that way over the master
};

void EndMonitor::ask(const ExecutionSpace& order) {
  question_.ask(order, [this](Reductions& reductions, auto& found) {
    found.resize(pairs_.size());
    for (std::size_t p = 0; p < pairs_.size(); ++p)
      reductions.largest(ContactEndForces{contacts_[p].arrays, pairs_[p].arrays, nodal_.nodes.position},
                         contacts_[p].arrays.slave_count, [&found, p](const auto& of) { found[p] = of; });
  });
}

void EndMonitor::check(bool thorough) {
  if (!question_.asked()) ask(ExecutionSpace());
  const auto found = question_.answer();
  for (EndSighting& one : sightings_) one = {};
  for (std::size_t p = 0; p < pairs_.size(); ++p) {
    const ContactPair& pair = contacts_[p];
    Memory& memory = pairs_[p].memory;
    EndSighting& now = pairs_[p].now;
    const bool was_closed = memory.closed != 0;
    const auto& largest = found[p].value;
    now = {};
    now.closed = largest[0] > 0;
    if (now.closed) {
      const double force = std::max(largest[0], 1e-290);
      now.outside_zone = largest[2] / force;
      if (now.outside_zone > assembled_.scene.monitor.fine_zone) place_outside_zone(p, found[p].place[2]);
      const double share = largest[1] / force;
      if (thorough) memory.harmless = 0;
      if (share > assembled_.scene.monitor.contact_edge && memory.harmless == 0)
        judge(p);
      else if (share <= assembled_.scene.monitor.contact_edge)
        memory.ever_clear = 1;
      if (share <= assembled_.scene.monitor.contact_edge || memory.harmless != 0) memory.at_end = 0;
      if (memory.at_end != 0) {
        now.at_end = share;
        now.end_node = memory.end_node;
        now.end = describe_end(pair, memory);
      }
      memory.lost = 0;
    } else if (was_closed) {
      double sum[ContactEndLosses::values] = {};
      block_sum(ContactEndLosses{pair.arrays, pairs_[p].arrays, nodal_.nodes.position}, pair.arrays.slave_count, sum,
                *nodal_.reduction_space);
      const bool fell = sum[0] > 0 && sum[1] >= most_of * sum[0];
      memory.lost = fell || (memory.at_end != 0 && (memory.ever_clear != 0 || has_moved_out(p)));
    }
    if (memory.lost != 0) {
      now.lost = true;
      now.end_node = memory.end_node;
      now.end = describe_end(pair, memory);
    }
    memory.closed = now.closed;
    memory.ever_closed |= memory.closed;
  }
  for (std::size_t c = 0; c < sightings_.size(); ++c) {
    const std::string& name = assembled_.scene.contacts[c].name;
    EndSighting& one = sightings_[c];
    bool lost = false;
    for (std::size_t p = 0; p < pairs_.size(); ++p) {
      if (contacts_[p].contact->name != name) continue;
      const EndSighting& half = pairs_[p].now;
      one.closed = one.closed || half.closed;
      lost = lost || half.lost;
      if (half.at_end > one.at_end || (half.lost && one.end_node < 0)) {
        one.at_end = half.at_end;
        one.end_node = half.end_node;
        one.end = half.end;
      }
      if (half.outside_zone > one.outside_zone) {
        one.outside_zone = half.outside_zone;
        one.zone_node = half.zone_node;
        one.zone = half.zone;
      }
    }
    one.lost = lost && !one.closed;
    ever_closed_[c] = ever_closed_[c] != 0 || one.closed;
  }
}

void EndMonitor::judge(std::size_t number) {
  const ContactPair& pair = contacts_[number];
  Pair& own = pairs_[number];
  const auto position = to_host(nodal_.nodes.position);
  const auto status = to_host(pair.arrays.status);
  const auto tracked = to_host(pair.arrays.tracked);
  const auto force = to_host(pair.arrays.normal_force);
  const auto first = to_host(own.arrays.first_around), around = to_host(own.arrays.around),
             kind = to_host(own.arrays.slave_kind);
  using Rows = Array<int* [4]>::HostMirror;
  const Rows corners = to_host(own.arrays.corners), beyond = to_host(own.arrays.beyond);
  const WayOverFacets<Rows, decltype(position)> way{corners, beyond, position};
  const auto place = [&](int n) { return Vec3{position(n, 0), position(n, 1), position(n, 2)}; };
  const auto& x = assembled_.assembly.nodes;
  const auto shift = [&](int n) { return difference(place(n), x[n]); };

  std::vector<Crossing> crossings;
  double largest = 0;
  int set_node = -1;
  for (int s = 0; s < pair.arrays.slave_count; ++s) {
    if (status(s) == status_apart || tracked(s) < 0) continue;
    const double own_force = length({force(s, 0), force(s, 1), force(s, 2)});
    largest = std::max(largest, own_force);
  }
  const double least = assembled_.scene.monitor.contact_edge * largest;
  double most_of_set = 0;
  const auto gap = to_host(pair.arrays.gap);
  // Faces that lie on each other need not press everywhere: one that slides may tilt a little.
  const auto lies_on = [&](int s) {
    return tracked(s) >= 0 && (status(s) != status_apart || gap(s) < nearly_touching * pair.segment_size);
  };
  for (int s = 0; s < pair.arrays.slave_count; ++s) {
    if (!lies_on(s)) continue;
    const double own_force = status(s) == status_apart ? 0 : length({force(s, 0), force(s, 1), force(s, 2)});
    if ((kind(s) & 1) != 0 && own_force > std::max(least, most_of_set)) {
      most_of_set = own_force;
      set_node = s;
    }
    const Vec3 here = place(pair.slave_nodes[s]);
    for (int a = first(s); a < first(s + 1); ++a) {
      const Vec3 there = place(pair.slave_nodes[around(a)]);
      const double distance = length(difference(there, here));
      const Vector3 beside{{there[0], there[1], there[2]}};
      int facet = tracked(s), side = -1, last = facet, last_side = -1;
      if (!way.leads_out(beside, 0, facet, side)) continue;
      const bool flush = !way.leads_out(beside, ContactEndForces::flush * distance, last, last_side);
      const Vec3 out = outward(x, own.ends[1].corners[facet], side);
      const bool moved =
          dot(difference(shift(pair.slave_nodes[s]), shift(own.ends[1].corners[facet][side])), out) > slid * distance;
      crossings.push_back({s, facet, side, flush ? 0 : own_force, out, moved});
    }
  }
  // Directions in which the slave's own body ends on the master.
  std::vector<Vec3> own_ends;
  for (std::size_t f = 0; f < own.ends[0].corners.size(); ++f)
    for (int k = 0; k < 4; ++k) {
      if (own.ends[0].beyond[f][k] != static_cast<int>(Beyond::body_ends)) continue;
      const auto& corner = pair.slave_facets[f];
      for (int s : {corner[k], corner[(k + 1) % 4]})
        if (lies_on(s)) own_ends.push_back(outward(x, own.ends[0].corners[f], k));
    }

  Memory& memory = own.memory;
  const Crossing* worst = nullptr;
  for (const Crossing& one : crossings) {
    if (!(one.force > least)) continue;
    const bool of_set = own.ends[1].beyond[one.facet][one.side] == static_cast<int>(Beyond::set_ends);
    const auto across = [&](const Vec3& out) { return dot(out, one.out) < opposite; };
    if (!of_set &&
        std::any_of(crossings.begin(), crossings.end(), [&](const Crossing& other) { return across(other.out); }))
      continue;
    if (!of_set && !one.slid_out && std::any_of(own_ends.begin(), own_ends.end(), across)) continue;
    if (worst == nullptr || one.force > worst->force) worst = &one;
  }
  if (worst == nullptr && set_node < 0) {
    memory.harmless = 1;
    return;
  }
  memory.at_end = 1;
  if (worst == nullptr || most_of_set > worst->force) {
    memory.end_node = pair.slave_nodes[set_node];
    memory.facet = memory.side = -1;
    memory.of_set = 1;
    std::fill(memory.out, memory.out + 3, 0.0);
    return;
  }
  memory.facet = worst->facet;
  memory.side = worst->side;
  memory.of_set = own.ends[1].beyond[worst->facet][worst->side] == static_cast<int>(Beyond::set_ends);
  memory.end_node = own.ends[1].corners[worst->facet][worst->side];
  std::copy(worst->out.begin(), worst->out.end(), memory.out);
}

bool EndMonitor::may_ask_for_places() const {
  return std::any_of(pairs_.begin(), pairs_.end(), [](const Pair& pair) {
    return pair.memory.closed != 0 && pair.memory.at_end != 0 && pair.memory.ever_clear == 0;
  });
}

bool EndMonitor::has_moved_out(std::size_t number) const {
  const Pair& pair = pairs_[number];
  if (pair.part[0] < 0 || pair.part[1] < 0) return false;
  if (others_ != nullptr) others_->gather();
  double mean[2][3] = {};
  for (const int i : {0, 1}) {
    const auto& part = assembled_.assembly.parts[pair.part[i]];
    block_sum(PositionSum{nodal_.nodes.position, part.first_node}, part.node_count, mean[i], *nodal_.reduction_space);
    for (double& c : mean[i]) c /= part.node_count;
  }
  double way = 0;
  for (int i = 0; i < 3; ++i) way += (mean[0][i] - mean[1][i] - pair.way_start[i]) * pair.memory.out[i];
  return way > moved_out * contacts_[number].segment_size;
}

/// The place is the master's where its facet is coarse, else the slave's.
void EndMonitor::place_outside_zone(std::size_t number, int slave) {
  const ContactPair& pair = contacts_[number];
  Pair& own = pairs_[number];
  const auto& facet = own.ends[1].corners[to_host(pair.arrays.tracked)(slave)];
  const bool of_master = coarse(assembled_, {facet})[0] != 0;
  own.now.zone_node = of_master ? facet[0] : pair.slave_nodes[slave];
  const int part = part_of_node(assembled_.assembly, own.now.zone_node);
  const std::string& name = assembled_.assembly.parts[part].name;
  own.now.zone = fmt::format(
      "contact {} is outside the fine zone of part {}, where elements are longer than {:.3g} m; make the zone reach "
      "farther, let the contact begin elsewhere, or end the run "
      "(time.end) before",
      pair.contact->name, name, finest_wanted(assembled_.scene, name));
}

std::string EndMonitor::describe_end(const ContactPair& pair, const Memory& memory) const {
  const scene::Contact& contact = *pair.contact;
  const std::string masters = contact.master.text(), &slave = pair.reversed ? masters : contact.slave,
                    &master = pair.reversed ? contact.slave : masters;
  const bool at_slave = memory.facet < 0;
  const std::string& surface = at_slave ? slave : master;
  const std::string where =
      at_slave ? std::string()
               : fmt::format(" towards {}", direction_name({memory.out[0], memory.out[1], memory.out[2]}));
  const std::string mend = memory.of_set != 0
                               ? fmt::format(
                                     "the body goes on there but the surface does not, so that contact beyond it is "
                                     "not seen: name a surface that reaches farther in contacts.{}",
                                     contact.name)
                               : std::string(
                                     "the body ends there: make it longer, let the other begin farther from that end, "
                                     "or end the run (time.end) before");
  return fmt::format("contact {} is at the end of '{}'{}; {}", contact.name, surface, where, mend);
}

std::vector<std::string> EndMonitor::never_closed() const {
  std::vector<std::string> lines;
  for (std::size_t c = 0; c < ever_closed_.size(); ++c) {
    if (ever_closed_[c] != 0) continue;
    double least = 1e300;
    for (const ContactPair& pair : contacts_) {
      if (pair.contact->name != assembled_.scene.contacts[c].name) continue;
      const auto gap = to_host(pair.arrays.gap);
      const auto tracked = to_host(pair.arrays.tracked);
      for (int s = 0; s < pair.arrays.slave_count; ++s)
        if (tracked(s) >= 0 && gap(s) > 0) least = std::min(least, gap(s));
    }
    lines.push_back(fmt::format(
        "contact {} never closed, as far as checks every {} steps and histories saw{}: see where its parts are and "
        "move, unless that is meant",
        assembled_.scene.contacts[c].name, steps_between,
        is_distance(least) ? fmt::format("; at the end its surfaces are {:.3g} m apart", least) : std::string()));
  }
  return lines;
}

template <class Archive>
void EndMonitor::archive_memory(Archive& archive) {
  for (std::size_t p = 0; p < pairs_.size(); ++p) archive.value(fmt::format("end_watch_{}", p), pairs_[p].memory);
  archive.values("end_watch_ever_closed", ever_closed_);
}

void EndMonitor::archive(StateSaver& state) {
  archive_memory(state);
  for (std::size_t p = 0; p < pairs_.size(); ++p)
    state.values(fmt::format("end_watch_touched_{}", p), to_vector(pairs_[p].arrays.touched));
}

void EndMonitor::archive(StateRestorer& state) {
  archive_memory(state);
  for (std::size_t p = 0; p < pairs_.size(); ++p) {
    const std::string name = fmt::format("end_watch_touched_{}", p);
    std::vector<int> touched;
    state.values(name, touched);
    if (touched.size() != pairs_[p].arrays.touched.extent(0))
      refuse_state(name, fmt::format("has {} values, not {}", touched.size(), pairs_[p].arrays.touched.extent(0)));
    pairs_[p].arrays.touched = to_device("touched at checks", touched);
  }
}

}  // namespace railwave
