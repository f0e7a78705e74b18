#include <toml++/toml.h>
#include <cmath>
#include <set>
#include <sstream>
#include <stdexcept>

#include "bogie_data.hpp"

namespace railwave::vehicle {
namespace {

/// Reads keys, and knows in the end which were not asked for.
class Reader {
 public:
  Reader(std::string path, const toml::table& table) : path_(std::move(path)), table_(table) {}

  bool has(const std::string& section) const { return table_.contains(section); }

  /// @param least the value must be above it, or at least it where `included`
  double number(const std::string& section, const std::string& key, double least, bool included) {
    const auto value = node(section, key).value<double>();
    if (!value) fail(section, key, "a number is wanted");
    if (!std::isfinite(*value) || (included ? *value < least : *value <= least)) {
      std::ostringstream wanted;
      wanted << *value << " was given, a number " << (included ? "of at least " : "above ") << least << " is wanted";
      fail(section, key, wanted.str());
    }
    return *value;
  }

  Vector vector(const std::string& section, const std::string& key, bool negative) {
    const auto* list = node(section, key).as_array();
    Vector values{};
    bool sound = list != nullptr && list->size() == 3;
    for (std::size_t i = 0; sound && i < 3; ++i) {
      const auto value = list->get(i)->value<double>();
      sound = value && std::isfinite(*value) && (negative || *value >= 0);
      if (sound) values[i] = *value;
    }
    if (!sound)
      fail(section, key, std::string("three numbers [x, y, z]") + (negative ? "" : " of at least 0") + " are wanted");
    return values;
  }

  std::string text(const std::string& section, const std::string& key) {
    const auto value = node(section, key).value<std::string>();
    if (!value || value->empty()) fail(section, key, "a text in quotes is wanted");
    return *value;
  }

  std::array<std::string, 3> three_texts(const std::string& section, const std::string& key) {
    const auto* list = node(section, key).as_array();
    std::array<std::string, 3> texts;
    bool sound = list != nullptr && list->size() == 3;
    for (std::size_t i = 0; sound && i < 3; ++i) {
      const auto value = list->get(i)->value<std::string>();
      sound = value.has_value();
      if (sound) texts[i] = *value;
    }
    if (!sound) fail(section, key, "three texts in quotes are wanted, for x, y and z");
    return texts;
  }

  void refuse_others() const {
    for (const auto& [section, keys] : table_) {
      const std::string name(section.str());
      if (keys.as_table() == nullptr) fail(name, "", "is not known here: keys belong into sections");
      for (const auto& [key, value] : *keys.as_table())
        if (known_.count({name, std::string(key.str())}) == 0)
          fail(name, std::string(key.str()), "is not known; studies/vehicle/bogie.toml has all keys there are");
    }
  }

 private:
  toml::node_view<const toml::node> node(const std::string& section, const std::string& key) {
    known_.insert({section, key});
    const auto found = table_[section][key];
    if (!found) fail(section, key, "is missing");
    return found;
  }

  [[noreturn]] void fail(const std::string& section, const std::string& key, const std::string& what) const {
    throw std::runtime_error(path_ + ": [" + section + "] " + key + (key.empty() ? "" : ": ") + what);
  }

  std::string path_;
  const toml::table& table_;
  std::set<std::pair<std::string, std::string>> known_;
};

toml::table parse(const std::string& path) {
  try {
    return toml::parse_file(path);
  } catch (const toml::parse_error& error) {
    std::ostringstream text;
    text << path << ":" << error.source().begin.line << ": " << error.description();
    throw std::runtime_error(text.str());
  }
}

Suspension read_suspension(Reader& reader, const std::string& section) {
  return {reader.vector(section, "stiffness", false), reader.vector(section, "damping", false)};
}

}  // namespace

BogieData read_bogie(const std::string& path) {
  const toml::table table = parse(path);
  Reader reader(path, table);
  BogieData data;
  data.interface.set = reader.text("interface", "set");
  data.interface.loads = reader.three_texts("interface", "loads");
  data.frame_mass = reader.number("frame", "mass", 0, false);
  data.primary = read_suspension(reader, "primary_suspension");
  if (reader.has("gravity")) data.gravity = reader.number("gravity", "acceleration", 0, true);
  data.has_trailing_wheelset = reader.has("trailing_wheelset");
  if (data.has_trailing_wheelset) {
    data.pitch_inertia = reader.number("frame", "pitch_inertia", 0, false);
    data.wheelbase = reader.number("trailing_wheelset", "wheelbase", 0, false);
    data.trailing_mass = reader.number("trailing_wheelset", "mass", 0, false);
    data.trailing_contact = reader.number("trailing_wheelset", "contact_stiffness", 0, false);
  }
  data.has_car_body = reader.has("car_body");
  if (data.has_car_body) {
    data.car_body_mass = reader.number("car_body", "mass", 0, false);
    data.secondary = read_suspension(reader, "secondary_suspension");
  }
  if (reader.has("start")) {
    data.start_displacement = reader.vector("start", "displacement", true);
    data.start_velocity = reader.vector("start", "velocity", true);
  }
  const bool carried = data.primary.stiffness[2] > 0 && (!data.has_car_body || data.secondary.stiffness[2] > 0);
  if (data.gravity > 0 && !carried)
    throw std::runtime_error(path + ": under gravity the suspensions need a stiffness along z above 0");
  reader.refuse_others();
  return data;
}

}  // namespace railwave::vehicle
