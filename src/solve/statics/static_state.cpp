#include "solve/statics/static_state.hpp"

#include "model/boundaries/absorbing_boundaries.hpp"
#include "solve/checkpoint/state_arrays.hpp"

namespace railwave {
namespace {

/// Whether a state has all settled arrays of a model, of their sizes, and no others.
class Suits {
 public:
  explicit Suits(const StaticState& state) : state_(state.arrays), arrays_(state.arrays.values.size()) {}

  template <class View>
  void operator()(ArrayUse use, const std::string& name, View& view, ArrayShape /*shape*/) {
    if (!is_settled_state(use) || view.size() == 0) return;
    ++visited_;
    suits_ = suits_ && state_.has(name) && state_.of(name).size() == view.size() * sizeof(typename View::value_type);
  }
  explicit operator bool() const { return suits_ && visited_ == arrays_; }

 private:
  StateRestorer state_;
  std::size_t arrays_, visited_ = 0;
  bool suits_ = true;
};

/// Copies what trials change, array by array, to a place of its own or back from it.
class CopyTrial {
 public:
  CopyTrial(std::vector<Array<unsigned char*>>& kept, bool back) : kept_(kept), back_(back) {}

  template <class View>
  void operator()(ArrayUse use, const std::string& name, View& view, ArrayShape /*shape*/) {
    if (use != ArrayUse::trial_state || view.span() == 0) return;
    using Bytes = Kokkos::View<unsigned char*, MemorySpace, Kokkos::MemoryTraits<Kokkos::Unmanaged>>;
    using Value = std::remove_const_t<typename View::value_type>;
    const Bytes bytes(reinterpret_cast<unsigned char*>(const_cast<Value*>(view.data())), view.span() * sizeof(Value));
    if (visited_ == kept_.size()) kept_.emplace_back("kept " + name, bytes.size());
    const Bytes own(kept_[visited_].data(), kept_[visited_].size());
    ++visited_;
    if (back_)
      Kokkos::deep_copy(bytes, own);
    else
      Kokkos::deep_copy(own, bytes);
  }

 private:
  std::vector<Array<unsigned char*>>& kept_;
  bool back_;
  std::size_t visited_ = 0;
};

/// A file may be damaged in ways that sizes don't show.
bool tracks_segments(const std::vector<ContactPair>& contacts, const StaticState& state) {
  const StateRestorer restorer(state.arrays);
  for (std::size_t p = 0; p < contacts.size(); ++p) {
    std::vector<int> tracked;
    restorer.values(fmt::format("contact_{}_tracked", p), tracked);
    const int segments = static_cast<int>(contacts[p].master_segments.size());
    for (int segment : tracked)
      if (segment < -1 || segment >= segments) return false;
  }
  return true;
}

}  // namespace

StaticState save_static_state(Model& model) {
  StaticState state;
  StateSaver saver(state.arrays);
  StateArrays<StateSaver> arrays(saver, model.in_single, true);
  visit_model_arrays(arrays, model);
  return state;
}

bool restore_static_state(Model& model, const StaticState& state) {
  Suits suits(state);
  visit_model_arrays(suits, model);
  if (!suits || !tracks_segments(model.contacts, state)) return false;
  reset_to_start(model);
  StateRestorer restorer(state.arrays);
  StateArrays<StateRestorer> arrays(restorer, model.in_single, true);
  visit_model_arrays(arrays, model);
  for (const ElementGroup& group : model.elements) renew_frames(model.nodes, group);
  hold_ends(model.ends, model.nodes.position, {});  // from where they are now, by what held them
  visit_arrays(Named<StateArrays<StateRestorer>>{arrays, "ends_"}, model.ends.arrays);
  return true;
}

void TrialState::keep(Model& model) {
  CopyTrial copy(kept_, false);
  visit_model_arrays(copy, model);
}

void TrialState::restore(Model& model) {
  CopyTrial copy(kept_, true);
  visit_model_arrays(copy, model);
}

}  // namespace railwave
