#include "deck/units.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "case/error.hpp"
#include "case/suggest.hpp"
#include "mesh/files/text_file.hpp"

namespace railwave::deck {
namespace {

struct Unit {
  const char* name;
  double size;
};

// International yard and pound, 1959: exact.
constexpr double pound = 0.45359237, inch = 0.0254, standard_gravity = 9.80665;
constexpr Unit lengths[] = {{"m", 1}, {"mm", 1e-3}, {"cm", 1e-2}, {"um", 1e-6}, {"in", inch}, {"ft", 12 * inch}};
constexpr Unit masses[] = {{"kg", 1},
                           {"g", 1e-3},
                           {"mg", 1e-6},
                           {"t", 1e3},
                           {"lb", pound},
                           {"slug", pound* standard_gravity / (12 * inch)},
                           {"slinch", pound* standard_gravity / inch}};
constexpr Unit times[] = {{"s", 1}, {"ms", 1e-3}, {"us", 1e-6}};

template <std::size_t count>
bool take(const Unit (&units)[count], const std::string& name, double& size, bool& given) {
  for (const Unit& unit : units)
    if (name == unit.name) {
      if (given) return false;
      size = unit.size;
      return given = true;
    }
  return false;
}

/// Densities and stiffness of anything solid, from foam to osmium and diamond.
bool fits(const Material& material, const Units& units) {
  const double density = material.density * units.density(), modulus = material.youngs_modulus * units.pressure();
  return density > 5 && density < 30000 && modulus > 1e4 && modulus < 2e12;
}

bool fit(const Deck& deck, const std::set<Number>& materials, const Units& units) {
  return std::all_of(materials.begin(), materials.end(),
                     [&](Number number) { return fits(deck.materials.at(number), units); });
}

}  // namespace

Units units_of(const std::string& names) {
  Units units;
  units.name = names;
  bool length = false, mass = false, time = false, good = true;
  std::size_t start = 0;
  for (int count = 0; start <= names.size(); ++count) {
    const auto comma = std::min(names.find(',', start), names.size());
    const std::string name(trim(std::string_view(names).substr(start, comma - start)));
    good = good && count < 3 &&
           (take(lengths, name, units.length, length) || take(masses, name, units.mass, mass) ||
            take(times, name, units.time, time));
    start = comma + 1;
  }
  if (good && length && mass && time) return units;
  throw InputError(
      fmt::format("--units is '{}'; give one of each of length (m, mm, cm, um, in, ft), mass (kg, g, mg, t, lb, slug, "
                  "slinch) and time (s, ms, us), such as mm,t,s",
                  for_message(names)));
}

Units guessed_units(const Deck& deck, const std::set<Number>& materials, const std::string& path) {
  const Units si;
  if (fit(deck, materials, si)) return si;
  std::vector<std::string> fitting;
  for (const char* names : {"mm,t,s", "mm,kg,ms", "mm,g,ms", "cm,g,us", "in,slinch,s", "cm,g,s", "m,kg,ms", "mm,kg,s"})
    if (fit(deck, materials, units_of(names))) fitting.push_back(std::string("--units ") + names);
  for (const Number number : materials) {
    const Material& material = deck.materials.at(number);
    if (fits(material, si)) continue;
    throw InputError(
        fmt::format("{}:{}: *{}: material {} with a density of {} and a Young's modulus of {} is none in SI units; {}",
                    deck.mesh.files[material.source.place.file], material.source.place.position,
                    material.source.keyword, number, material.density, material.youngs_modulus,
                    fitting.empty() ? "give the deck's units by --units, such as mm,t,s"
                                    : "give the deck's units, which may be " + joined(fitting, " or ")));
  }
  throw InputError(fmt::format("{}: give the deck's units by --units, such as mm,t,s", path));
}

}  // namespace railwave::deck
