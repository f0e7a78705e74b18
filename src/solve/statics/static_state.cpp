#include "solve/statics/static_state.hpp"

#include "model/boundaries/non_reflecting_ends.hpp"
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
  StateLayer state_;
  std::size_t arrays_, visited_ = 0;
  bool suits_ = true;
};

/// A file may be damaged in ways that sizes don't show.
bool tracks_segments(const Model& model, const StaticState& state) {
  const StateLayer layer(state.arrays);
  for (std::size_t p = 0; p < model.contacts.size(); ++p) {
    std::vector<int> tracked;
    layer.values(fmt::format("contact_{}_tracked", p), tracked);
    const int segments = static_cast<int>(model.contacts[p].master_segments.size());
    for (int segment : tracked)
      if (segment < -1 || segment >= segments) return false;
  }
  return true;
}

}  // namespace

StaticState take_static_state(Model& model) {
  StaticState state;
  StateTaker taker(state.arrays);
  StateArrays<StateTaker> arrays(taker, model, true);
  visit_model_arrays(arrays, model);
  return state;
}

bool lay_static_state(Model& model, const StaticState& state) {
  Suits suits(state);
  visit_model_arrays(suits, model);
  if (!suits || !tracks_segments(model, state)) return false;
  reset_to_start(model);
  StateLayer layer(state.arrays);
  StateArrays<StateLayer> arrays(layer, model, true);
  visit_model_arrays(arrays, model);
  for (const ElementGroup& group : model.elements) renew_frames(model, group);
  hold_ends(model, {});  // from where they are now, by what held them
  visit_arrays(Named<StateArrays<StateLayer>>{arrays, "ends_"}, model.ends.arrays);
  return true;
}

}  // namespace railwave
