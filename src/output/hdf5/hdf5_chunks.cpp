#include "output/hdf5/hdf5_chunks.hpp"

#ifdef RAILWAVE_ZLIB
#include <zlib.h>
#endif

#include <algorithm>
#include <condition_variable>
#include <cstring>
#include <deque>
#include <exception>
#include <mutex>
#include <new>
#include <optional>
#include <stdexcept>
#include <thread>
#include <type_traits>
#include <vector>

#include "output/free_memory.hpp"
#include "output/hdf5/hdf5_parts.hpp"

// H5Dwrite_chunk is there from 1.10.3 on.
#if defined(RAILWAVE_ZLIB) && H5_VERSION_GE(1, 10, 3)
#define RAILWAVE_CHUNKS
#endif

namespace railwave::hdf5 {
namespace {

/// A sum of HDF5's, which folds the carries into the lower 16 bits: zero only where nothing was added.
std::uint64_t folded(std::uint64_t sum) { return sum == 0 ? 0 : (sum - 1) % 65535 + 1; }

#ifdef RAILWAVE_CHUNKS

constexpr hsize_t fewest_chunks = 2;  // a thread starts in a hundredth of the time that one takes

/// Level of deflate in a pipeline of shuffle, deflate and fletcher32; nothing: it is another.
std::optional<int> level_of(hid_t properties) {
  constexpr H5Z_filter_t wanted[] = {H5Z_FILTER_SHUFFLE, H5Z_FILTER_DEFLATE, H5Z_FILTER_FLETCHER32};
  if (H5Pget_nfilters(properties) != 3) return std::nullopt;
  unsigned level = 0;
  for (unsigned i = 0; i < 3; ++i) {
    unsigned flags = 0, settings[8] = {};
    std::size_t count = 8;
    if (H5Pget_filter2(properties, i, &flags, &count, settings, 0, nullptr, nullptr) != wanted[i]) return std::nullopt;
    if (wanted[i] == H5Z_FILTER_DEFLATE) level = settings[0];
  }
  return static_cast<int>(level);
}

/// Where the chunks of a block are: along one dimension they follow each other, in those before it they have one entry
/// each, in those behind it all. So the values of a chunk lie one behind the other in the block.
struct Chunks {
  Shape block;            ///< entries
  hsize_t first = 0;      ///< row of the dataset at which the block begins
  std::size_t along = 0;  ///< number of that dimension
  hsize_t length = 1;     ///< entries of a chunk along it
  hsize_t inner = 1;      ///< values of one such entry
  hsize_t in_turn = 1;    ///< chunks along it
  hsize_t count = 1;      ///< of all chunks

  hsize_t values_in_chunk() const { return length * inner; }
  hsize_t entry_along(hsize_t chunk) const { return chunk % in_turn * length; }
  /// Of a chunk's first value, in the block.
  hsize_t begin(hsize_t chunk) const { return (chunk / in_turn * block[along] + entry_along(chunk)) * inner; }
  /// How many values of the block a chunk has: fewer than its own at the block's edge.
  hsize_t values(hsize_t chunk) const { return std::min(length, block[along] - entry_along(chunk)) * inner; }
  /// In the dataset.
  Shape offset(hsize_t chunk) const {
    Shape offset(block.size(), 0);
    offset[along] = entry_along(chunk);
    hsize_t before = chunk / in_turn;
    for (std::size_t d = along; d-- > 0; before /= block[d]) offset[d] = before % block[d];
    offset[0] += first;
    return offset;
  }
};

std::optional<Chunks> chunks_of(hid_t properties, hsize_t first, const Shape& block) {
  Shape chunk(block.size());
  if (block.empty() || count_of(block) == 0 || H5Pget_layout(properties) != H5D_CHUNKED ||
      H5Pget_chunk(properties, static_cast<int>(chunk.size()), chunk.data()) != static_cast<int>(chunk.size()))
    return std::nullopt;
  Chunks chunks;
  chunks.block = block;
  chunks.first = first;
  while (chunks.along + 1 < chunk.size() && chunk[chunks.along] == 1) chunks.count *= block[chunks.along++];
  chunks.length = chunk[chunks.along];
  chunks.in_turn = (block[chunks.along] + chunks.length - 1) / chunks.length;
  chunks.count *= chunks.in_turn;
  for (std::size_t d = chunks.along + 1; d < chunk.size(); ++d) {
    if (chunk[d] != block[d]) return std::nullopt;
    chunks.inner *= block[d];
  }
  if (first % chunk[0] != 0 || chunks.count < fewest_chunks) return std::nullopt;
  return chunks;
}

/// A chunk as it goes into the file.
struct Packed {
  std::vector<unsigned char> bytes;
  std::size_t size = 0;
};

/// What one thread needs. It allocates all of it at once: in its thread none could be checked.
class Packer {
 public:
  Packer(int level, std::size_t bytes_in_chunk) : plain_(bytes_in_chunk), shuffled_(bytes_in_chunk) {
    if (deflateInit(&stream_, level) != Z_OK) throw std::bad_alloc();
  }
  Packer(const Packer&) = delete;
  Packer& operator=(const Packer&) = delete;
  ~Packer() { deflateEnd(&stream_); }

