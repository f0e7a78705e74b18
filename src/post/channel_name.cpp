#include "post/channel_name.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

#include <fmt/format.h>

#include "case/error.hpp"
#include "case/field_table.hpp"
#include "case/number_text.hpp"
#include "case/suggest.hpp"
#include "output/hdf5/hdf5.hpp"

namespace railwave {
namespace {

struct Quantity {
  const char* name;
  bool vector;
};

constexpr Quantity of_contacts[] = {{"normal_force", true},
                                    {"tangential_force", true},
                                    {"master_force", true},
                                    {"nodes_in_contact", false},
                                    {"nodes_slipping", false}};
constexpr Quantity of_beams[] = {{"force", true}, {"moment", true}};
constexpr Quantity of_loads[] = {{"force", true}, {"moment", false}, {"work", false}};
constexpr Quantity of_prescribed_motions[] = {{"reaction", true}, {"work", false}};
constexpr const char* components[] = {"xx", "yy", "zz", "xy", "yz", "zx", "mises"};
constexpr const char* directions = "x, y, z, size (the vector's length) or a vector such as 1,0,0.05";

/// What is asked for, and in which file, for complaints.
struct Asked {
  const std::string& text;
  const std::string& file;
  [[noreturn]] void refuse(const std::string& why) const {
    throw InputError(fmt::format("channel '{}' of {}: {}", text, file, why));
  }
};

std::vector<std::string> split(const std::string& text, char between) {
  std::vector<std::string> parts{""};
  for (const char c : text) {
    if (c == between)
      parts.emplace_back();
    else
      parts.back() += c;
  }
  return parts;
}

void set_direction(ChannelPlace& place, const std::string& text, const Asked& asked) {
  place.direction_text = text;
  if (text == "size") return;
  for (int axis = 0; axis < 3; ++axis)
    if (text == std::string(1, static_cast<char>('x' + axis))) {
      place.direction = Eigen::Vector3d::Unit(axis);
      return;
    }
  const auto parts = split(text, ',');
  Eigen::Vector3d direction = Eigen::Vector3d::Zero();
  bool good = parts.size() == 3;
  for (std::size_t i = 0; good && i < 3; ++i) {
    const auto read = parse_real(parts[i]);
    good = read.has_value();
    direction[static_cast<int>(i)] = read.value_or(0);
  }
  if (!good || !std::isfinite(direction.norm()) || !(direction.norm() > 0))
    asked.refuse(text.empty() ? fmt::format("it needs a direction at its end: {}", directions)
                              : fmt::format("'{}' is no direction; it may be {}", text, directions));
  place.direction = direction.normalized();
}

/// What of a tensor is meant by the text behind a quantity.
void set_component(ChannelPlace& place, const std::string& text, const Asked& asked) {
  const std::size_t count = place.quantity == "stress" ? 7 : 6;
  const auto found = std::find(components, components + count, text);
  if (found == components + count) {
    const std::string allowed = joined(std::vector<std::string>(components, components + count));
    asked.refuse(text.empty() ? fmt::format("it needs a component at its end: {}", allowed)
                              : fmt::format("'{}' is no component; it may be {}", text, allowed));
  }
  place.component = static_cast<int>(found - components);
  place.direction_text = text;
}

const Quantity* find(const Quantity* begin, const Quantity* end, const std::string& name) {
  const auto found = std::find_if(begin, end, [&](const Quantity& q) { return name == q.name; });
  return found == end ? nullptr : found;
}

template <std::size_t n>
std::vector<std::string> names_of(const Quantity (&quantities)[n]) {
  std::vector<std::string> names;
  for (const Quantity& quantity : quantities) names.emplace_back(quantity.name);
  return names;
}

std::vector<std::string> names_of_sets(FieldRow::Place place) {
  return names_of(fields_for(FieldRow::histories, place));
}

/// OWNER.QUANTITY[.REST], OWNER one of `owners`, which may hold dots: the longest that fits.
template <std::size_t n>
ChannelPlace owned(const char* group, const std::string& text, const std::vector<std::string>& owners,
                   const Quantity (&quantities)[n], const Asked& asked) {
  ChannelPlace place;
  place.group = group;
  for (const std::string& owner : owners)
    if (owner.size() > place.owner.size() && text.compare(0, owner.size() + 1, owner + '.') == 0) place.owner = owner;
  if (place.owner.empty()) {
    if (owners.empty()) asked.refuse(fmt::format("the run has no {}", group));
    asked.refuse(fmt::format("there is no such {}; {}", group, suggestion(text.substr(0, text.find('.')), owners)));
  }
  auto words = split(text.substr(place.owner.size() + 1), '.');
  place.quantity = words[0];
  const Quantity* quantity = find(std::begin(quantities), std::end(quantities), place.quantity);
  if (!quantity)
    asked.refuse(
        fmt::format("a {} has no '{}'; {}", group, place.quantity, suggestion(place.quantity, names_of(quantities))));
  place.vector = quantity->vector;
  std::string rest = text.substr(std::min(text.size(), place.owner.size() + 1 + place.quantity.size() + 1));
  if (place.group == "beam") {
    const std::string number = rest.substr(0, rest.find('.'));
    const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), place.element);
    if (number.empty() || error != std::errc() || end != number.data() + number.size() || place.element < 0)
      asked.refuse(
          "the number of an element of the beam is wanted after the quantity, counted from 0, e.g. "
          "beam.sleeper.moment.3.y");
    rest = rest.find('.') == std::string::npos ? "" : rest.substr(number.size() + 1);
  }
  if (place.vector)
    set_direction(place, rest, asked);
  else if (!rest.empty())
    asked.refuse(fmt::format("{} is a number, which has no direction '{}'", place.quantity, rest));
  return place;
}

