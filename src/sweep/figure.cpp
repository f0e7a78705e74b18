#include "sweep/figure.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "case/number_text.hpp"
#include "case/suggest.hpp"
#include "output/hash.hpp"
#include "post/contact_tables.hpp"

namespace railwave::sweep {
namespace {

std::vector<std::string> patch_quantities() {
  std::vector<std::string> names;
  const ContactTables tables;
  for (const Column& column : tables.patches.columns())
    if (column.name != "time" && column.name != "patch") names.push_back(column.name);
  return names;
}

bool begins(const std::string& text, const std::string& with) { return text.rfind(with, 0) == 0; }

std::string read_patch(const std::string& text, Figure& figure) {
  const auto dot = text.find('.');
  if (dot == std::string::npos || dot == 0) return "must be patch.CONTACT.QUANTITY, such as patch.tread.area";
  figure.source = Figure::Source::patch;
  figure.contact = text.substr(0, dot);
  figure.quantity = text.substr(dot + 1);
  const auto known = patch_quantities();
  if (std::find(known.begin(), known.end(), figure.quantity) != known.end()) return "";
  return fmt::format("a patch has no '{}'; {}", figure.quantity, suggestion(figure.quantity, known));
}

std::string read_mode(const std::string& text, Figure& figure) {
  const auto dot = text.find('.');
  const auto number = parse_integer(text.substr(0, dot));
  constexpr int most = 100000;
  if (dot == std::string::npos || text.substr(dot + 1) != "frequency" || !number || *number < 1 || *number > most)
    return "must be mode.NUMBER.frequency, such as mode.1.frequency";
  figure.source = Figure::Source::mode;
  figure.mode = static_cast<int>(*number);
  return "";
}

}  // namespace

bool FigureChoice::need(Figure::Source source) const {
  return std::any_of(figures.begin(), figures.end(), [&](const Figure& one) { return one.source == source; });
}

std::string FigureChoice::key() const {
  Hash hash;
  for (const Figure& one : figures)
    hash.add(fmt::format("{} {} {} {} {} {} {} {} {} {}", one.name, static_cast<int>(one.source), one.contact,
                         one.quantity, one.mode, static_cast<int>(one.take), one.from, one.to, one.low, one.high));
  const auto& d = patches.rolling_direction;
  hash.add(fmt::format("{} {} {} {} {} {}", d[0], d[1], d[2], patches.axle.value_or(""),
                       patches.rolling_velocity.value_or(0), modes_up_to));
  for (const std::string& part : modes_parts) hash.add(part);
  return hash.text();
}

const std::vector<std::string>& take_names() {
  static const std::vector<std::string> names = {"last", "mean", "minimum", "maximum", "largest", "rms", "frequency"};
  return names;
}

std::string read_source(const std::string& text, Figure& figure) {
  if (begins(text, "patch.")) return read_patch(text.substr(6), figure);
  if (begins(text, "mode.")) return read_mode(text.substr(5), figure);
  figure.source = Figure::Source::history;
  figure.quantity = text;
  if (text.find('.') != std::string::npos && text.back() != '.') return "";
  return "must be patch.CONTACT.QUANTITY, mode.NUMBER.frequency, or a history as railwave signal --channel takes it, "
         "such as contact.tread.normal_force.z, energy.kinetic or wheel.bore.velocity.x";
}

std::vector<Figure> usual_figures(const std::vector<std::string>& contacts) {
  std::vector<Figure> figures;
  for (const std::string& contact : contacts)
    for (const char* quantity : {"area", "peak_nodal_pressure", "peak_shear", "normal_force", "creep_force",
                                 "lateral_force", "longitudinal_creepage", "lateral_creepage", "spin_creepage"}) {
      Figure one;
      one.name = contact + '_' + quantity;
      one.source = Figure::Source::patch;
      one.contact = contact;
      one.quantity = quantity;
      figures.push_back(one);
    }
  for (const char* energy : {"kinetic", "internal", "hourglass", "friction", "balance_error"}) {
    Figure one;
    one.name = std::string("energy_") + energy;
    one.quantity = std::string("energy.") + energy;
    figures.push_back(one);
  }
  return figures;
}

}  // namespace railwave::sweep
