#pragma once

#include <vector>

#include "model/assembled_scene.hpp"
#include "model/contact/contact_springs.hpp"
#include "model/nodal_state.hpp"
#include "model/ranks/transport.hpp"
#include "model/time_step/tangent_operator.hpp"

namespace railwave {

/// All elements around a range of nodes, in order, with numbers of their own for their nodes: the range's come first,
/// then `others`. Whoever has them adds forces on the range's nodes in the order in which the whole mesh does.
struct ElementsAround {
  std::vector<CornerNodes> elements;
  std::vector<Assembly::PartRange> parts;  ///< those of the whole mesh, with their ranges of `elements`
  std::vector<int> others;                 ///< numbers in the whole mesh of the elements' other nodes, ascending
};
/// @param begin, end of the nodes
ElementsAround elements_around(const Assembly& whole, int begin, int end);

/// A rank's share of a search for the highest frequency of a scene's elements (global_step.hpp). Each rank has a range
/// of nodes with all elements around them, so that forces on its nodes are added in the order of one process. It brings
/// the displacements of the other nodes of these elements from the ranks that have them. Inner products are added in
/// blocks that do not depend on the number of ranks. So the step is bit for bit that of one process.
class EstimateShare {
 public:
  /// Whether the elements' search can be shared: on processors, and where no ties move nodes along.
  static bool possible(const scene::Scene& scene);
  /// The part of the nodes that a rank takes.
  static double part_of(int rank, int ranks);

  /// @param nodal masses and constraints of all nodes
  EstimateShare(const AssembledScene& assembled, const NodalState& nodal, Transport& transport);

  /// The rank's nodes and elements as a scene of their own: first its nodes, in order, then others of its elements.
  /// Without masses, which nodal() has.
  const AssembledScene& assembled() const { return assembled_; }
  const NodalState& nodal() const { return nodal_; }
  /// One more than the number of the scene's last node, counted from the first of the rank's nodes.
  int end_of_scene() const { return ranges_.back() - first_node(); }

  /// Springs of contacts on the rank's nodes.
  ContactOnNodes own_part(const ContactOnNodes& whole) const;

  /// Elements and nodes of assembled() are not needed once there is a GlobalEstimate of them.
  void forget_mesh();

  /// The rows of nodes of other ranks, from these.
  void bring(const NodeVector& rows) const;

  /// a . b over all nodes of the scene.
  double sum(const NodeVector& a, const NodeVector& b) const;

 private:
  /// Nodes in common with another rank.
  struct Neighbour {
    int rank;
    std::vector<int> sent;  ///< rows of own nodes that it needs
    int first_received, received_count;
  };

  /// Number in the whole scene of the first of the rank's nodes.
  int first_node() const { return ranges_[transport_.rank()]; }
  int own_count() const { return ranges_[transport_.rank() + 1] - first_node(); }
  void find_neighbours(const ElementsAround& around);
  void take_nodes(const AssembledScene& whole, const NodalState& nodal, const std::vector<int>& others);

  Transport& transport_;
  std::vector<int> ranges_;  ///< first node of each rank, and their number at the end
  AssembledScene assembled_;
  NodalState nodal_;
  std::vector<Neighbour> neighbours_;
  mutable std::vector<double> packed_, sums_;
};

}  // namespace railwave