std::vector<std::vector<ChannelPlace>> of_history_sets(const std::string& text, const ChannelNames& names,
                                                       const Asked& asked) {
  // A set's name may hold dots and the direction too: the quantity between them is what is known.
  std::size_t at = std::string::npos, after = 0;
  ChannelPlace place;
  place.group = "set";
  for (const std::string& quantity : names_of(fields_for(FieldRow::histories))) {
    const std::string word = '.' + quantity;
    const std::size_t found = text.rfind(word);
    if (found == std::string::npos || found == 0 ||
        (found + word.size() < text.size() && text[found + word.size()] != '.'))
      continue;
    if (at != std::string::npos && found < at) continue;
    at = found;
    after = std::min(text.size(), found + word.size() + 1);
    place.quantity = quantity;
  }
  if (at == std::string::npos) {
    const auto all = names.all();
    if (all.empty()) asked.refuse("the run wrote no histories");
    // The names are without direction, which what is asked for may have.
    const std::string stem = text.find('.') == std::string::npos ? text : text.substr(0, text.rfind('.'));
    for (const std::string& word : {text, stem})
      if (const std::string near = nearest_name(word, all); !near.empty())
        asked.refuse(fmt::format("there is none of that name; did you mean '{}'?", near));
    asked.refuse("there is none of that name; there are " + names.summary());
  }
  const FieldRow& row = field_named(place.quantity);
  place.vector = row.components == 3;
  place.tensor = row.components == 6;
  if (place.vector)
    set_direction(place, text.substr(after), asked);
  else if (place.tensor)
    set_component(place, text.substr(after), asked);
  else if (after < text.size())
    asked.refuse(fmt::format("{} is a number, which has no direction '{}'", place.quantity, text.substr(after)));

  const auto entries = split(text.substr(0, at), '+');
  std::vector<std::vector<ChannelPlace>> channels;
  auto sets = row.of_nodes() ? names.sets : names.element_sets;
  std::sort(sets.begin(), sets.end(), in_number_order);
  for (const std::string& entry : entries) {
    std::size_t count = 0;
    for (const std::string& set : sets)
      if (matches_pattern(entry.c_str(), set.c_str())) {
        place.owner = set;
        channels.push_back({place});
        ++count;
      }
    if (count == 0)
      asked.refuse(!sets.empty()
                       ? fmt::format("there is no history of a set '{}'{}; {}", entry,
                                     row.of_nodes() ? "" : " with its " + place.quantity, suggestion(entry, sets))
                   : row.of_nodes() ? "the run wrote the history of no set; the case names them in output.history_sets"
                                    : "the run wrote the stress or strain of no set; the case asks for it by "
                                      "[probes] with quantities, or by element sets in output.history_sets");
  }
  if (entries.size() == 1) return channels;
  std::vector<ChannelPlace> all;
  for (const auto& channel : channels) all.push_back(channel.front());
  return {all};
}

}  // namespace

