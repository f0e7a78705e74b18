#include "mesh/sections/profiles.hpp"

#include <array>
#include <cmath>
#include <stdexcept>
#include <vector>

namespace railwave {

namespace {

// EN 13715, sections A to H of S1002; all in mm, each with value and slope.
constexpr std::array<double, 9> section_b = {0,
                                             -3.358537058e-2,
                                             1.565681624e-3,
                                             -2.810427944e-5,
                                             5.844240864e-8,
                                             -1.562379023e-8,
                                             5.309217349e-15,
                                             -5.957839843e-12,
                                             2.646656573e-13};
constexpr std::array<double, 8> section_c = {-4.320221063e3,  -1.038384026e3,  -1.065501873e2,  -6.051367875,
                                             -2.054332446e-1, -4.169739389e-3, -4.687195829e-5, -2.252755540e-7};

struct Value {
  double height, slope;
};

template <std::size_t N>
Value polynomial(const std::array<double, N>& coefficients, double s) {
  Value result{0, 0};
  for (std::size_t i = N; i-- > 0;) {
    result.slope = result.slope * s + result.height;
    result.height = result.height * s + coefficients[i];
  }
  return result;
}

/// Upper (side +1) or lower (side -1) half of a circle.
Value circle(double centre_s, double centre_z, double radius, int side, double s) {
  const double across = s - centre_s;
  const double rise = std::sqrt(std::max(0.0, radius * radius - across * across));
  return {centre_z + side * rise, -side * across / rise};
}

Value s1002(double s) {
  const double joint = s + 1e-9;  // a joint belongs to the section on its field side, as in the table
  if (joint > 32.15796) return {1.364323640 - 0.066666667 * s, -0.066666667};
  if (joint > -26) return polynomial(section_b, s);
  if (joint > -35) return polynomial(section_c, s);
  if (joint > -38.426669071) return circle(-26.210665, 16.446, 13, -1, s);
  if (joint > -39.764473993) return {-93.576667419 - 2.747477419 * s, -2.747477419};
  if (joint > -49.662510381) return circle(-58.558326413, 8.834924130, 20, 1, s);
  if (joint > -62.764705882) return circle(-55, 16, 12, 1, s);
  return circle(-49.5, 9.519259302, 20.5, 1, s);
}

/// One piece of an outline: where it ends (mm) and its radius, 0 for a straight line, positive where the centre lies on
/// the right of the way (convex, as the outline is clockwise). `corner`: the mesh has a corner at the piece's middle.
struct Piece {
  double y, z, radius;
  bool corner = false;
};

// Junctions of head and gauge corner follow from tangency of R300, R80, R13 and the side's 1:20.
const std::vector<Piece> outline_54e1 = {{10.012, 158.83288654849054, 300},
                                         {24.8635, 156.9351320773918, 80},
                                         {35.000058322078644, 144.8999477821147, 13},
                                         {35.99793, 124.94261, 0},
                                         {34.02690, 121.97342, 3, true},
                                         {14.93000, 115.02909, 0},
                                         {10.13180, 110.20646, -8, true},
                                         {8.76893, 104.14000, -25.4},
                                         {9.53701, 36.71274, -508},
                                         {20.02071, 22.91974, -16, true},
                                         {43.92263, 14.22813, 0},
                                         {48.76742, 13.12326, -20},
                                         {67.29851, 11.27015, 0},
                                         {70.00000, 8.28504, 3, true},
                                         {70.00000, 2.00000, 0},
                                         {68.00000, 0.00000, 2, true},
                                         {0.00000, 0.00000, 0}};
const std::vector<Piece> outline_60e1 = {
    {10.228, 171.8255959987406, 300}, {26.0265, 169.69747593881527, 80}, {35.99981082207864, 157.70004197554496, 13},
    {37.04858, 136.72467, 0},         {35.07755, 133.75547, 3, true},    {16.41810, 126.97022, 0},
    {12.03086, 122.13495, -7, true},  {8.25000, 92.25000, -120},         {8.25000, 60.25000, 0},
    {12.03086, 30.36505, -120},       {16.41810, 25.52978, -7, true},    {44.86223, 15.18646, 0},
    {55.68207, 12.87985, -40},        {71.28499, 11.76536, 0},           {75.00000, 7.77552, 4, true},
    {75.00000, 2.00000, 0},           {73.00000, 0.00000, 2, true},      {0.00000, 0.00000, 0}};

}  // namespace

double s1002_height(double s) { return 1e-3 * s1002(1e3 * s).height; }
double s1002_slope(double s) { return s1002(1e3 * s).slope; }

Curve s1002_curve(double radius, double end) {
  std::vector<Curve> pieces;  // one for each section: arc lengths are integrated where the slope is smooth
  double from = s1002_flange_back_joint;
  const auto add = [&](double to) {
    pieces.push_back(graph(
        from, to, [radius](double s) { return radius + s1002_height(s); }, s1002_slope));
    from = to;
  };
  for (double joint : s1002_joints)
    if (joint > from && joint < end) add(joint);
  add(end);
  return joined(pieces);
}

RailOutline rail_outline(const std::string& section) {
  const std::vector<Piece>* pieces = nullptr;
  RailOutline outline;
  if (section == "54E1") {
    pieces = &outline_54e1;
    outline.height = 0.159;
  } else if (section == "60E1") {
    pieces = &outline_60e1;
    outline.height = 0.172;
  } else {
    throw std::invalid_argument("unknown rail section " + section);
  }
  std::vector<Curve> cut;  // the curves between corners
  std::vector<Curve> current;
  Point2 from{0, outline.height};
  double travelled = 0;
  for (std::size_t i = 0; i < pieces->size(); ++i) {
    const Piece& piece = (*pieces)[i];
    const Point2 to{1e-3 * piece.y, 1e-3 * piece.z};
    const Curve curve = piece.radius == 0 ? line(from, to) : arc(from, to, -1e-3 * piece.radius);
    if (piece.corner) {
      current.push_back(part(curve, 0, curve.length / 2));
      cut.push_back(joined(current));
      current = {part(curve, curve.length / 2, curve.length)};
    } else {
      current.push_back(curve);
    }
    travelled += curve.length;
    if (i == 1) outline.crown_end = travelled;
    if (i == 2) outline.gauge_corner_end = travelled;
    from = to;
  }
  cut.push_back(joined(current));
  outline.head = cut[0];
  outline.underside = cut[1];
  outline.web = cut[2];
  outline.foot_top = cut[3];
  outline.toe = cut[4];
  outline.base = cut[5];
  return outline;
}

}  // namespace railwave
