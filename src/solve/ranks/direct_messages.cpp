#include <array>
#include <cstring>

#include "model/host_copy.hpp"
#include "solve/ranks/device_lanes.hpp"

#ifdef KOKKOS_ENABLE_CUDA
#include <desul/atomics.hpp>
#endif

namespace railwave {

#ifdef KOKKOS_ENABLE_CUDA

namespace {

using Word = unsigned long long;

/// What other GPUs of the host see comes after what they have been shown before.
KOKKOS_INLINE_FUNCTION void fence_of_host() {
  desul::atomic_thread_fence(desul::MemoryOrderAcqRel(), desul::MemoryScopeNode());
}

/// A count in another GPU's memory.
struct CountThere {
  volatile Word* word;
};

/// Lets the neighbours know that what is theirs has been written, and waits until they have written. One thread.
struct Meet {
  Array<const CountThere*> theirs;  ///< by neighbour: its count of this rank's exchanges
  const volatile Word* mine;        ///< by neighbour, some words apart: this rank's count of its exchanges
  int stride;
  Array<Word*> exchanges;
  const volatile int* given_up;  ///< on the host

  KOKKOS_INLINE_FUNCTION void operator()(const int) const {
    const Word now = exchanges(0) + 1;
    const int neighbours = static_cast<int>(theirs.extent(0));
    fence_of_host();
    for (int k = 0; k < neighbours; ++k) *theirs(k).word = now;
    constexpr long between_looks = 1 << 16;  // at the host's memory, which is far
    for (int k = 0; k < neighbours; ++k)
      for (long looks = 1; mine[k * stride] < now; ++looks)
        if (looks % between_looks == 0 && *given_up != 0) return;
    fence_of_host();
    exchanges(0) = now;
  }
};

/// What a rank lets a neighbour know of the memory that it may write to.
struct Invitation {
  cudaIpcMemHandle_t memory;
  std::array<char, 16> device;  ///< its number in the world
  long first_word;              ///< of what comes from that neighbour
  long stride;                  ///< words from the first buffer to the second
  long count;                   ///< word with the count of that neighbour's exchanges
  bool valid;
};

/// Memory of this GPU to which neighbours write: counts of exchanges, then two buffers for what they send.
class OpenMemory {
 public:
  explicit OpenMemory(long words) {
    const std::size_t bytes = sizeof(Word) * words;
    if (cudaMalloc(&words_, bytes) != cudaSuccess) words_ = nullptr;
    open_ = words_ != nullptr && cudaMemset(words_, 0, bytes) == cudaSuccess &&
            cudaDeviceSynchronize() == cudaSuccess && cudaIpcGetMemHandle(&handle_, words_) == cudaSuccess;
    cudaGetLastError();
  }
  ~OpenMemory() { cudaFree(words_); }
  OpenMemory(const OpenMemory&) = delete;
  OpenMemory& operator=(const OpenMemory&) = delete;

  bool open() const { return open_; }
  Word* words() const { return static_cast<Word*>(words_); }
  const cudaIpcMemHandle_t& handle() const { return handle_; }

 private:
  void* words_ = nullptr;
  cudaIpcMemHandle_t handle_{};
  bool open_ = false;
};

/// That of another process.
class ReachedMemory {
 public:
  explicit ReachedMemory(const cudaIpcMemHandle_t& handle) {
    if (cudaIpcOpenMemHandle(&words_, handle, cudaIpcMemLazyEnablePeerAccess) != cudaSuccess) words_ = nullptr;
    cudaGetLastError();
  }
  ~ReachedMemory() {
    if (words_ != nullptr) cudaIpcCloseMemHandle(words_);
  }
  ReachedMemory(const ReachedMemory&) = delete;
  ReachedMemory& operator=(const ReachedMemory&) = delete;

  Word* words() const { return static_cast<Word*>(words_); }

