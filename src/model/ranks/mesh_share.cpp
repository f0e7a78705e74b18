#include "model/ranks/mesh_share.hpp"

#include "kernels/support/set_zero.hpp"
#include "model/host_copy.hpp"

namespace railwave {
namespace {

/// Lets go of the values that are not wanted.
template <class T>
void keep(std::vector<T>& values, const std::vector<char>& wanted) {
  for (std::size_t begin = 0, end = 0; begin < values.size(); begin = end) {
    while (end < values.size() && wanted[end] == wanted[begin]) ++end;
    if (wanted[begin] == 0) give_pages_back(values.data() + begin, sizeof(T) * (end - begin));
  }
}

/// Calls act(group, block, place of its first element in a piece) for each of a rank's blocks.
template <class Act>
void each_block(const Model& model, const ShareItems& items, const Act& act) {
  std::size_t place = 0;
  for (std::size_t g = 0; g < model.elements.size(); ++g)
    for (int p : items.blocks[g]) {
      act(model.elements[g], p, place);
      place += model.elements[g].element_count[p];
    }
}

}  // namespace

void keep_mesh_of_blocks(Model& model, int rank) {
  std::vector<char> elements(model.assembly.elements.size(), 0);
  for (int e : elements_of_rank(model, rank)) elements[e] = 1;
  keep(model.assembly.elements, elements);
  keep(model.assembly.nodes, nodes_of_rank(model, rank));
  model.whole_mesh = false;
}

void forget_mesh_of_blocks(Model& model) {
  std::vector<char> nodes(model.assembly.nodes.size(), 0);
  for (int n : nodes_of_no_block(model)) nodes[n] = 1;
  keep(model.assembly.elements, std::vector<char>(model.assembly.elements.size(), 0));
  keep(model.assembly.nodes, nodes);
  model.whole_mesh = false;
}

MeshPiece empty_piece(const Model& model, const ShareItems& items) {
  std::size_t elements = 0;
  each_block(model, items,
             [&](const ElementGroup& group, int p, std::size_t /*place*/) { elements += group.element_count[p]; });
  MeshPiece piece;
  piece.elements.resize(elements);
  piece.nodes.resize(items.nodes.size());
  return piece;
}

MeshPiece piece_of_arrays(const Model& model, const ShareItems& items) {
  MeshPiece piece = empty_piece(model, items);
  const int lanes = model.in_single ? lane_count<float> : lane_count<double>;
  each_block(model, items, [&](const ElementGroup& group, int p, std::size_t place) {
    const auto corner = to_host(group.blocks.corner);
    const auto node = to_host(group.blocks.node);
    const std::size_t base = 8 * static_cast<std::size_t>(p) * elements_of_block;
    for (int slot = 0; slot < group.element_count[p]; ++slot)
      for (int N = 0; N < 8; ++N) {
        const int local = corner(base + (static_cast<std::size_t>(slot / lanes) * 8 + N) * lanes + slot % lanes);
        piece.elements[place + slot][N] =
            node(static_cast<std::size_t>(p) * group.blocks.node_stride + local) & ~advance_bit;
      }
  });
  const auto reference = to_host(model.nodes.reference);
  for (std::size_t k = 0; k < items.nodes.size(); ++k)
    for (int i = 0; i < 3; ++i) piece.nodes[k][i] = reference(items.nodes[k], i);
  return piece;
}

void put_back(const MeshPiece& piece, const ShareItems& items, Model& model) {
  each_block(model, items, [&](const ElementGroup& group, int p, std::size_t place) {
    for (int e = 0; e < group.element_count[p]; ++e)
      model.assembly.elements[group.first_element[p] + e] = piece.elements[place + e];
  });
  for (std::size_t k = 0; k < items.nodes.size(); ++k) model.assembly.nodes[items.nodes[k]] = piece.nodes[k];
}

}  // namespace railwave
