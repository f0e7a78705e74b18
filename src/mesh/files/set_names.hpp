#pragma once

#include <string>
#include <vector>

#include "mesh/mesh.hpp"

namespace railwave {

/// A set's name as a case and its results can have it. In place of what separates paths, columns, channels or
/// attributes there
/// ('/', '\\', ':', ',', ';', '*', '?', quotes, '<', '>', '&', control characters, bytes that are no UTF-8) stands '_';
/// blanks at the ends are dropped, a name of nothing or dots alone becomes 'unnamed', and no name has more than 100
/// bytes.
std::string fit_set_name(const std::string& name);

/// Gives all sets of a mesh read from a file such names; `notes`, when given, receives a line for each that was
/// changed. Throws InputError where two sets would have one name.
void fit_set_names(Mesh& mesh, const std::string& path, std::vector<std::string>* notes);

}  // namespace railwave
