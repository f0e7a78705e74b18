#include "deck/conversion.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "case/error.hpp"
#include "case/number_text.hpp"
#include "mesh/files/mesh_file.hpp"
#include "mesh/hexahedron.hpp"
#include "mesh/vectors.hpp"

namespace railwave::deck {

std::string toml(double value) {
  if (!std::isfinite(value))
    throw InputError("a number of the deck is too large in SI units; see whether --units fits");
  return fmt::format("{:.15g}", value == 0 ? 0.0 : value);  // no -0
}

std::string toml(const Vec3& value) {
  return fmt::format("[{}, {}, {}]", toml(value[0]), toml(value[1]), toml(value[2]));
}

std::string toml(const std::string& text) {
  const bool readable = is_utf8(text);  // titles of decks are in any encoding
  std::string result = "\"";
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\')
      result += std::string("\\") + c;
    else
      result += byte < 0x20 || byte == 0x7f || (byte > 0x7f && !readable) ? ' ' : c;
  }
  return result + '"';
}

std::string toml(const std::vector<std::string>& texts) {
  std::string result = "[";
  for (const std::string& text : texts) result += (result.size() > 1 ? ", " : "") + toml(text);
  return result + "]";
}

void CaseText::section(const std::string& name) { text_ += (text_.empty() ? "[" : "\n[") + name + "]\n"; }
void CaseText::key(const std::string& name, const std::string& value) { text_ += name + " = " + value + "\n"; }
void CaseText::key(const std::string& name, double value) { key(name, toml(value)); }
void CaseText::key(const std::string& name, const Vec3& value) { key(name, toml(value)); }
void CaseText::remark(const std::string& text) { text_ += "# " + text + "\n"; }

void Conversion::fail(const Source& source, const std::string& why) const {
  throw InputError(
      fmt::format("{}:{}: *{}: {}", deck.mesh.files[source.place.file], source.place.position, source.keyword, why));
}

int Conversion::node(Number number, const Source& source) const {
  const auto found = deck.mesh.find_node(number);
  if (!found) fail(source, fmt::format("there is no node {}; define it, or mend the number", number));
  return *found;
}

const NumberSet& Conversion::part_set(Number number, const Source& source) const {
  const auto found = deck.part_sets.find(number);
  if (found == deck.part_sets.end())
    fail(source, fmt::format("there is no part set {}; define it, or mend the number", number));
  report.use(found->second.source, "its parts, where something names them");
  return found->second;
}

std::vector<int> Conversion::members(const Nodes& nodes, const Source& source) {
  if (!nodes.is_set) return {node(nodes.number, source)};
  const auto found = deck.node_sets.find(nodes.number);
  if (found == deck.node_sets.end())
    fail(source, fmt::format("there is no node set {}; define it, or mend the number", nodes.number));
  const NumberSet& set = found->second;
  report.use(set.source, fmt::format("set '{}' of the mesh, where something names it", name_of(nodes)));
  std::vector<int> result;
  const auto& numbers = deck.mesh.node_numbers();
  for (const Range& range : set.ranges) {
    if (range.first == range.last) {
      result.push_back(node(range.first, set.source));
      continue;
    }
    if (node_order.empty()) {
      for (std::size_t n = 0; n < numbers.size(); ++n) node_order.emplace_back(numbers[n], static_cast<int>(n));
      std::sort(node_order.begin(), node_order.end());
    }
    auto at = std::lower_bound(node_order.begin(), node_order.end(), std::make_pair(range.first, 0));
    for (; at != node_order.end() && at->first <= range.last; ++at)
      if ((at->first - range.first) % range.step == 0) result.push_back(at->second);
  }
  if (set.all)
    for (std::size_t n = 0; n < deck.own_nodes; ++n) result.push_back(static_cast<int>(n));
  if (!set.parts.empty())
    for (const int e : elements_of({set.parts.begin(), set.parts.end()}))
      for (const int n : bodies.mesh().elements[e]) result.push_back(n);
  for (const Number number : set.boxes) {
    const auto box = deck.boxes.find(number);
    if (box == deck.boxes.end())
      fail(set.source, fmt::format("there is no box {} (of *DEFINE_BOX); define it, or mend the number", number));
    report.use(box->second.source, "nodes within it, where something names them");
    add_nodes_within(box->second, result);
  }
  sort_unique(result);
  return result;
}

