#pragma once

#include <fmt/format.h>

#include <cstring>

#include "model/elements/element_model.hpp"
#include "model/host_copy.hpp"
#include "model/visit_arrays.hpp"
#include "solve/checkpoint/run_state.hpp"

/// Arrays of a model to and from plain data.
namespace railwave {

template <class View>
constexpr bool rows_together = View::rank == 1 || std::is_same_v<typename View::array_layout, Kokkos::LayoutRight>;

/// Each value of an array with the place that it has row after row.
template <class View, class Do>
void each_value(const View& host, const Do& one) {
  std::size_t at = 0;
  for (std::size_t i = 0; i < host.extent(0); ++i) {
    if constexpr (View::rank == 1)
      one(host(i), at++);
    else
      for (std::size_t k = 0; k < host.extent(1); ++k) one(host(i, k), at++);
  }
}

template <class View>
void array(StateSaver& saver, const std::string& name, View& view) {
  using Value = typename View::non_const_value_type;
  static_assert(View::rank <= 2);
  if (view.size() == 0) return saver.bytes(name, nullptr, 0);
  const auto host = to_host(view);
  if constexpr (rows_together<View>) return saver.bytes(name, host.data(), view.size() * sizeof(Value));
  std::vector<Value> values(view.size());
  each_value(host, [&](const Value& value, std::size_t at) { values[at] = value; });
  saver.values(name, values);
}

template <class View>
void array(StateRestorer& restorer, const std::string& name, View& view) {
  using Value = typename View::non_const_value_type;
  const auto& bytes = restorer.of(name);
  if (bytes.size() != view.size() * sizeof(Value))
    refuse_state(name, fmt::format("has {} values, not {}", bytes.size() / sizeof(Value), view.size()));
  if (view.size() == 0) return;
  const auto host = Kokkos::create_mirror_view(view);
  const auto* from = reinterpret_cast<const char*>(bytes.data());
  each_value(host,
             [&](Value& value, std::size_t at) { std::memcpy(&value, from + at * sizeof(Value), sizeof(Value)); });
  Kokkos::deep_copy(view, host);
}

/// Of arrays whose length the run changes.
template <class View>
void growing_array(StateSaver& saver, const std::string& name, View& view) {
  array(saver, name, view);
}

template <class View>
void growing_array(StateRestorer& restorer, const std::string& name, View& view) {
  std::size_t row = sizeof(typename View::non_const_value_type);
  if constexpr (View::rank == 2) row *= view.static_extent(1);
  view = View(Kokkos::view_alloc(view.label().empty() ? name : view.label(), Kokkos::WithoutInitializing),
              restorer.of(name).size() / row);
  array(restorer, name, view);
}

/// Tiles are as wide as the machine's packs; a state has the values slot after slot.
template <class S, class Do>
void each_tiled(std::size_t size, int values, const Do& one) {
  for (std::size_t at = 0; at < size; ++at)
    one(at, tiled_slot<S>(static_cast<int>(at / values), values, static_cast<int>(at % values)));
}

template <class S>
void tiles(StateSaver& saver, const std::string& name, Array<double*>& view, int values) {
  const auto tiled = to_vector(view);
  std::vector<double> list(tiled.size());
  each_tiled<S>(list.size(), values, [&](std::size_t at, long place) { list[at] = tiled[place]; });
  saver.values(name, list);
}

template <class S>
void tiles(StateRestorer& restorer, const std::string& name, Array<double*>& view, int values) {
  std::vector<double> list;
  restorer.values(name, list);
  if (list.size() != view.size()) refuse_state(name, fmt::format("has {} values, not {}", list.size(), view.size()));
  const auto host = Kokkos::create_mirror_view(view);
  each_tiled<S>(list.size(), values, [&](std::size_t at, long place) { host(place) = list[at]; });
  Kokkos::deep_copy(view, host);
}

/// Saves or restores what a checkpoint keeps, or of that only what a settled scene is identified by; `single` says
/// whether the elements are computed in single precision.
template <class Archive>
class StateArrays {
 public:
  StateArrays(Archive& archive, bool single, bool settled_only)
      : archive_(archive), single_(single), settled_only_(settled_only) {}

  template <class View>
  void operator()(ArrayUse use, const std::string& name, View& view, ArrayShape shape) {
    if (!is_settled_state(use) && (settled_only_ || use != ArrayUse::run_state)) return;
    if (settled_only_ && view.size() == 0) return;
    if constexpr (View::rank > 2 || std::is_const_v<typename View::value_type>) {
      throw std::logic_error(name + " is no array of a kind that states hold");
    } else {
      if constexpr (std::is_same_v<View, Array<double*>>)
        if (shape.tile > 0)
          return single_ ? tiles<float>(archive_, name, view, shape.tile)
                         : tiles<double>(archive_, name, view, shape.tile);
      if (shape.grows)
        growing_array(archive_, name, view);
      else
        array(archive_, name, view);
    }
  }

 private:
  Archive& archive_;
  bool single_, settled_only_;
};

}  // namespace railwave
