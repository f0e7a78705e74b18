#include "case/read_entry.hpp"

#include <algorithm>
#include <filesystem>
#include <set>

#include "case/keys.hpp"
#include "case/read_value.hpp"
#include "case/rules.hpp"
#include "case/suggest.hpp"

namespace railwave::case_file {
namespace {

namespace fs = std::filesystem;

/// One table being read; also what its section's rule sees of it.
class EntryReader : public EntryCheck {
 public:
  EntryReader(const Section& section, const Node& table, const std::string& subject, Reading& reading)
      : section_(section), table_(table), subject_(subject), reading_(reading) {}

  void read(void* entry) {
    find_type();
    for (const auto& node : table_.children) {
      if (section_.name.empty() && is_section(node)) continue;
      read_key(node, entry);
    }
    find_missing();
    if (section_.rule) section_.rule(entry, *this);
  }

  bool given(const std::string& key) const override { return table_.find(key) != nullptr; }

  bool sound(std::initializer_list<std::string> keys) const override {
    return std::none_of(keys.begin(), keys.end(), [&](const std::string& key) { return unsound_.count(key) != 0; });
  }

  void remark(const std::string& key, const std::string& text) override {
    const auto* node = table_.find(key);
    reading_.remarks.add(node ? node->where : table_.where, subject_of(key) + ": " + text);
  }

  void complain(const std::string& key, const std::string& text) override {
    const auto* node = table_.find(key);
    complain_at(node ? node->where : table_.where, key, text);
  }

 private:
  void complain_at(Where where, const std::string& key, const std::string& text) {
    unsound_.insert(key);
    reading_.complaints.add(where, subject_of(key) + ": " + text);
  }

  std::string subject_of(const std::string& key) const {
    return (subject_.empty() ? "" : subject_ + " ") + printable(key);
  }

  void find_type() {
    const auto* key = section_.type_key();
    if (!key) return;
    const auto* node = table_.find("type");
    const bool known = node && node->type == Node::Type::text &&
                       std::find(key->choices.begin(), key->choices.end(), node->text) != key->choices.end();
    type_known_ = known;
    if (known) type_ = node->text;
  }

  void read_key(const Node& node, void* entry) {
    const auto* key = section_.find(node.name, type_);
    const bool for_some_type = !type_known_ && contains(key_names(section_), node.name);
    if (!key && for_some_type) return;
    if (!key && node.type == Node::Type::table) {
      const auto own = subject_.empty() ? std::string("the sections") : subject_;
      return complain_at(node.where, node.name,
                         "is a section inside " + own + ", which has none; its keys stand under " + own + " itself");
    }
    if (!key) return complain_at(node.where, node.name, unknown(node.name));
    const Complain complain = [&](Where where, const std::string& text) { complain_at(where, key->name, text); };
    const Complain remark = [&](Where where, const std::string& text) {
      reading_.remarks.add(where, subject_of(key->name) + ": " + text);
    };
    auto value = read_value(*key, node, complain, remark);
    if (!value) {
      unsound_.insert(key->name);
      return;
    }
    if (key->is_path) join_path(*key, node, *value);
    note_names(*key, node);
    key->store(entry, *value);
  }

  static bool contains(const std::vector<std::string>& names, const std::string& name) {
    return std::find(names.begin(), names.end(), name) != names.end();
  }

  std::string unknown(const std::string& name) {
    for (const auto& key : section_.keys) {
      if (key.name == name) return "does not belong to type '" + type_ + "', only to " + alternatives(key.types);
    }
    const auto names = key_names(section_, type_);
    const auto near = nearest_name(name, names);
    if (!near.empty()) {
      meant_.insert(near);
      return "unknown key; did you mean '" + near + "'?";
    }
    std::vector<std::string> owners;
    for (const auto& other : sections()) {
      if (contains(key_names(other), name))
        owners.push_back(other.name.empty() ? "the top of the file, above all sections" : other.title());
    }
    if (!owners.empty())
      return "unknown key here; it belongs to " + joined(owners, " or ") + "; known here are: " + joined(names);
    return "unknown key; known are: " + joined(names);
  }

  void join_path(const Key& key, const Node& node, Value& value) {
    fs::path path = std::get<std::string>(value);
    if (path.is_relative()) path = fs::path(reading_.folder) / path;
    value = path.lexically_normal().string();
    std::error_code failed;
    const auto status = fs::status(path, failed);
    const auto shown = "'" + printable(path.lexically_normal().string()) + "'";
    if (!fs::exists(status))
      return complain_at(node.where, key.name,
                         "there is no file " + shown + "; paths are relative to the case file's folder");
    if (fs::is_directory(status)) return complain_at(node.where, key.name, shown + " is a folder, must be a file");
  }

  void note_names(const Key& key, const Node& node) {
    if (key.refers_to == refers_to_nothing) return;
    const auto use = [&](const Node& one) {
      if (!one.text.empty() || key.required)
        reading_.names.push_back({one.where, subject_of(key.name), key.refers_to, one.text});
    };
    if (node.type == Node::Type::text) use(node);
    for (const auto& child : node.children) use(child);
  }

  void find_missing() {
    for (const auto& key : section_.keys) {
      const bool applies = key.types.empty() || (type_known_ && key.belongs_to(type_));
      if (!key.required || !applies || given(key.name)) continue;
      unsound_.insert(key.name);
      if (!reading_.complete || meant_.count(key.name) != 0) continue;
      const auto range = range_text(key.range);
      const bool name = key.refers_to != refers_to_nothing && (key.kind == Kind::text || key.may_be_one);
      complain(key.name, "is missing; must " +
                             (name ? "name " + reference_text(key.refers_to) : "be " + expectation(key)) +
                             (range.empty() ? "" : ", " + range));
    }
  }

  const Section& section_;
  const Node& table_;
  const std::string& subject_;
  Reading& reading_;
  std::string type_;
  bool type_known_ = true;
  std::set<std::string> unsound_;
  std::set<std::string> meant_;  ///< known keys that unknown ones were probably meant to be
};

}  // namespace

bool is_section(const Node& node) {
  const bool tables =
      node.type == Node::Type::list && !node.children.empty() && node.children[0].type == Node::Type::table;
  return node.type == Node::Type::table || tables || (!node.name.empty() && find_section(node.name));
}

void read_entry(const Section& section, const Node& table, void* entry, const std::string& subject, Reading& reading) {
  EntryReader(section, table, subject, reading).read(entry);
}

}  // namespace railwave::case_file
