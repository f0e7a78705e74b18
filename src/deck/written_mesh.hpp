#pragma once

#include <map>
#include <string>
#include <vector>

#include "deck/bodies.hpp"

namespace railwave::deck {

/// The mesh file of an imported deck, in Abaqus' format: the deck's own numbers and unit of length, and the sets that
/// the case names. Nodes and elements are positions in the deck's mesh.
class WrittenMesh {
 public:
  WrittenMesh(const Deck& deck, const Bodies& bodies) : deck_(deck), bodies_(bodies) {}

  /// Nodes of one body as a set; @return "body.set". Nodes that it shares with another body count for one of them.
  std::string node_set(int body, std::vector<int> nodes, const std::string& name);
  std::string element_set(int body, std::vector<int> elements, const std::string& name);
  std::string surface(int body, std::vector<Face> faces, const std::string& name);

  /// The file's text.
  /// @param first_line without "** "
  std::string text(const std::string& first_line) const;

 private:
  template <class Set>
  std::string keep(std::map<std::string, Set>& sets, int body, Set set, const std::string& name);

  const Deck& deck_;
  const Bodies& bodies_;
  std::map<std::string, std::vector<int>> node_sets_, element_sets_;
  std::map<std::string, std::vector<Face>> surfaces_;
};

}  // namespace railwave::deck
