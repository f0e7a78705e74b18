#pragma once

#include <algorithm>

#include "benchmarks/problems/problem.hpp"
#include "model/contact/contact_state.hpp"
#include "solve/statics/settle.hpp"

namespace railwave::bench {

/// A cylinder of large radius on a flat block in plane strain, both of steel: Hertz's line contact. Two graded meshes
/// one element thick, 'upper' (its lower face curved, slave) and 'lower' (master, its nodes between the slave's).
struct PressedCylinder {
  double radius = 0.115;         ///< m
  double half_width = 2e-3;      ///< m, of the contact, about: the pressing is chosen for it
  double block_width = 0.03;     ///< m, half of it
  double block_height = 0.04;    ///< m, of each
  double element_size = 2.5e-4;  ///< m, at the contact

  /// E* of two bodies of one material, Pa.
  static double contact_modulus(const scene::Material& m) {
    return m.youngs_modulus / (2 * (1 - m.poissons_ratio * m.poissons_ratio));
  }
  /// Force a metre that gives the half width.
  double force(const scene::Material& m) const {
    return pi * contact_modulus(m) * half_width * half_width / (4 * radius);
  }
  /// By which the blocks' far faces come nearer under that force, both blocks (Johnson, Contact Mechanics, eq. 5.58).
  double approach(const scene::Material& m) const {
    const double nu = m.poissons_ratio;
    return 2 * force(m) * (1 - nu * nu) / (pi * m.youngs_modulus) *
           (2 * std::log(2 * block_height / half_width) - nu / (1 - nu));
  }

  scene::Scene scene(const Method& method) const {
    scene::Scene made = block_scene({1, 1, 1}, {1, 1, 1}, method.choice);
    apply(method, made);
    made.path = "pressed cylinder";
    made.parts[0].name = "upper";
    made.parts.push_back(made.parts[0]);
    made.parts[1].name = "lower";
    scene::Contact contact;
    contact.name = "line";
    contact.slave = "upper.contact";
    contact.master = "lower.contact";
    contact.penalty_scale = method.penalty_scale;
    contact.algorithm = method.contact;
    made.contacts.push_back(contact);
    hold(made, "upper", {false, true, false});
    hold(made, "lower", {false, true, false});
    hold(made, "upper.far", {false, false, true});
    hold(made, "lower.far", {true, false, true});
    made.settle.active = true;
    made.settle.method = scene::SettleMethod::relaxation;
    made.settle.tolerance = 2e-3;
    made.settle.max_steps = 20000;
    return made;
  }

  Assembly assembly(const scene::Material& material) const {
    Assembly made;
    const double pressed = approach(material);
    add_block(made, "upper", 0.0,
              [&](double x, double s) { return (1 - s / block_height) * x * x / (2 * radius) + s - pressed; });
    add_block(made, "lower", 0.37 * element_size, [](double, double s) { return -s; });
    return made;
  }

 private:
  /// Fine over one and a half contact widths, then growing outwards.
  std::vector<double> across(double shift) const {
    const double fine = 1.5 * half_width;
    std::vector<double> right, result;
    double x = shift, step = element_size;
    for (; x < fine; x += step) right.push_back(x);
    grow(right, step, block_width);
    std::vector<double> left;
    for (x = shift - step; x > -fine; x -= step) left.push_back(-x);
    grow(left, step, block_width);
    for (std::size_t k = left.size(); k-- > 0;) result.push_back(-left[k]);
    result.insert(result.end(), right.begin(), right.end());
    return result;
  }
  std::vector<double> downwards() const {
    std::vector<double> result;
    for (double s = 0; s < half_width; s += element_size) result.push_back(s);
    grow(result, element_size, block_height);
    return result;
  }
  static void grow(std::vector<double>& places, double step, double end) {
    while (end - places.back() > 1.7 * step) {
      step *= 1.25;
      places.push_back(places.back() + step);
    }
    if (end - places.back() < 0.5 * step) places.pop_back();
    places.push_back(end);
  }

  /// @param height z at x and at a depth s below the contact face
  void add_block(Assembly& made, const std::string& name, double shift,
                 const std::function<double(double, double)>& height) const {
    const auto x = across(shift), s = downwards();
    const int nx = static_cast<int>(x.size()), ns = static_cast<int>(s.size());
    Assembly::PartRange part;
    part.name = name;
    part.first_node = static_cast<int>(made.nodes.size());
    part.first_element = static_cast<int>(made.elements.size());
    const auto number = [&](int i, int j, int k) { return part.first_node + (k * 2 + j) * nx + i; };
    for (int k = 0; k < ns; ++k)
      for (int j = 0; j < 2; ++j)
        for (int i = 0; i < nx; ++i) {
          made.node_sets[name].push_back(static_cast<int>(made.nodes.size()));
          if (k == ns - 1) made.node_sets[name + ".far"].push_back(static_cast<int>(made.nodes.size()));
          made.nodes.push_back({x[i], j * element_size, height(x[i], s[k])});
        }
    const bool upwards = height(0, s[1]) > height(0, s[0]);
    for (int k = 0; k + 1 < ns; ++k)
      for (int i = 0; i + 1 < nx; ++i) {
        const int e = static_cast<int>(made.elements.size());
        const int low = upwards ? k : k + 1, high = upwards ? k + 1 : k;
        made.elements.push_back({number(i, 0, low), number(i + 1, 0, low), number(i + 1, 1, low), number(i, 1, low),
                                 number(i, 0, high), number(i + 1, 0, high), number(i + 1, 1, high),
                                 number(i, 1, high)});
        made.element_sets[name].push_back(e);
        const bool fine = std::fmax(std::fabs(x[i]), std::fabs(x[i + 1])) < 1.5 * half_width + element_size;
        if (k == 0 && fine) made.surfaces[name + ".contact"].push_back({e, upwards ? 0 : 1});
      }
    part.node_count = static_cast<int>(made.nodes.size()) - part.first_node;
    part.element_count = static_cast<int>(made.elements.size()) - part.first_element;
    made.parts.push_back(part);
  }
};

/// Pressure and shear of each slave node, with the contact's resultants a metre.
struct LineContact {
  std::vector<double> x, area, pressure, shear;
  std::vector<int> sticks;
  double normal = 0, tangential = 0, centre = 0;  ///< N/m, N/m, m

  LineContact(const Model& model, double thickness) {
    const ContactState state = contact_state(model, model.ties, model.contacts, 0);
    const std::size_t count = state.slave.nodes.size();
    for (std::size_t n = 0; n < count; ++n) {
      const double* f = &state.slave.normal_force[3 * n];
      const double* t = &state.slave.tangential_force[3 * n];
      const double size = std::sqrt(f[0] * f[0] + f[1] * f[1] + f[2] * f[2]);
      x.push_back(state.slave.position[3 * n]);
      area.push_back(state.slave.area[n]);
      pressure.push_back(size / area[n]);
      shear.push_back(t[0] / area[n]);
      sticks.push_back(state.slipping[n] == 1 ? 1 : 0);
      normal += size / thickness;
      tangential += t[0] / thickness;
      centre += x[n] * size / thickness;
    }
    centre /= normal;
  }

  /// sum A (a - b)^2 over sum A b^2, root; @param exact by x from the contact's middle
  double error(const std::vector<double>& values, const std::function<double(double)>& exact) const {
    double off = 0, size = 0;
    for (std::size_t n = 0; n < x.size(); ++n) {
      const double right = exact(x[n] - centre);
      off += area[n] * std::pow(values[n] - right, 2);
      size += area[n] * right * right;
    }
    return std::sqrt(off / size);
  }
};

}  // namespace railwave::bench
