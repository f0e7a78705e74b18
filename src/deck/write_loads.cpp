#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "deck/conversion.hpp"
#include "mesh/vectors.hpp"

namespace railwave::deck {
namespace {

constexpr std::size_t most_shares = 64;  // loads of one card

/// Nodes of equal mass, among which a load is shared evenly.
std::vector<std::vector<int>> of_equal_mass(const std::vector<int>& nodes, const std::vector<double>& mass) {
  constexpr double equal = 1e-9;
  auto ordered = nodes;
  std::stable_sort(ordered.begin(), ordered.end(), [&](int a, int b) { return mass[a] < mass[b]; });
  std::vector<std::vector<int>> groups;
  for (const int n : ordered) {
    if (groups.empty() || mass[n] > mass[groups.back().front()] * (1 + equal)) groups.emplace_back();
    groups.back().push_back(n);
  }
  return groups;
}

class NodalLoads {
 public:
  explicit NodalLoads(Conversion& conversion) : conversion_(conversion), mass_(conversion.node_masses()) {}

  /// All loads; those of single nodes that are alike go together, and a node that is named twice has twice the force.
  void write() {
    using Kind = std::tuple<Number, Number, Number, double, int>;
    std::map<Kind, std::pair<const NodalLoad*, std::vector<int>>> single;
    std::map<std::pair<Kind, int>, int> times;
    for (const NodalLoad& load : conversion_.deck.nodal_loads) {
      const auto nodes = conversion_.members(load.nodes, load.source);
      if (load.nodes.is_set) {
        write(load, nodes);
        continue;
      }
      const Kind kind{load.direction, load.curve, load.axes, load.scale, 0};
      auto& alike = single[{load.direction, load.curve, load.axes, load.scale, times[{kind, nodes.front()}]++}];
      if (alike.first == nullptr) alike.first = &load;
      alike.second.push_back(nodes.front());
    }
    for (const auto& [kind, alike] : single) write(*alike.first, alike.second);
  }

 private:
  void write(const NodalLoad& load, const std::vector<int>& nodes) {
    if (load.direction < 1 || load.direction > 3)
      return conversion_.report.refuse_always(
          load.source, fmt::format("DOF {} isn't read, only forces along 1, 2 and 3", load.direction));
    Vec3 direction{0, 0, 0};
    direction[load.direction - 1] = 1;
    if (load.axes != 0) direction = conversion_.axes(load.axes, load.source)[load.direction - 1];
    const Vec3 force = scaled(load.scale * conversion_.units.force(), direction);
    const Target target = conversion_.target(nodes);
    const std::string curve = conversion_.use_curve(load.curve, load.source);
    const int first = count_ + 1;
    for (const auto& [body, of_body] : target.of_body) {
      auto groups = of_equal_mass(of_body, mass_);
      if (groups.size() > most_shares) {
        groups = {of_body};
        conversion_.report.add(
            Fate::replaced, load.source,
            fmt::format("the same force on each of {} nodes: their sum, shared by mass", of_body.size()));
      }
      for (const auto& group : groups)
        write(conversion_.mesh.node_set(body, group, conversion_.name_of(load.nodes)),
              scaled(static_cast<double>(group.size()), force), curve);
    }
    for (const int n : target.points)
      if (!conversion_.points.at(n).ground) write(conversion_.points.at(n).name, force, curve);
    conversion_.report.add(
        count_ < first ? Fate::dropped : Fate::taken, load.source,
        count_ < first ? "its nodes belong to nothing"
        : count_ == first
            ? fmt::format("[loads.force_{}]", first)
            : fmt::format("[loads.force_{}] to [loads.force_{}]: nodes of equal mass each", first, count_));
  }

  void write(const std::string& target, const Vec3& force, const std::string& curve) {
    CaseText& text = conversion_.text;
    text.section(fmt::format("loads.force_{}", ++count_));
    text.key("type", toml(std::string("nodal_force")));
    text.key("target", toml(target));
    text.key("force", force);
    text.key("curve", toml(curve));
  }

