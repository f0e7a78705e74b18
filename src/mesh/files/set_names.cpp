#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <map>
#include <utility>

#include "case/error.hpp"
#include "mesh/files/mesh_file.hpp"
#include "mesh/files/text_file.hpp"

namespace railwave {
namespace {

constexpr std::size_t longest = 100;  // bytes

/// Bytes of the UTF-8 letter that begins at `at`; 0 where there is none.
std::size_t letter_at(const std::string& text, std::size_t at) {
  const auto byte = [&](std::size_t i) { return i < text.size() ? static_cast<unsigned char>(text[i]) : 0U; };
  const unsigned first = byte(at);
  if (first < 0x80) return 1;
  const std::size_t length = first >= 0xc2 && first <= 0xdf   ? 2
                             : (first & 0xf0U) == 0xe0        ? 3
                             : first >= 0xf0 && first <= 0xf4 ? 4
                                                              : 0;
  for (std::size_t i = 1; i < length; ++i)
    if ((byte(at + i) & 0xc0U) != 0x80) return 0;
  // Overlong letters and halves of UTF-16 pairs are none.
  if ((first == 0xe0 && byte(at + 1) < 0xa0) || (first == 0xed && byte(at + 1) > 0x9f) ||
      (first == 0xf0 && byte(at + 1) < 0x90) || (first == 0xf4 && byte(at + 1) > 0x8f))
    return 0;
  return length;
}

template <class Set>
void fit(std::map<std::string, Set>& sets, const char* kind, const std::string& path, std::vector<std::string>* notes) {
  std::map<std::string, Set> fitted;
  for (auto& [name, set] : sets) {
    const std::string fit = fit_set_name(name);
    if (fit != name && notes)
      notes->push_back(fmt::format("{}: {} '{}' is called '{}' here", path, kind, for_message(name), fit));
    if (fitted.count(fit) != 0 || (fit != name && sets.count(fit) != 0))
      throw InputError(
          fmt::format("{}: {} '{}' can only be called '{}' here, for its name has characters that paths of results "
                      "cannot have, and another has that name; "
                      "rename one of them",
                      path, kind, for_message(name), fit));
    fitted.emplace(fit, std::move(set));
  }
  sets = std::move(fitted);
}

}  // namespace

bool is_utf8(const std::string& text) {
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t letter = letter_at(text, at);
    if (letter == 0) return false;
    at += letter;
  }
  return true;
}

std::string fit_set_name(const std::string& name) {
  std::string fit;
  for (std::size_t at = 0; at < name.size();) {
    const std::size_t letter = letter_at(name, at);
    const auto first = static_cast<unsigned char>(name[at]);
    const bool replaced =
        letter == 0 || first < 0x20 || first == 0x7f || std::strchr("/\\:,;*?\"'<>&", name[at]) != nullptr;
    if (fit.size() + (replaced ? 1 : letter) > longest) break;
    if (replaced)
      fit += '_';
    else
      fit += name.substr(at, letter);
    at += letter == 0 ? 1 : letter;
  }
  fit = std::string(trim(fit));
  return fit.find_first_not_of('.') == std::string::npos ? "unnamed" : fit;
}

void fit_set_names(Mesh& mesh, const std::string& path, std::vector<std::string>* notes) {
  // A surface has a node set of the same name: each note is given once.
  std::vector<std::string> all;
  fit(mesh.node_sets, "set", path, &all);
  fit(mesh.element_sets, "set", path, &all);
  fit(mesh.surfaces, "set", path, &all);
  if (!notes) return;
  for (const std::string& note : all)
    if (std::find(notes->begin(), notes->end(), note) == notes->end()) notes->push_back(note);
}

}  // namespace railwave