std::string ChannelPlace::name() const {
  if (group == "energy") return "energy." + quantity;
  std::string text = (group == "set" ? "" : group + '.') + owner + '.' + quantity;
  if (group == "beam") text += fmt::format(".{}", element);
  return vector || tensor ? text + '.' + direction_text : text;
}

std::string ChannelPlace::unit() const {
  return unit_of(owner.empty() ? "/history/" + group + '/' + quantity
                               : "/history/" + group + '/' + owner + '/' + quantity);
}

std::vector<std::string> ChannelNames::all() const {
  std::vector<std::string> result;
  const auto add = [&](const std::vector<std::string>& owners, const std::string& prefix,
                       const std::vector<std::string>& quantities, const char* suffix) {
    for (const std::string& owner : owners)
      for (const std::string& quantity : quantities) result.push_back(prefix + owner + '.' + quantity + suffix);
  };
  add(sets, "", names_of_sets(FieldRow::Place::node), "");
  add(element_sets, "", names_of_sets(FieldRow::Place::element), "");
  add(contacts, "contact.", names_of(of_contacts), "");
  add(beams, "beam.", names_of(of_beams), ".0");
  add(loads, "load.", names_of(of_loads), "");
  add(prescribed_motions, "prescribed_motion.", names_of(of_prescribed_motions), "");
  for (const std::string& energy : energies) result.push_back("energy." + energy);
  return result;
}

std::string ChannelNames::summary() const {
  constexpr std::size_t most = 8;
  std::string text;
  const auto add = [&](std::vector<std::string> owners, const char* what, const std::vector<std::string>& quantities) {
    if (owners.empty()) return;
    std::sort(owners.begin(), owners.end(), in_number_order);
    const std::size_t more = owners.size() > most ? owners.size() - most : 0;
    owners.resize(owners.size() - more);
    const std::string form = what + (quantities.size() == 1 ? quantities[0]
                                     : quantities.empty()   ? "NAME"
                                                            : '(' + joined(quantities, "|") + ')');
    text += fmt::format("{}{} of {}{}", text.empty() ? "" : "; ", form, joined(owners),
                        more > 0 ? fmt::format(" and {} more", more) : "");
  };
  add(sets, "SET.", names_of_sets(FieldRow::Place::node));
  add(element_sets, "SET.", names_of_sets(FieldRow::Place::element));
  add(contacts, "contact.NAME.", names_of(of_contacts));
  add(beams, "beam.NAME.", names_of(of_beams));
  add(loads, "load.NAME.", names_of(of_loads));
  add(prescribed_motions, "prescribed_motion.NAME.", names_of(of_prescribed_motions));
  add(energies, "energy.", {});
  return text.empty() ? "none at all" : text;
}

std::vector<std::vector<ChannelPlace>> find_channels(const std::string& text, const ChannelNames& names,
                                                     const std::string& file) {
  const Asked asked{text, file};
  const auto begins = [&](const std::string& word) { return text.compare(0, word.size(), word) == 0; };
  // A part may be called "contact": its sets come first.
  const auto any = [&](const std::vector<std::string>& sets) {
    return std::any_of(sets.begin(), sets.end(), [&](const std::string& name) { return begins(name + '.'); });
  };
  const bool set = any(names.sets) || any(names.element_sets);
  if (!set && begins("contact.")) return {{owned("contact", text.substr(8), names.contacts, of_contacts, asked)}};
  if (!set && begins("beam.")) return {{owned("beam", text.substr(5), names.beams, of_beams, asked)}};
  if (!set && begins("load.")) return {{owned("load", text.substr(5), names.loads, of_loads, asked)}};
  if (!set && begins("prescribed_motion."))
    return {{owned("prescribed_motion", text.substr(18), names.prescribed_motions, of_prescribed_motions, asked)}};
  if (!set && begins("energy.")) {
    ChannelPlace place;
    place.group = "energy";
    place.quantity = text.substr(7);
    if (std::find(names.energies.begin(), names.energies.end(), place.quantity) == names.energies.end())
      asked.refuse(fmt::format("there is no such energy; {}", suggestion(place.quantity, names.energies)));
    return {{place}};
  }
  return of_history_sets(text, names, asked);
}

}  // namespace railwave
