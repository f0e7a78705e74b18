#pragma once

#include <string>
#include <vector>

namespace railwave {

// Files that the program needs beside itself: the page of reports, the scripts that draw. Users have them in
// PREFIX/share/railwave, developers in their checkout.

/// A file that an installed program brings along: PREFIX/share/railwave/NAME, the program being PREFIX/bin/railwave.
/// It follows the program, so an installation may be moved or unpacked anywhere. Empty where the program's own place
/// cannot be read (no /proc). Whether the file is there is not looked at.
/// @param name below share/railwave, such as "report.html"
std::string installed_file(const std::string& name);

/// Where such a file may be, in the order in which it is looked for: installed_file(name), then `in_source`, its place
/// in the source tree, unless that is empty (packages are built without: RAILWAVE_SOURCE_PLACES).
std::vector<std::string> places_of(const std::string& name, const std::string& in_source);

/// The first of these that exists; empty if none does. Places that may not be looked at count as absent.
/// @param places paths, the most wanted first
std::string first_present(const std::vector<std::string>& places);

/// How a user at this program calls a drawing script: "railwave-picture" for an installed program, else
/// "scripts/picture". Next steps and notes of the program say it.
/// @param script name of a file of scripts/, such as "picture"
std::string script_command(const std::string& script);

}  // namespace railwave
