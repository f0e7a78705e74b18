#pragma once

#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "case/scene.hpp"
#include "case/value.hpp"

/// How one key, and one section, of the case file is described. The descriptions themselves are in keys.hpp.
namespace railwave::case_file {

/// Allowed numbers: from `low` to `high`; the ends themselves excluded where open. Holds for each component of a
/// vector.
struct Range {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool low_open = false, high_open = false;

  bool has(double number) const {
    return (low_open ? number > low : number >= low) && (high_open ? number < high : number <= high);
  }
  bool limited() const {
    return low > -std::numeric_limits<double>::max() || high < std::numeric_limits<double>::max();
  }
};

inline Range above(double low) { return {low, std::numeric_limits<double>::infinity(), true, false}; }
inline Range at_least(double low) { return {low, std::numeric_limits<double>::infinity(), false, false}; }
inline Range between(double low, double high) { return {low, high, false, false}; }
inline Range inside(double low, double high) { return {low, high, true, true}; }
inline Range above_up_to(double low, double high) { return {low, high, true, false}; }

/// What a name given as a value may refer to; several can be joined by |.
enum Reference : unsigned {
  refers_to_nothing = 0,
  material = 1u << 0,
  mesh = 1u << 1,
  curve = 1u << 2,
  whole_part = 1u << 3,
  point = 1u << 4,
  ground = 1u << 5,
  node_set = 1u << 6,     ///< `part.set`
  surface = 1u << 7,      ///< `part.set`
  element_set = 1u << 8,  ///< `part.set`
  sleeper = 1u << 9,
  any_set = node_set | surface | element_set,
};

/// What the two numbers of a pair are, for keys that take a list of pairs: "time in s" and "factor".
struct PairOf {
  std::string first = "time in s", second = "value";
  Range first_range, second_range;
};

struct Key {
  std::string name;
  std::string help;
  Kind kind = Kind::absent;
  std::function<void(void* entry, const Value&)> store;
  std::function<Value()> initial;  ///< the default: the value in an entry as scene.hpp makes it

  std::string unit;
  Range range;
  std::optional<Range> usual;  ///< what the field has; what lies outside is warned of. Absent: by unit (plausible.hpp)
  bool any_size = false;       ///< as large as one likes: limits of the monitor, which a huge number switches off
  PairOf pair;                 ///< of a list of pairs
  bool required = false;
  bool is_path = false;       ///< a file, relative to the case file's folder; must exist
  bool is_direction = false;  ///< any length but zero; stored with length 1
  std::string default_text;   ///< said instead of the default value
  std::vector<std::string> choices;
  std::vector<std::string> types;  ///< the section's `type`s that have this key; empty: all
  unsigned refers_to = refers_to_nothing;
  bool may_be_one = false;  ///< of a list: one text alone stands for a list of it

  Key in(std::string the_unit) && { return unit = std::move(the_unit), std::move(*this); }
  Key within(Range allowed) && { return range = allowed, std::move(*this); }
  Key mostly(Range expected) && { return usual = expected, std::move(*this); }
  Key unlimited() && { return any_size = true, std::move(*this); }
  Key pairs_of(PairOf what) && { return pair = std::move(what), std::move(*this); }
  Key needed() && { return required = true, std::move(*this); }
  Key path() && { return is_path = true, std::move(*this); }
  Key direction() && { return is_direction = true, std::move(*this); }
  Key otherwise(std::string said) && { return default_text = std::move(said), std::move(*this); }
  Key one_of(std::vector<std::string> allowed) && { return choices = std::move(allowed), std::move(*this); }
  Key only(std::vector<std::string> of_types) && { return types = std::move(of_types), std::move(*this); }
  Key names(unsigned references) && { return refers_to = references, std::move(*this); }
  Key or_one() && { return may_be_one = true, std::move(*this); }