  Conversion& conversion_;
  std::vector<double> mass_;
  int count_ = 0;
};

/// Faces of a pressure, by body and the side on which it pushes.
std::map<std::pair<int, int>, std::vector<Face>> faces_of(const Conversion& conversion, const Pressure& pressure) {
  std::map<std::pair<int, int>, std::vector<Face>> faces;
  const auto add = [&](const std::vector<Segment>& segments, const Source& source) {
    for (const Segment& segment : segments) {
      int outwards = 1;
      const Face face = conversion.face_of(segment, source, outwards);
      faces[{conversion.bodies.of_element(face.element), outwards}].push_back(face);
    }
  };
  add(pressure.segments, pressure.source);
  if (pressure.set == 0) return faces;
  const auto set = conversion.deck.segment_sets.find(pressure.set);
  if (set == conversion.deck.segment_sets.end())
    conversion.fail(pressure.source, fmt::format("there is no segment set {}; define it", pressure.set));
  add(set->second.segments, set->second.source);
  conversion.report.use(set->second.source, "surface of the pressure");
  const auto& parts = set->second.parts;
  if (!parts.empty())
    for (const Face& face : conversion.skin_of({parts.begin(), parts.end()}))
      faces[{conversion.bodies.of_element(face.element), 1}].push_back(face);
  return faces;
}

/// Pressures of single segments that follow one curve go together; a segment that is named twice has twice the
/// pressure.
std::vector<Pressure> gathered(const std::vector<Pressure>& pressures) {
  std::map<std::tuple<Number, double, int>, std::size_t> single;
  std::map<std::tuple<Number, double, Segment>, int> times;
  std::vector<Pressure> all;
  for (const Pressure& one : pressures) {
    if (one.set != 0) all.push_back(one);
    for (const Segment& segment : one.segments) {
      Segment nodes = segment;
      std::sort(nodes.begin(), nodes.end());
      const int before = times[{one.curve, one.scale, nodes}]++;
      const auto [entry, is_new] = single.emplace(std::make_tuple(one.curve, one.scale, before), all.size());
      if (is_new) {
        all.push_back(one);
        all.back().segments.clear();
      }
      all[entry->second].segments.push_back(segment);
    }
  }
  return all;
}

void write_pressures(Conversion& conversion) {
  int count = 0;
  for (const Pressure& pressure : gathered(conversion.deck.pressures)) {
    const std::string curve = conversion.use_curve(pressure.curve, pressure.source);
    for (const auto& [side, faces] : faces_of(conversion, pressure)) {
      const auto [body, outwards] = side;
      CaseText& text = conversion.text;
      const std::string name = fmt::format("pressure_{}", ++count);
      text.section("loads." + name);
      text.key("type", toml(std::string("pressure")));
      text.key("target", toml(conversion.mesh.surface(body, faces, name)));
      text.key("pressure", outwards * pressure.scale * conversion.units.pressure());
      text.key("curve", toml(curve));
      conversion.report.add(Fate::taken, pressure.source,
                            fmt::format("[loads.{}]{}", name,
                                        outwards < 0 ? ": the segments look into the body, so that a positive pressure "
                                                       "pulls"
                                                     : ""));
    }
  }
}

/// The base accelerates, so that bodies are pushed the other way. Constant acceleration is gravity, any other a force
/// that is shared by mass.
void write_body_loads(Conversion& conversion) {
  Vec3 gravity{0, 0, 0};
  bool any = false;
  int count = 0;
  for (const BodyLoad& load : conversion.deck.body_loads) {
    const Curve& curve = conversion.curve(load.curve, load.source);
    const double first = curve.points.front()[1];
    const bool constant =
        std::all_of(curve.points.begin(), curve.points.end(), [&](const auto& point) { return point[1] == first; });
    if (constant) {
      gravity[load.direction] -= load.scale * first * conversion.units.acceleration();
      any = true;
      conversion.report.add(Fate::taken, load.source, "[gravity], against the direction of the base's acceleration");
      if (curve.source.keyword != "STEP") conversion.report.add(Fate::taken, curve.source, "it is constant: [gravity]");
      continue;
    }
    const std::string name = conversion.use_curve(load.curve, load.source);
    const auto write = [&](const std::string& target, double mass) {
      CaseText& text = conversion.text;
      text.section(fmt::format("loads.body_force_{}", ++count));
      text.key("type", toml(std::string("nodal_force")));
      text.key("target", toml(target));
      Vec3 force{0, 0, 0};
      force[load.direction] = -load.scale * mass * conversion.units.force();
      text.key("force", force);
      text.key("curve", toml(name));
    };
    for (std::size_t b = 0; b < conversion.bodies.all().size(); ++b)
      write(conversion.bodies.all()[b].name + "." + conversion.bodies.all()[b].element_set,
            conversion.body_mass(static_cast<int>(b)));
    for (const auto& [n, point] : conversion.points)
      if (point.mass > 0) write(point.name, point.mass);
    conversion.report.add(conversion.bodies.joints().empty() ? Fate::taken : Fate::replaced, load.source,
                          fmt::format("[loads.body_force_1] to [loads.body_force_{}]: shared by mass", count));
  }
  if (!any) return;
  conversion.text.section("gravity");
  conversion.text.key("acceleration", gravity);
}

}  // namespace

void write_loads(Conversion& conversion) {
  if (!conversion.deck.nodal_loads.empty()) {
    NodalLoads loads(conversion);
    loads.write();
  }
  write_pressures(conversion);
  write_body_loads(conversion);
}

}  // namespace railwave::deck