  static std::size_t bytes_needed(std::size_t bytes_in_chunk) {
    constexpr std::size_t of_zlib = std::size_t{512} << 10;
    return 2 * bytes_in_chunk + of_zlib;
  }
  static std::size_t most_packed(std::size_t bytes_in_chunk) {
    return compressBound(static_cast<uLong>(bytes_in_chunk)) + size_of_sum;
  }

  /// @param fill(bytes) puts the chunk's values there
  template <class Fill>
  void pack(const Fill& fill, std::size_t value_size, Packed& packed) {
    fill(plain_.data());
    shuffle(value_size);
    // compress2() of zlib does just this, with a stream that it allocates each time.
    const bool ready = deflateReset(&stream_) == Z_OK;
    stream_.next_in = shuffled_.data();
    stream_.avail_in = static_cast<uInt>(shuffled_.size());
    stream_.next_out = packed.bytes.data();
    stream_.avail_out = static_cast<uInt>(packed.bytes.size() - size_of_sum);
    packed.size = 0;
    if (!ready || deflate(&stream_, Z_FINISH) != Z_STREAM_END) return;
    packed.size = stream_.total_out;
    const std::uint32_t sum = fletcher32(packed.bytes.data(), packed.size);
    for (std::size_t b = 0; b < size_of_sum; ++b)
      packed.bytes[packed.size++] = static_cast<unsigned char>(sum >> 8 * b & 0xff);
  }

 private:
  static constexpr std::size_t size_of_sum = 4;

  /// First bytes of all values, then second bytes, and so on.
  void shuffle(std::size_t value_size) {
    const std::size_t count = plain_.size() / value_size;
    for (std::size_t b = 0; b < value_size; ++b)
      for (std::size_t i = 0; i < count; ++i) shuffled_[b * count + i] = plain_[i * value_size + b];
  }

  std::vector<unsigned char> plain_, shuffled_;
  z_stream stream_{};
};

/// Packs chunks on several threads and hands them out in order. A chunk that is taken has a place for its bytes, and
/// they are taken in order: so the one that is waited for never lacks a place, and memory is bounded by the threads.
template <class Fill>
class Packing {
 public:
  Packing(hsize_t count, int level, std::size_t value_size, std::size_t bytes_in_chunk, const Fill& fill)
      : level_(level), value_size_(value_size), bytes_in_chunk_(bytes_in_chunk), fill_(fill), done_(count) {}
  Packing(const Packing&) = delete;
  Packing& operator=(const Packing&) = delete;
  ~Packing() {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      next_ = done_.size();
    }
    changed_.notify_all();
    for (std::thread& helper : helpers_) helper.join();
  }

  /// Makes what one more thread needs. @return whether there was memory for it
  bool add_packer() noexcept {
    try {
      constexpr std::size_t stack = std::size_t{8} << 20;
      const std::size_t packed = Packer::most_packed(bytes_in_chunk_);
      expect_free_memory(stack + Packer::bytes_needed(bytes_in_chunk_) + places_of_thread * packed);
      packers_.emplace_back(level_, bytes_in_chunk_);
      std::deque<Packed> places;
      for (int i = 0; i < places_of_thread; ++i) places.push_back({std::vector<unsigned char>(packed), 0});
      const std::lock_guard<std::mutex> lock(mutex_);
      free_.reserve(places_.size() + places.size());
      for (Packed& place : places) free_.push_back(&places_.emplace_back(std::move(place)));
      return true;
    } catch (const std::exception&) {
      return false;
    }
  }

  /// Lets so many threads work, this one among them, as far as the system gives them.
  void work_on(std::size_t threads) noexcept {
    while (may_grow_ && helpers_.size() + 1 < threads) {
      may_grow_ = add_packer();
      if (!may_grow_) return;
      try {
        helpers_.emplace_back([this, &packer = packers_.back()] { help(packer); });
      } catch (const std::exception&) {
        may_grow_ = false;
      }
      changed_.notify_all();  // there are more places
    }
  }