  bool belongs_to(const std::string& type) const {
    if (types.empty()) return true;
    for (const auto& one : types) {
      if (one == type) return true;
    }
    return false;
  }
};

namespace detail {

template <class T>
struct AsValue {  // enums
  static_assert(std::is_enum_v<T>, "a key's field needs a type that Value holds");
  static constexpr Kind kind = Kind::choice;
  static T from(const Value& value) { return static_cast<T>(std::get<Choice>(value).position); }
  static Value to(T field) { return Choice{static_cast<int>(field)}; }
};

template <class T, Kind the_kind>
struct Same {
  static constexpr Kind kind = the_kind;
  static T from(const Value& value) { return std::get<T>(value); }
  static Value to(const T& field) { return field; }
};

template <>
struct AsValue<bool> : Same<bool, Kind::boolean> {};
template <>
struct AsValue<int> : Same<int, Kind::integer> {};
template <>
struct AsValue<double> : Same<double, Kind::number> {};
template <>
struct AsValue<std::string> : Same<std::string, Kind::text> {};
template <>
struct AsValue<Numbers3> : Same<Numbers3, Kind::vector> {};
template <>
struct AsValue<Integers3> : Same<Integers3, Kind::integer_vector> {};
template <>
struct AsValue<Axes> : Same<Axes, Kind::axes> {};
template <>
struct AsValue<Flags3> : Same<Flags3, Kind::directions> {};
template <>
struct AsValue<Texts> : Same<Texts, Kind::texts> {};
template <>
struct AsValue<scene::SurfaceNames> {
  static constexpr Kind kind = Kind::texts;
  static scene::SurfaceNames from(const Value& value) { return scene::SurfaceNames(std::get<Texts>(value)); }
  static Value to(const scene::SurfaceNames& field) { return field.list(); }
};
template <>
struct AsValue<Pairs> : Same<Pairs, Kind::pairs> {};
template <>
struct AsValue<Numbers> : Same<Numbers, Kind::numbers> {};
template <>
struct AsValue<Integers2> : Same<Integers2, Kind::integer_pair> {};
template <>
struct AsValue<Corners> : Same<Corners, Kind::box> {};

template <class T>
struct AsValue<std::optional<T>> {
  static constexpr Kind kind = AsValue<T>::kind;
  static std::optional<T> from(const Value& value) { return AsValue<T>::from(value); }
  static Value to(const std::optional<T>& field) { return field ? AsValue<T>::to(*field) : Value{}; }
};

}  // namespace detail

/// A key stored in a field of the section's entry; the field's type decides the kind of value.
template <class Entry, class T>
Key key(std::string name, T Entry::*field, std::string help) {
  Key result;
  result.name = std::move(name);
  result.help = std::move(help);
  result.kind = detail::AsValue<T>::kind;
  result.store = [field](void* entry, const Value& value) {
    static_cast<Entry*>(entry)->*field = detail::AsValue<T>::from(value);
  };
  result.initial = [field] { return detail::AsValue<T>::to(Entry{}.*field); };
  return result;
}

/// The same for a field of a struct inside the entry, such as WheelMesh in MeshSource.
template <class Entry, class Inner, class Base, class T>
Key key(std::string name, Inner Entry::*inner, T Base::*field, std::string help) {
  static_assert(std::is_base_of_v<Base, Inner>);
  auto result = key<Inner, T>(std::move(name), field, std::move(help));
  result.store = [inner, field](void* entry, const Value& value) {
    static_cast<Entry*>(entry)->*inner.*field = detail::AsValue<T>::from(value);
  };
  return result;
}

class EntryCheck;

/// A section of the case file: one table ([time]), many named ones ([parts.NAME]), or the keys above all sections (name
/// "").
struct Section {
  std::string name;
  std::string help;
  std::string singular;     ///< of a named one: "part"
  std::string former_name;  ///< of earlier versions: accepted with a warning; empty: none
  bool required = false;
  std::vector<Key> keys;
  std::function<void*(scene::Scene&, const scene::Place&)> open;  ///< makes (named) or finds the entry to fill
  std::function<void(void*, EntryCheck&)> rule;                   ///< what no single key can check; may be empty

  /// Adds keys that only entries of this `type` have.
  void add_keys(const std::string& type, const std::vector<Key>& of_type) {
    for (auto one : of_type) keys.push_back(std::move(one).only({type}));
  }

  bool named() const { return !singular.empty(); }
  std::string title() const { return name.empty() ? "" : named() ? "[" + name + ".NAME]" : "[" + name + "]"; }

  /// The key of that name in an entry of that type, or null.
  const Key* find(const std::string& key_name, const std::string& type) const {
    for (const auto& one : keys) {
      if (one.name == key_name && one.belongs_to(type)) return &one;
    }
    return nullptr;
  }
  /// The key `type` with its choices, or null when all entries of the section have the same keys.
  const Key* type_key() const { return find("type", ""); }
};

/// [name.NAME], one entry of the list for each.
template <class Entry>
Section named_section(std::string name, std::string singular, std::vector<Entry> scene::Scene::*list,
                      std::string help) {
  Section section;
  section.name = std::move(name);
  section.singular = std::move(singular);
  section.help = std::move(help);
  section.open = [list](scene::Scene& scene, const scene::Place& place) -> void* {
    auto& entry = (scene.*list).emplace_back();
    static_cast<scene::Place&>(entry) = place;
    return &entry;
  };
  return section;
}

/// [name], stored in a member of the scene.
template <class Entry>
Section single_section(std::string name, Entry scene::Scene::*member, std::string help) {
  Section section;
  section.name = std::move(name);
  section.help = std::move(help);
  section.open = [member](scene::Scene& scene, const scene::Place&) -> void* { return &(scene.*member); };
  return section;
}

}  // namespace railwave::case_file
