#pragma once

#include <memory>
#include <vector>

#include "model/host_copy.hpp"

namespace railwave {

/// Gives memory back to those who borrow next.
struct GiveBack {
  std::size_t bytes = 0;
  void operator()(void* memory) const;
};

/// Memory of the device, lent as long as this lives. A GPU takes 20 to 350 us to give memory of its own, and as long to
/// take it back; what is given back here is kept for the next who asks, up to most_kept_memory.
using LentMemory = std::unique_ptr<void, GiveBack>;
LentMemory lend_memory(std::size_t bytes);

inline constexpr std::size_t most_kept_memory = std::size_t{64} << 20;

/// How many bytes are kept and lent to nobody.
std::size_t kept_memory();

/// An array in lent memory, uninitialised: for what is computed and fetched again and again, as fields of outputs are.
/// In the default order of launches alone, so that the next borrower comes after what this one has launched.
template <class T>
class LentArray {
 public:
  explicit LentArray(std::size_t rows)
      : memory_(lend_memory(Array<T>::required_allocation_size(rows))),
        view_(static_cast<typename Array<T>::value_type*>(memory_.get()), rows) {}

  const Array<T>& operator*() const { return view_; }

 private:
  LentMemory memory_;
  Array<T> view_;
};

/// A copy of the values.
template <class T>
LentArray<T*> lent_copy(const std::vector<T>& values) {
  LentArray<T*> copy(values.size());
  bring(values, *copy);
  return copy;
}

}  // namespace railwave
