#include "output/fields/compressed_rows.hpp"

#include <algorithm>
#include <atomic>
#include <exception>
#include <thread>
#include <utility>

#include "output/free_memory.hpp"

namespace railwave {

void CompressedRows::add(const hdf5::Dataset& dataset, Values values) {
  if (dataset.packs()) rows_.push_back({&dataset, std::move(values), {}});
}

void CompressedRows::pack(int threads) {
  const std::size_t workers = std::min(rows_.size(), static_cast<std::size_t>(std::max(threads, 1)));
  // Of a thread, its stream and its row: values, shuffled, packed. Packed rows stay.
  constexpr std::size_t stack = std::size_t{8} << 20, of_zlib = std::size_t{1} << 20;
  std::size_t longest = 0, all = 0;
  for (const Row& row : rows_) {
    const std::size_t bytes = sizeof(double) * row.dataset->values_of_packed();
    longest = std::max(longest, bytes);
    all += bytes;
  }
  if (!leaves_free_memory(all + workers * (stack + of_zlib + 6 * longest))) return;

  std::atomic<std::size_t> next{0};
  const auto work = [&]() noexcept {
    for (std::size_t k; (k = next++) < rows_.size();) {
      try {
        const std::vector<double> values = rows_[k].values();
        if (values.size() == rows_[k].dataset->values_of_packed())
          rows_[k].packed = rows_[k].dataset->pack(values.data());
      } catch (const std::exception&) {  // whoever writes the row says why
      }
    }
  };
  std::vector<std::thread> helpers;
  try {
    while (helpers.size() + 1 < workers) helpers.emplace_back(work);
  } catch (const std::exception&) {  // fewer will do
  }
  work();
  for (std::thread& helper : helpers) helper.join();
}

bool CompressedRows::append_to(hdf5::Dataset& dataset) const {
  const auto row = std::find_if(rows_.begin(), rows_.end(),
                                [&](const Row& one) { return one.dataset == &dataset && !one.packed.empty(); });
  if (row == rows_.end()) return false;
  dataset.append(row->packed);
  return true;
}

}  // namespace railwave
