#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "case/document.hpp"

namespace railwave::case_file {
namespace {

/// * stands for any name.
constexpr std::array<const char*, 19> without = {".title",
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

/// @param place where the node stands, as written; @param pattern the same with * for the names of entries
void add_lines(const Node& node, const std::string& place, const std::string& pattern, int depth, std::string& text) {
  if (std::find(without.begin(), without.end(), pattern) != without.end()) return;
  if (node.type != Node::Type::table) {
    text += place + " = " + value_text(node) + "\n";
    return;
  }
  for (const Node& child : node.children) {
    const bool entry = depth == 1 && child.type == Node::Type::table;
    add_lines(child, place + "." + child.name, pattern + "." + (entry ? "*" : child.name), depth + 1, text);
  }
}

}  // namespace

std::string static_text(const Node& root) {
  std::string text;
  add_lines(root, "", "", 0, text);
  return text;
}

}  // namespace railwave::case_file
