#pragma once

#include <cstring>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <unordered_map>
#include <vector>

namespace railwave {

struct Model;

/// Everything that the rest of a run depends on, between two steps, as plain data: what a checkpoint holds.
struct RunState {
  struct Values {
    std::string name;
    std::vector<signed char> bytes;  ///< of an array row after row, whatever its layout on the device
  };

  std::vector<Values> values;
  long step = 0;
  double time = 0;         ///< s
  long history_rows = 0;   ///< written to the results before that step
  long field_outputs = 0;  ///< likewise
  std::string back_end;    ///< on which it was computed
};

/// Throws std::runtime_error with what does not fit where a state is restored to another model than it was saved from.
[[noreturn]] void refuse_state(const std::string& name, const std::string& what);

/// Saves values in a state, one after the other. Saving and restoring go through the same functions `archive`, so that
/// what is saved is what is restored.
class StateSaver {
 public:
  explicit StateSaver(RunState& state) : state_(state) {}

  template <class T>
  void value(const std::string& name, const T& value) {
    bytes(name, &value, sizeof value);
  }

  /// One that states of before do not have.
  template <class T>
  void newer_value(const std::string& name, const T& value) {
    this->value(name, value);
  }

  template <class T>
  void values(const std::string& name, const std::vector<T>& list) {
    bytes(name, list.data(), list.size() * sizeof(T));
  }

  void bytes(const std::string& name, const void* from, std::size_t size) {
    const auto* first = static_cast<const signed char*>(from);
    state_.values.push_back({name, {first, first + size}});
  }

 private:
  RunState& state_;
};

/// Restores them to where they were.
class StateRestorer {
 public:
  explicit StateRestorer(const RunState& state) {
    for (const RunState::Values& one : state.values) by_name_.emplace(one.name, &one.bytes);
  }

  template <class T>
  void value(const std::string& name, T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    const auto& bytes = of(name);
    if (bytes.size() != sizeof value) refuse_state(name, "has another size");
    std::memcpy(static_cast<void*>(&value), bytes.data(), sizeof value);
  }

  /// Left as it is where the state does not have it.
  template <class T>
  void newer_value(const std::string& name, T& value) {
    if (has(name)) this->value(name, value);
  }

  template <class T>
  void values(const std::string& name, std::vector<T>& list) const {
    static_assert(std::is_trivially_copyable_v<T>);
    const auto& bytes = of(name);
    if (bytes.size() % sizeof(T) != 0) refuse_state(name, "has another size");
    list.resize(bytes.size() / sizeof(T));
    if (!bytes.empty()) std::memcpy(static_cast<void*>(list.data()), bytes.data(), bytes.size());
  }

  bool has(const std::string& name) const { return by_name_.count(name) > 0; }

  const std::vector<signed char>& of(const std::string& name) const {
    const auto found = by_name_.find(name);
    if (found == by_name_.end()) refuse_state(name, "is missing");
    return *found->second;
  }

 private:
  std::unordered_map<std::string, const std::vector<signed char>*> by_name_;
};

/// The model's part of a state, at an instant when all levels are in phase and before that instant's forces.
void save_model_state(Model& model, RunState& state);
void restore_model_state(Model& model, const RunState& state);

/// Name of what the program computes on.
std::string back_end_name();

/// Where a run's states are kept, so that it can be taken up again.
class Checkpoints {
 public:
  virtual ~Checkpoints() = default;

  /// Keeps the state; it may be on the disk later only. Called after the outputs that the state counts.
  virtual void keep(RunState state) = 0;

  /// Waits until what was given is on the disk.
  /// @return what went wrong with it since the run began; empty: nothing
  virtual std::string trouble() = 0;
};

}  // namespace railwave