  /// Whether the chunk is packed; else packs one, or waits.
  const Packed* take(hsize_t chunk) {
    std::unique_lock<std::mutex> lock(mutex_);
    if (done_[chunk]) return done_[chunk];
    if (can_begin())
      pack_one(lock, packers_.front());
    else
      changed_.wait(lock, [&] { return done_[chunk] != nullptr; });
    return done_[chunk];
  }

  /// The chunk is written: its place is free.
  void give_back(hsize_t chunk) {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      free_.push_back(done_[chunk]);
    }
    changed_.notify_all();
  }

 private:
  static constexpr int places_of_thread = 2;

  bool can_begin() const { return next_ < done_.size() && !free_.empty(); }

  void help(Packer& packer) {
    std::unique_lock<std::mutex> lock(mutex_);
    while (true) {
      changed_.wait(lock, [&] { return next_ == done_.size() || can_begin(); });
      if (next_ == done_.size()) return;
      pack_one(lock, packer);
    }
  }

  void pack_one(std::unique_lock<std::mutex>& lock, Packer& packer) {
    const hsize_t chunk = next_++;
    Packed* const place = free_.back();
    free_.pop_back();
    lock.unlock();
    packer.pack([&](unsigned char* bytes) { fill_(chunk, bytes); }, value_size_, *place);
    lock.lock();
    done_[chunk] = place;
    changed_.notify_all();
  }

  const int level_;
  const std::size_t value_size_, bytes_in_chunk_;
  const Fill& fill_;
  std::deque<Packer> packers_;  ///< the first is that of the thread which writes
  bool may_grow_ = true;
  std::mutex mutex_;  ///< guards what follows
  std::condition_variable changed_;
  std::deque<Packed> places_;
  std::vector<Packed*> free_;
  std::vector<Packed*> done_;  ///< of each chunk; null: not yet packed
  hsize_t next_ = 0;           ///< chunk that nobody has taken
  std::vector<std::thread> helpers_;
};

/// Puts the values of a chunk, and the dataset's fill value beyond the block's edge, where they are packed.
/// @tparam T type of the values, @tparam F that of the file's
template <class F, class T>
struct Fill {
  const Chunks& chunks;
  const T* values;
  F nothing;
  void operator()(hsize_t chunk, unsigned char* bytes) const {
    const hsize_t count = chunks.values(chunk);
    const T* from = values + chunks.begin(chunk);
    const auto put = [&](hsize_t i, F value) { std::memcpy(bytes + i * sizeof(F), &value, sizeof(F)); };
    for (hsize_t i = 0; i < count; ++i) put(i, static_cast<F>(from[i]));
    for (hsize_t i = count; i < chunks.values_in_chunk(); ++i) put(i, nothing);
  }
};

template <class F>
PackedRow pack_row_as(const RowLayout& layout, const double* row) {
  const std::size_t bytes_in_chunk = layout.values * sizeof(F);
  Packed packed{std::vector<unsigned char>(Packer::most_packed(bytes_in_chunk)), 0};
  const auto fill = [&](unsigned char* bytes) {
    for (hsize_t i = 0; i < layout.values; ++i) {
      const F value = static_cast<F>(row[i]);
      std::memcpy(bytes + i * sizeof(F), &value, sizeof(F));
    }
  };
  Packer(layout.level, bytes_in_chunk).pack(fill, sizeof(F), packed);
  packed.bytes.resize(packed.size);
  return std::move(packed.bytes);
}

template <class F, class T>
bool write_as(hid_t dataset, hid_t properties, const std::string& name, const Chunks& chunks, const T* values,
              const ThreadCount& threads) {
  const std::optional<int> level = level_of(properties);
  Fill<F, T> fill{chunks, values, {}};
  if (!level || H5Pget_fill_value(properties, native_type<F>(), &fill.nothing) < 0) return false;
  Packing<Fill<F, T>> packing(chunks.count, *level, sizeof(F), chunks.values_in_chunk() * sizeof(F), fill);
  if (!packing.add_packer()) return false;
  for (hsize_t chunk = 0; chunk < chunks.count;) {
    packing.work_on(std::min(static_cast<hsize_t>(std::max(threads(), 1)), chunks.count - chunk));
    const Packed* const packed = packing.take(chunk);
    if (packed == nullptr) continue;
    if (packed->size == 0) throw std::logic_error("writing " + name + ": zlib could not compress a chunk");
    expect_free_memory();
    write_chunk(dataset, name, chunks.offset(chunk), packed->bytes.data(), packed->size);
    packing.give_back(chunk++);
  }
  return true;
}

