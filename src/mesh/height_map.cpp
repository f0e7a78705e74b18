#include "mesh/height_map.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "case/error.hpp"
#include "case/number_table.hpp"
#include "mesh/files/text_file.hpp"
#include "mesh/hexahedron.hpp"

namespace railwave {
namespace {

/// Cell of an ascending list that holds the value, and how far along it; -1: outside.
std::pair<int, double> cell_of(const std::vector<double>& places, double value) {
  if (!(value >= places.front() && value <= places.back())) return {-1, 0};
  const auto above = std::upper_bound(places.begin(), places.end() - 1, value);
  const int cell = static_cast<int>(std::max(above, places.begin() + 1) - places.begin()) - 1;
  return {cell, (value - places[cell]) / (places[cell + 1] - places[cell])};
}

}  // namespace

HeightMap::HeightMap(const std::string& path) {
  std::map<std::array<double, 2>, double> points;
  const auto take = [&](int line, const std::vector<double>& value) {
    if (!points.insert({{value[0], value[1]}, value[2]}).second)
      throw InputError(
          fmt::format("{}:{}: gives the place x = {}, y = {} a second time", path, line, value[0], value[1]));
  };
  const std::string text = read_whole_file(path);
  if (text.find_first_not_of(" \t\r\n") == std::string::npos)
    throw InputError(fmt::format("{}:1: the first line is '', must name the columns: x,y,dz", path));
  parse_number_table(text, path, {length_column("x"), length_column("y"), length_column("dz")}, TableNames::must_stand,
                     take);
  for (const auto& [place, height] : points) {
    x_.push_back(place[0]);
    y_.push_back(place[1]);
    height_.push_back(height);
  }
  for (auto* places : {&x_, &y_}) {
    std::sort(places->begin(), places->end());
    places->erase(std::unique(places->begin(), places->end()), places->end());
  }
  if (x_.size() < 2 || y_.size() < 2)
    throw InputError(fmt::format("{}: has {} different x and {} different y, must have two of each at least", path,
                                 x_.size(), y_.size()));
  for (double x : x_)
    for (double y : y_)
      if (points.count({x, y}) == 0)
        throw InputError(fmt::format(
            "{}: has a hole: no line gives the place x = {}, y = {}; each of the {} x needs each of the {} y "
            "(fill holes by interpolation, or take a coarser grid)",
            path, x, y, x_.size(), y_.size()));
}

double HeightMap::at(double x, double y) const {
  const auto [i, u] = cell_of(x_, x);
  const auto [j, v] = cell_of(y_, y);
  if (i < 0 || j < 0) return 0;
  const auto height = [&, row = i, column = j](int k, int l) { return height_[(row + k) * y_.size() + column + l]; };
  return (1 - u) * ((1 - v) * height(0, 0) + v * height(0, 1)) + u * ((1 - v) * height(1, 0) + v * height(1, 1));
}

namespace {

/// The surface's height over y, of the topmost nodes: z is the same all along a rail.
class Crest {
 public:
  Crest(const std::vector<Face>& surface, const Mesh& mesh) {
    for (const Face& face : surface)
      for (int n : mesh.face_nodes(face)) {
        const auto [place, is_new] = top_.insert({mesh.nodes[n][1], mesh.nodes[n][2]});
        if (!is_new) place->second = std::max(place->second, mesh.nodes[n][2]);
      }
  }

  double at(double y) const {
    const auto above = top_.lower_bound(y);
    if (above == top_.begin()) return above->second;
    const auto below = std::prev(above);
    if (above == top_.end()) return below->second;
    const double share = (y - below->first) / (above->first - below->first);
    return (1 - share) * below->second + share * above->second;
  }

 private:
  std::map<double, double> top_;
};

}  // namespace

void apply_height_map(const HeightMap& map, double depth, const std::vector<Face>& surface, const std::string& place,
                      Mesh& mesh) {
  const Crest crest(surface, mesh);
  std::vector<char> moved(mesh.nodes.size(), 0);
  for (std::size_t n = 0; n < mesh.nodes.size(); ++n) {
    Vec3& x = mesh.nodes[n];
    const double height = map.at(x[0], x[1]);
    const double down = std::max(0.0, crest.at(x[1]) - x[2]) / depth;
    if (height == 0 || down >= 1) continue;
    x[2] += height * (1 - down) * (1 - down) * (1 + 2 * down);
    moved[n] = 1;
  }
  for (const auto& element : mesh.elements) {
    if (std::none_of(element.begin(), element.end(), [&](int n) { return moved[n] != 0; })) continue;
    const HexahedronCorners x = corners_of(mesh.nodes, element);
    for (const auto& sign : hexahedron_corner_signs)
      if (!(hexahedron_jacobian(x, sign[0], sign[1], sign[2]) > 0))
        throw InputError(fmt::format(
            "{}height_map: inverts the element at ({:.5g}, {:.5g}, {:.5g}) m, which is smaller than the map's heights "
            "there; give a larger height_map_depth, or see whether the heights are in m",
            place, x[0][0], x[0][1], x[0][2]));
  }
}

}  // namespace railwave
