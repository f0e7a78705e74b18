#include "kernels/support/packed_rows.hpp"
#include "model/host_copy.hpp"
#include "solve/ranks/rank_team.hpp"

namespace railwave {
namespace {

/// Rows of a group's blocks among the partial forces.
std::vector<int> rows_of(const ElementGroup& group, const std::vector<int>& blocks) {
  std::vector<int> rows;
  const auto add = [&](int first) {
    for (int p : blocks)
      for (int l = 0; l < group.blocks.node_stride; ++l) rows.push_back(first + p * group.blocks.node_stride + l);
  };
  add(group.first_partial);
  if (group.damping.active()) add(group.damping.first_partial);
  return rows;
}

template <bool Sending>
class Transfer {
 public:
  Transfer(Transport& transport, int other) : transport_(transport), other_(other) {}

  /// @param width values at each place
  template <class T>
  void values(const Array<T*>& array, const std::vector<int>& places, int width) const {
    if (array.extent(0) == 0 || places.empty()) return;
    const auto packed = unset_array<T*>("packed", places.size() * width);
    transfer_all(packed, packed.extent(0), PackedValues<T, Sending>{array, to_device("places", places), width, packed});
  }

  template <class T, int N>
  void rows(const Array<T* [N]>& array, const std::vector<int>& places) const {
    if (array.extent(0) == 0 || places.empty()) return;
    const auto packed = unset_array<T*>("packed", places.size() * N);
    transfer_all(packed, places.size(), PackedRows<T, N, Sending>{array, to_device("places", places), packed});
  }

 private:
  template <class T, class Kernel>
  void transfer_all(const Array<T*>& packed, std::size_t calls, const Kernel& kernel) const {
    const auto host = Kokkos::create_mirror_view(packed);
    const Range range(0, static_cast<int>(calls));
    const std::size_t bytes = sizeof(T) * packed.extent(0);
    if constexpr (Sending) {
      Kokkos::parallel_for("pack", range, kernel);
      Kokkos::deep_copy(host, packed);
      transport_.start_send(other_, host.data(), bytes);
      transport_.finish();
    } else {
      transport_.start_receive(other_, host.data(), bytes);
      transport_.finish();
      Kokkos::deep_copy(packed, host);
      Kokkos::parallel_for("unpack", range, kernel);
      ExecutionSpace().fence();
    }
  }

  Transport& transport_;
  int other_;
};

template <bool Sending>
void transfer_all(Model& model, const ShareItems& items, const Transfer<Sending>& transfer) {
  transfer.template rows<double, 3>(model.nodes.position, items.nodes);
  transfer.template rows<double, 3>(model.nodes.velocity, items.nodes);
  for (std::size_t g = 0; g < model.elements.size(); ++g) {
    ElementGroup& group = model.elements[g];
    const std::vector<int>& blocks = items.blocks[g];
    transfer.template rows<double, BlockFrame::values>(group.blocks.frame, blocks);
    transfer.values(group.blocks.hourglass_energy, blocks, power_sums);
    transfer.values(group.material.history, blocks, elements_of_block * group.material.history_values);
    transfer.values(group.damping.energy, blocks, 1);
    const std::vector<int> rows = rows_of(group, blocks);
    transfer.values(model.partial.in_double, rows, 1);
    transfer.values(model.partial.in_single, rows, 1);
  }
}

}  // namespace

void StateTransfer::send(int to, const ShareItems& items) {
  transfer_all(model_, items, Transfer<true>(transport_, to));
}

void StateTransfer::receive(int from, const ShareItems& items) {
  transfer_all(model_, items, Transfer<false>(transport_, from));
}

}  // namespace railwave