#endif

}  // namespace

std::uint32_t fletcher32(const unsigned char* bytes, std::size_t size) {
  constexpr std::size_t block = std::size_t{1} << 20;  // whose sums have room in 64 bits
  std::uint64_t sum = 0, sum_of_sums = 0;
  for (std::size_t from = 0; from < size; from += block) {
    const std::size_t to = std::min(size, from + block);
    for (std::size_t i = from; i < to; i += 2) {
      sum += static_cast<std::uint64_t>(bytes[i]) << 8 | (i + 1 < size ? bytes[i + 1] : 0u);
      sum_of_sums += sum;
    }
    sum = folded(sum);
    sum_of_sums = folded(sum_of_sums);
  }
  return static_cast<std::uint32_t>(sum_of_sums << 16 | sum);
}

template <class T>
bool write_chunks([[maybe_unused]] hid_t dataset, [[maybe_unused]] const std::string& name,
                  [[maybe_unused]] hsize_t first, [[maybe_unused]] const Shape& block, [[maybe_unused]] const T* values,
                  [[maybe_unused]] const ThreadCount& threads) {
#ifdef RAILWAVE_CHUNKS
  if (!threads || count_of(block) < fewest_chunks) return false;
  const std::string what = "asking for the chunks of " + name;
  const Handle properties(check(H5Dget_create_plist(dataset), what), H5Pclose);
  const std::optional<Chunks> chunks = chunks_of(properties.get(), first, block);
  if (!chunks) return false;
  const Handle type(check(H5Dget_type(dataset), what), H5Tclose);
  if (H5Tequal(type.get(), native_type<T>()) > 0)
    return write_as<T>(dataset, properties.get(), name, *chunks, values, threads);
  if constexpr (std::is_same_v<T, double>)
    if (H5Tequal(type.get(), native_type<float>()) > 0)
      return write_as<float>(dataset, properties.get(), name, *chunks, values, threads);
#endif
  return false;
}

std::optional<RowLayout> row_layout([[maybe_unused]] hid_t dataset, [[maybe_unused]] const std::string& name) {
#ifdef RAILWAVE_CHUNKS
  const std::string what = "asking for the chunks of " + name;
  const Handle properties(check(H5Dget_create_plist(dataset), what), H5Pclose),
      type(check(H5Dget_type(dataset), what), H5Tclose), space = file_space(dataset, name);
  const std::optional<int> level = level_of(properties.get());
  const bool in_single = H5Tequal(type.get(), native_type<float>()) > 0;
  if (!level || (!in_single && H5Tequal(type.get(), native_type<double>()) <= 0)) return std::nullopt;
  Shape chunk(check(H5Sget_simple_extent_ndims(space.get()), what)), extent(chunk.size());
  check(H5Sget_simple_extent_dims(space.get(), extent.data(), nullptr), what);
  if (extent.empty() || H5Pget_layout(properties.get()) != H5D_CHUNKED ||
      H5Pget_chunk(properties.get(), static_cast<int>(chunk.size()), chunk.data()) != static_cast<int>(chunk.size()))
    return std::nullopt;
  extent[0] = 1;
  if (extent != chunk) return std::nullopt;
  return RowLayout{count_of(chunk), in_single, *level};
#else
  return std::nullopt;
#endif
}

PackedRow pack_row([[maybe_unused]] const RowLayout& layout, [[maybe_unused]] const double* row) {
#ifdef RAILWAVE_CHUNKS
  try {
    return layout.in_single ? pack_row_as<float>(layout, row) : pack_row_as<double>(layout, row);
  } catch (const std::bad_alloc&) {
  }
#endif
  return {};
}

void write_chunk([[maybe_unused]] hid_t dataset, [[maybe_unused]] const std::string& name,
                 [[maybe_unused]] const Shape& offset, [[maybe_unused]] const void* bytes,
                 [[maybe_unused]] std::size_t size) {
#ifdef RAILWAVE_CHUNKS
  check(H5Dwrite_chunk(dataset, H5P_DEFAULT, 0, offset.data(), size, bytes), "writing " + name);
#endif
}

#define RAILWAVE_FOR_TYPE(T) \
  template bool write_chunks<T>(hid_t, const std::string&, hsize_t, const Shape&, const T*, const ThreadCount&);

RAILWAVE_EACH_VALUE_TYPE(RAILWAVE_FOR_TYPE)
#undef RAILWAVE_FOR_TYPE

}  // namespace railwave::hdf5
