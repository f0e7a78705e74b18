#include <map>
#include <utility>

#include "kernels/support/packed_rows.hpp"
#include "kernels/support/team.hpp"
#include "model/elements/element_histories.hpp"
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

}  // namespace

/// What transfers with another rank need again and again: places on the device, and room for what is packed, on the
/// device and on the host.
struct StateTransfer::Kept {
  /// By other rank and what is brought, in the order of the arrays.
  std::map<std::pair<int, Transferred>, std::vector<Array<int*>>> places;
  Array<double*> device;
  PinnedArray<double*> host;

  void make_room(std::size_t bytes) {
    const std::size_t count = (bytes + sizeof(double) - 1) / sizeof(double);
    if (device.extent(0) >= count) return;
    device = unset_array<double*>("packed", count);
    if constexpr (on_device)
      host = PinnedArray<double*>(Kokkos::view_alloc(std::string("packed"), Kokkos::WithoutInitializing), count);
    else
      host = device;
  }
};

namespace {

/// Arrays of a model, one after the other, to or from another rank.
template <bool Sending, class Kept>
class Transfer {
 public:
  std::size_t bytes = 0;  ///< so far

  Transfer(Transport& transport, int other, Kept& kept, Transferred what)
      : transport_(transport), other_(other), kept_(kept), places_(kept.places[{other, what}]) {}

  /// @param width values at each place
  /// @param places called the first time
  template <class T, class Places>
  void values(const Array<T*>& array, const Places& places, int width) {
    if (array.extent(0) == 0) return;
    const Array<int*> at = next(places);
    const std::size_t count = at.extent(0) * width;
    transfer<T>(count, count, [&](const Array<T*>& packed) {
      return PackedValues<T, Sending>{array, at, width, packed};
    });
  }

  template <class T, int N, class Places>
  void rows(const Array<T* [N]>& array, const Places& places) {
    if (array.extent(0) == 0) return;
    const Array<int*> at = next(places);
    transfer<T>(at.extent(0) * N, at.extent(0), [&](const Array<T*>& packed) {
      return PackedRows<T, N, Sending>{array, at, packed};
    });
  }

 private:
  template <class Places>
  Array<int*> next(const Places& places) {
    if (array_ == places_.size()) places_.push_back(to_device("places", places()));
    return places_[array_++];
  }

  /// @param count of values
  /// @param calls of the kernel that packs or unpacks
  template <class T, class KernelOf>
  void transfer(std::size_t count, std::size_t calls, const KernelOf& kernel_of) {
    if (count == 0) return;
    bytes += sizeof(T) * count;
    kept_.make_room(sizeof(T) * count);
    const Array<T*> packed(reinterpret_cast<T*>(kept_.device.data()), count);
    const PinnedArray<T*> host(reinterpret_cast<T*>(kept_.host.data()), count);
    const Range range(0, static_cast<int>(calls));
    if constexpr (Sending) {
      Kokkos::parallel_for("pack", range, kernel_of(packed));
      if constexpr (on_device) Kokkos::deep_copy(ExecutionSpace(), host, packed);
      ExecutionSpace().fence();
      transport_.start_send(other_, host.data(), sizeof(T) * count);
      transport_.finish();
    } else {
      transport_.start_receive(other_, host.data(), sizeof(T) * count);
      transport_.finish();
      if constexpr (on_device) Kokkos::deep_copy(ExecutionSpace(), packed, host);
      Kokkos::parallel_for("unpack", range, kernel_of(packed));
      ExecutionSpace().fence();  // the room is the next array's
    }
  }

  Transport& transport_;
  int other_;
  Kept& kept_;
  std::vector<Array<int*>>& places_;
  std::size_t array_ = 0;
};

template <class Transfer>
void transfer_energies(Model& model, const ShareItems& items, Transfer& transfer) {
  transfer.values(
      model.node_parts.part_sums, [&] { return parts_of_rank(model.node_parts, model.elements, items); },
      model.node_parts.values);
  for (std::size_t g = 0; g < model.elements.size(); ++g)
    transfer.template rows<double, energies_of_block>(model.elements[g].block_sums, [&] { return items.blocks[g]; });
}

template <class Transfer>
void transfer_histories(Model& model, const ShareItems& items, Transfer& transfer) {
  const auto parts = [&](const PartedLists& lists) {
    transfer.values(
        lists.part_sums, [&] { return parts_of_rank(lists, model.elements, items); }, lists.values);
  };
  parts(model.motion_histories.parts);
  if (model.element_histories) parts(model.element_histories->parts);
}

template <class Transfer>
void transfer_state(Model& model, const ShareItems& items, Transfer& transfer) {
  const auto nodes = [&] { return items.nodes; };
  transfer.template rows<double, 3>(model.nodes.position, nodes);
  transfer.template rows<double, 3>(model.nodes.velocity, nodes);
  transfer.values(model.relative.node, nodes, 1);
  for (std::size_t g = 0; g < model.elements.size(); ++g) {
    ElementGroup& group = model.elements[g];
    const auto blocks = [&] { return items.blocks[g]; };
    const auto rows = [&] { return rows_of(group, items.blocks[g]); };
    transfer.template rows<double, BlockFrame::values>(group.blocks.frame, blocks);
    transfer.values(group.blocks.hourglass_energy, blocks, power_sums);
    transfer.values(group.material.history, blocks, elements_of_block * group.material.history_values);
    transfer.values(group.damping.energy, blocks, 1);
    transfer.values(model.partial.in_double, rows, 1);
    transfer.values(model.partial.in_single, rows, 1);
  }
}

template <class Transfer>
std::size_t transfer_all(Model& model, const ShareItems& items, Transferred what, Transfer transfer) {
  if (what == Transferred::energies)
    transfer_energies(model, items, transfer);
  else if (what == Transferred::histories)
    transfer_histories(model, items, transfer);
  else if (what == Transferred::places)
    transfer.template rows<double, 3>(model.nodes.position, [&] { return items.shown; });
  else
    transfer_state(model, items, transfer);
  return transfer.bytes;
}

}  // namespace

StateTransfer::StateTransfer(Model& model, Transport& transport)
    : model_(model), transport_(transport), kept_(std::make_unique<Kept>()) {}

StateTransfer::~StateTransfer() = default;

void StateTransfer::send(int to, const ShareItems& items, Transferred what) {
  transfer_all(model_, items, what, Transfer<true, Kept>(transport_, to, *kept_, what));
}

void StateTransfer::receive(int from, const ShareItems& items, Transferred what) {
  bytes_[static_cast<int>(what)] +=
      static_cast<double>(transfer_all(model_, items, what, Transfer<false, Kept>(transport_, from, *kept_, what)));
}

}  // namespace railwave
