#pragma once

#include <string>

#include "deck/deck.hpp"

namespace railwave::deck {

/// What the deck's units are in SI.
struct Units {
  double length = 1;  ///< m
  double mass = 1;    ///< kg
  double time = 1;    ///< s
  std::string name = "m,kg,s";

  double force() const { return mass * length / (time * time); }
  double pressure() const { return mass / (length * time * time); }
  double density() const { return mass / (length * length * length); }
  double velocity() const { return length / time; }
  double acceleration() const { return length / (time * time); }
};

/// Units from their names, "mm,t,s": length (m, mm, cm, um, in, ft), mass (kg, g, mg, t, lb, slug, slinch), time (s,
/// ms, us). In any order. Throws InputError that lists them where one is unknown or missing.
Units units_of(const std::string& names);

/// The units that a deck's materials are in, judged by densities and stiffness of solids: SI where these are possible
/// in it. Throws InputError with the units that fit, where SI does not.
/// @param materials of parts of solids
Units guessed_units(const Deck& deck, const std::set<Number>& materials, const std::string& path);

}  // namespace railwave::deck
