#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "case/document.hpp"

namespace railwave::case_file {
namespace {

/// * stands for any name.
constexpr std::array<const char*, 20> without = {".title",
                                                 ".time",
                                                 ".checkpoint",
                                                 ".monitor",
                                                 ".output",
                                                 ".output_windows",
                                                 ".solver.step_estimate",
                                                 ".solver.subcycling",
                                                 ".solver.renew_steps",
                                                 ".settle.active",
                                                 ".settle.max_steps",
                                                 ".settle.cache",
                                                 ".settle.cache_folder",
                                                 ".settle.keep_unsettled",
                                                 ".initial_motion.*.velocity",
                                                 ".prescribed_motion.*.velocity",
                                                 ".prescribed_motion.*.displacement",
                                                 ".probes",
                                                 ".element_sets",
                                                 ".absorbing_layers"};

std::string value_text(const Node& node) {
  switch (node.type) {
    case Node::Type::text:
      return '"' + node.text + '"';
    case Node::Type::boolean:
      return node.boolean ? "true" : "false";
    case Node::Type::integer:
    case Node::Type::number:
      return fmt::format("{:.17g}", node.number);  // 1 and 1.0 are the same
    case Node::Type::list: {
      std::string text = "[";
      for (const Node& child : node.children) text += value_text(child) + ",";
      return text + "]";
    }
    default:
      return node.text;
  }
}

/// The angular velocity of what rolls follows from its velocity, and its centrifugal forces are there at rest.
bool rolls(const std::string& pattern, const Node& entry) {
  const Node* rolling = pattern == ".initial_motion.*" ? entry.find("rolling") : nullptr;
  return rolling != nullptr && rolling->boolean;
}

/// @param place where the node stands, as written; @param pattern the same with * for the names of entries
void add_lines(const Node& node, const std::string& place, const std::string& pattern, int depth, bool all,
               std::string& text) {
  if (!all && std::find(without.begin(), without.end(), pattern) != without.end()) return;
  if (node.type != Node::Type::table) {
    text += place + " = " + value_text(node) + "\n";
    return;
  }
  for (const Node& child : node.children) {
    const bool entry = depth == 1 && child.type == Node::Type::table;
    // Under a pattern of its own the velocity counts.
    const std::string name = entry ? "*" : rolls(pattern, node) ? child.name + " that rolls" : child.name;
    add_lines(child, place + "." + child.name, pattern + "." + name, depth + 1, all, text);
  }
}

}  // namespace

std::string static_text(const Node& root) {
  std::string text;
  add_lines(root, "", "", 0, false, text);
  return text;
}

std::string whole_text(const Node& root) {
  std::string text;
  add_lines(root, "", "", 0, true, text);
  return text;
}

}  // namespace railwave::case_file