void Conversion::add_nodes_within(const Box& box, std::vector<int>& nodes) const {
  for (std::size_t n = 0; n < deck.own_nodes; ++n) {
    bool within = true;
    for (int i = 0; i < 3; ++i) {
      const double x = bodies.mesh().nodes[n][i];
      within = within && x >= box.low[i] && x <= box.high[i];
    }
    if (within) nodes.push_back(static_cast<int>(n));
  }
}

Target Conversion::target(const std::vector<int>& nodes) const {
  Target target;
  for (const int n : nodes) {
    if (bodies.of_node(n) >= 0)
      target.of_body[bodies.of_node(n)].push_back(n);
    else if (points.count(n) != 0)
      target.points.push_back(n);
    else
      target.unused.push_back(n);
  }
  return target;
}

std::string Conversion::name_of(const Nodes& nodes) const {
  if (!nodes.is_set) return fmt::format("node_{}", nodes.number);
  const auto set = deck.node_sets.find(nodes.number);
  const std::string title = set == deck.node_sets.end() ? "" : fit_name(set->second.title);
  return title.empty() ? fmt::format("nodes_{}", nodes.number) : title;
}

std::string Conversion::node_name(int node) {
  if (bodies.of_node(node) < 0) return points.at(node).name;
  return mesh.node_set(bodies.of_node(node), {node}, fmt::format("node_{}", deck.mesh.node_numbers()[node]));
}

std::vector<int> Conversion::elements_of(const std::set<Number>& parts) const {
  std::vector<int> elements;
  for (std::size_t e = 0; e < deck.element_parts.size(); ++e)
    if (parts.count(deck.element_parts[e]) != 0) elements.push_back(static_cast<int>(e));
  return elements;
}

std::vector<Face> Conversion::skin_of(const std::set<Number>& parts) const {
  std::vector<Face> faces;
  for (const Face& face : bodies.exterior())
    if (parts.count(deck.element_parts[face.element]) != 0) faces.push_back(face);
  return faces;
}

std::set<Number> Conversion::parts_of(Number number, bool is_set, const Source& source) const {
  if (!is_set) return {number};
  std::set<Number> parts;
  for (const Range& range : part_set(number, source).ranges)
    for (const auto& [part, unused] : deck.parts)
      if (part >= range.first && part <= range.last && (part - range.first) % range.step == 0) parts.insert(part);
  return parts;
}

Face Conversion::face_of(const Segment& segment, const Source& source, int& outwards) const {
  std::array<int, 4> nodes{};
  for (int i = 0; i < 4; ++i) nodes[i] = node(segment[i], source);
  std::vector<Face> faces = bodies.faces_at(nodes);
  if (faces.size() != 1)
    fail(source, fmt::format("segment {}, {}, {}, {} is {}; name four nodes of an outside face", segment[0], segment[1],
                             segment[2], segment[3],
                             faces.empty() ? "no face of a hexahedron" : "between two hexahedra, not outside"));
  const auto out = bodies.mesh().face_nodes(faces[0]);
  const auto first = std::find(out.begin(), out.end(), nodes[0]) - out.begin();
  outwards = out[(first + 1) % 4] == nodes[1] ? 1 : -1;
  return faces[0];
}

std::vector<Face> Conversion::faces_of_set(Number number, const Source& source) const {
  const auto found = deck.segment_sets.find(number);
  if (found == deck.segment_sets.end())
    fail(source, fmt::format("there is no segment set {}; define it, or mend the number", number));
  report.use(found->second.source,
             fmt::format("surface '{}' of the mesh, where something names it", name_of_segments(number)));
  std::vector<Face> faces;
  int outwards = 1;
  for (const Segment& segment : found->second.segments)
    faces.push_back(face_of(segment, found->second.source, outwards));
  const auto& parts = found->second.parts;
  if (!parts.empty())
    for (const Face& face : skin_of({parts.begin(), parts.end()})) faces.push_back(face);
  if (faces.empty()) fail(found->second.source, fmt::format("segment set {} is empty; add its segments", number));
  return faces;
}