 private:
  void* words_ = nullptr;
};

std::array<char, 16> number_of_device() {
  std::array<char, 16> number{};
  int device = 0;
  cudaDeviceProp properties{};
  check(cudaGetDevice(&device), "say its device");
  check(cudaGetDeviceProperties(&properties, device), "describe its device");
  std::memcpy(number.data(), properties.uuid.bytes, number.size());
  return number;
}

constexpr int words_of_line = 16;

/// Whole cache lines, in words.
long words_of(std::size_t bytes) {
  constexpr std::size_t line = words_of_line * sizeof(Word);
  return static_cast<long>((bytes + line - 1) / line) * words_of_line;
}

unsigned char* bytes_at(Word* word) { return reinterpret_cast<unsigned char*>(word); }

/// A rank packs into its neighbours' memory. A count there says that all has come, for which one thread waits. A
/// neighbour packs into a buffer again when it has seen the count of the exchange between, before which this rank has
/// unpacked what the buffer had: so two buffers do.
class DirectMessages : public DeviceLanes {
 public:
  DirectMessages(Transport& transport, const ExchangeLoad& load)
      : memory_(counts_end(load) + 2 * received_words(load)), given_up_("given up", 1) {
    const long stride = received_words(load);
    std::vector<Invitation> sent, received(load.parts.size());
    long first = counts_end(load);
    const std::array<char, 16> device = number_of_device();
    for (std::size_t k = 0; k < load.parts.size(); ++k) {
      sent.push_back({memory_.handle(), device, first, stride, words_of_line * static_cast<long>(k), memory_.open()});
      lent_.parts.push_back({nullptr, bytes_at(memory_.words() + first), 0, bytes_of(stride)});
      first += words_of(load.parts[k].received);
      transport.start_receive(load.parts[k].other, &received[k], sizeof(Invitation));
    }
    for (std::size_t k = 0; k < load.parts.size(); ++k)
      transport.start_send(load.parts[k].other, &sent[k], sizeof(Invitation));
    transport.finish();
    std::vector<CountThere> theirs;
    for (std::size_t k = 0; k < load.parts.size(); ++k) {
      const Invitation& from = received[k];
      if (!from.valid || !memory_.open() || from.device == device) return;
      reached_.push_back(std::make_unique<ReachedMemory>(from.memory));
      Word* const words = reached_.back()->words();
      if (words == nullptr) return;
      lent_.parts[k].sent = bytes_at(words + from.first_word);
      lent_.parts[k].second_sent = bytes_of(from.stride);
      theirs.push_back({words + from.count});
    }
    theirs_ = to_device("counts of neighbours", theirs);
    exchanges_ = Array<Word*>("exchanges", 1);
    lent_.exchanges = exchanges_.data();
    ready_ = true;
  }
  ~DirectMessages() override {
    if (given_up()) const_cast<volatile int&>(given_up_(0)) = 1;
    cudaStreamSynchronize(messages());
  }
  DirectMessages(const DirectMessages&) = delete;
  DirectMessages& operator=(const DirectMessages&) = delete;

  /// Whether the rank reaches all of its neighbours.
  bool ready() const { return ready_; }

  const LentMemory* lent() const override { return &lent_; }

  void exchange(const std::vector<Message>& /*messages*/) override {
    Kokkos::parallel_for("meet_neighbours", SpreadRange(space(RankLane::messages), 0, 1),
                         Meet{theirs_, memory_.words(), words_of_line, exchanges_, given_up_.data()});
  }

 private:
  static long bytes_of(long words) { return words * static_cast<long>(sizeof(Word)); }
  static long counts_end(const ExchangeLoad& load) { return words_of_line * static_cast<long>(load.parts.size()); }
  static long received_words(const ExchangeLoad& load) {
    long words = 0;
    for (const ExchangeLoad::Part& part : load.parts) words += words_of(part.received);
    return words;
  }

  OpenMemory memory_;
  PinnedArray<int*> given_up_;
  LentMemory lent_{};
  std::vector<std::unique_ptr<ReachedMemory>> reached_;
  Array<CountThere*> theirs_;
  Array<Word*> exchanges_;
  bool ready_ = false;
};

}  // namespace

std::unique_ptr<DeviceMessages> direct_messages(Transport& transport, const ExchangeLoad& load) {
  auto messages = std::make_unique<DirectMessages>(transport, load);
  if (!transport.all_agree(messages->ready())) return nullptr;
  return messages;
}

#else

std::unique_ptr<DeviceMessages> direct_messages(Transport& /*transport*/, const ExchangeLoad& /*load*/) {
  return nullptr;
}

#endif

}  // namespace railwave
