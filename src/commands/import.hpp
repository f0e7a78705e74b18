#pragma once

#include <CLI/CLI.hpp>

#include <functional>
#include <iosfwd>
#include <string>
#include <vector>

namespace railwave {

/// What `railwave import` is asked for.
struct ImportRequest {
  std::string deck;
  std::string out;  ///< case file; empty: the deck's name with .toml, in this folder
  std::string units;
  std::vector<std::string> drop;
  bool overwrite = false;
};

/// Adds `railwave import DECK`, which fills the request and calls `run`.
void add_import_command(CLI::App& app, ImportRequest& request, const std::function<void()>& run);

/// Makes a mesh file, a report and a case file of an LS-DYNA keyword deck, and says what there is to say. The case is
/// written last: where there is one, the others are whole.
/// @throws InputError if the deck can't be taken, or a file must not be written; nothing has been written then.
/// std::runtime_error if the system refuses
void import_command(const ImportRequest& request, std::ostream& out);

}  // namespace railwave