std::string Conversion::name_of_segments(Number number) const {
  const auto set = deck.segment_sets.find(number);
  const std::string title = set == deck.segment_sets.end() ? "" : fit_name(set->second.title);
  return title.empty() ? fmt::format("segments_{}", number) : title;
}

std::map<int, std::vector<Face>> Conversion::by_body(const std::vector<Face>& faces) const {
  std::map<int, std::vector<Face>> result;
  for (const Face& face : faces) result[bodies.of_element(face.element)].push_back(face);
  return result;
}

const Curve& Conversion::curve(Number number, const Source& source) const {
  const auto found = deck.curves.find(number);
  if (found == deck.curves.end())
    fail(source, number == 0
                     ? "it names no curve; give one by *DEFINE_CURVE"
                     : fmt::format("there is no curve {} (of *DEFINE_CURVE); define it, or mend the number", number));
  return found->second;
}

std::string Conversion::add_curve(const std::string& name, const std::vector<std::array<double, 2>>& pairs) {
  std::string section = fmt::format("[curves.{}]\ntype = \"table\"\npoints = [", name);
  double before = -1e300;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    // Points that are one after rounding stay two.
    double time = *parse_real(fmt::format("{:.15g}", pairs[i][0] * units.time));
    if (time <= before) time = std::nextafter(before, 1e300);
    before = time;
    section += (i == 0 ? "" : i % 6 == 0 ? ",\n  " : ", ") + fmt::format("[{}, {}]", time, toml(pairs[i][1]));
  }
  curves[name] = section + "]\n";
  return name;
}

std::string Conversion::use_curve(Number number, const Source& source) {
  const Curve& of_deck = curve(number, source);
  const std::string name = fmt::format("curve_{}", number);
  if (curves.count(name) != 0) return name;
  const auto& last = of_deck.points.back();
  if (of_deck.source.keyword == "STEP") return add_curve(name, of_deck.points);  // what holds without an amplitude
  report.add(Fate::taken, of_deck.source, fmt::format("[curves.{}]", name));
  if (deck.control.end && last[0] < *deck.control.end)
    report.add(Fate::replaced, of_deck.source,
               fmt::format("the curve ends at {}, before the run: here its last value, {}, holds from then on", last[0],
                           last[1]));
  return add_curve(name, of_deck.points);
}

std::array<Vec3, 3> Conversion::axes(Number number, const Source& source) const {
  const auto found = deck.axes.find(number);
  if (found == deck.axes.end())
    fail(source,
         fmt::format("there are no axes {} (of *DEFINE_COORDINATE_SYSTEM, _VECTOR or _NODES); define them", number));
  const Axes& given = found->second;
  report.use(given.source, "axes of what names them");
  if (!given.nodes) return given.axes;
  const auto at = [&](int i) { return bodies.mesh().nodes[node((*given.nodes)[i], given.source)]; };
  const Vec3 along = difference(at(1), at(0)), across = cross(along, difference(at(2), at(0)));
  if (!(length(along) > 0) || !(length(across) > 0)) fail(given.source, "its three nodes lie on a line; name others");
  std::array<Vec3, 3> axes;
  const int x = given.direction, y = (x + 1) % 3, z = (x + 2) % 3;
  axes[x] = scaled(1 / length(along), along);
  axes[z] = scaled(1 / length(across), across);
  axes[y] = cross(axes[z], axes[x]);
  return axes;
}

double Conversion::body_mass(int body) const {
  double volume = 0;
  for (const int e : bodies.all()[body].elements)
    volume += hexahedron_volume(corners_of(bodies.mesh().nodes, bodies.mesh().elements[e]));
  return volume * deck.materials.at(bodies.all()[body].settings.material).density;
}

std::vector<double> Conversion::node_masses() const {
  std::vector<double> mass(bodies.mesh().nodes.size(), 0.0);
  for (const Body& body : bodies.all())
    for (const int e : body.elements) {
      const auto& corners = bodies.mesh().elements[e];
      const auto shares = hexahedron_shape_integrals(corners_of(bodies.mesh().nodes, corners));
      for (int i = 0; i < 8; ++i) mass[corners[i]] += shares[i] * deck.materials.at(body.settings.material).density;
    }
  return mass;
}

}  // namespace railwave::deck
