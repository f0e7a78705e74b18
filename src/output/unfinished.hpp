#pragma once

#include <string>

/// Files that have not got their names yet (PATH.new): taken away when the program is ended by a signal, or by a
/// library.
namespace railwave {

void note_unfinished(const std::string& path);
void forget_unfinished(const std::string& path);

/// Removes those that were noted and not forgotten. May be called from a signal's handler.
void remove_unfinished() noexcept;

}  // namespace railwave
