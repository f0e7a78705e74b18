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

/// A piece of memory that is copied in each exchange. Places with two buffers have the second so many words behind.
struct CopiedPiece {
  const Word* from;
  Word* to;
  long first;  ///< of its words among those of all pieces
  long from_stride, to_stride;
};

/// Copies all pieces, by word. Every second exchange takes the second buffers.
struct CopyPieces {
  Array<const CopiedPiece*> pieces;
  Array<const Word*> exchanges;  ///< so many are over
  Word over;                     ///< when the first was copied
  bool for_others;

  KOKKOS_INLINE_FUNCTION void operator()(const long i) const {
    int k = 0;
    while (k + 1 < static_cast<int>(pieces.extent(0)) && pieces(k + 1).first <= i) ++k;
    const CopiedPiece& piece = pieces(k);
    const long second = static_cast<long>((exchanges(0) - over) & 1), word = i - piece.first;
    piece.to[word + second * piece.to_stride] = piece.from[word + second * piece.from_stride];
    if (for_others) fence_of_host();
  }
};

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

long words_of(std::size_t bytes) { return static_cast<long>(bytes / sizeof(Word)); }

/// What a rank packs is written into its neighbours' memory by a kernel. A count there says that it has come, for which
/// one thread waits. A neighbour writes into a buffer again when it has seen the count of the exchange between, before
/// which this rank has copied what the buffer had: so two buffers do.
class DirectMessages : public DeviceLanes {
 public:
  DirectMessages(Transport& transport, const ExchangeLoad& load)
      : memory_(counts_end(load) + 2 * received_words(load)), given_up_("given up", 1) {
    const long stride = received_words(load);
    std::vector<Invitation> sent, received(load.parts.size());
    long first = counts_end(load);
    const std::array<char, 16> device = number_of_device();
    for (std::size_t k = 0; k < load.parts.size(); ++k) {
      sent.push_back({memory_.handle(), device, first, stride, count_stride * static_cast<long>(k), memory_.open()});
      ways_.push_back({load.parts[k].other, first, nullptr, 0});
      first += words_of(load.parts[k].received);
      transport.start_receive(load.parts[k].other, &received[k], sizeof(Invitation));
    }
    for (std::size_t k = 0; k < load.parts.size(); ++k)
      transport.start_send(load.parts[k].other, &sent[k], sizeof(Invitation));
    transport.finish();
    stride_ = stride;
    std::vector<CountThere> theirs;
    for (std::size_t k = 0; k < load.parts.size(); ++k) {
      const Invitation& from = received[k];
      if (!from.valid || !memory_.open() || from.device == device) return;
      reached_.push_back(std::make_unique<ReachedMemory>(from.memory));
      Word* const words = reached_.back()->words();
      if (words == nullptr) return;
      ways_[k].there = words + from.first_word;
      ways_[k].stride_there = from.stride;
      theirs.push_back({words + from.count});
    }
    theirs_ = to_device("counts of neighbours", theirs);
    exchanges_ = Array<Word*>("exchanges", 1);
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

  void exchange(const std::vector<Message>& messages_of_step) override {
    if (sent_.extent(0) + received_.extent(0) == 0) list_pieces(messages_of_step);
    const ExecutionSpace& space = this->space(RankLane::messages);
    if (words_sent_ > 0)
      Kokkos::parallel_for("write_to_neighbours", Words(space, 0, words_sent_), CopyPieces{sent_, exchanges_, 0, true});
    Kokkos::parallel_for("meet_neighbours", SpreadRange(space, 0, 1),
                         Meet{theirs_, memory_.words(), count_stride, exchanges_, given_up_.data()});
    if (words_received_ > 0)
      Kokkos::parallel_for("take_what_came", Words(space, 0, words_received_),
                           CopyPieces{received_, exchanges_, 1, false});
  }

 private:
  using Words = Kokkos::RangePolicy<ExecutionSpace, Kokkos::IndexType<long>, AsArgument>;
  static constexpr int count_stride = 16;  ///< words: a cache line each

  /// To and from a neighbour.
  struct Way {
    int other;
    long here;    ///< word of this GPU's memory
    Word* there;  ///< of the first buffer
    long stride_there;
  };

  static long counts_end(const ExchangeLoad& load) { return count_stride * static_cast<long>(load.parts.size()); }
  static long received_words(const ExchangeLoad& load) {
    long words = 0;
    for (const ExchangeLoad::Part& part : load.parts) words += words_of(part.received);
    return words;
  }

  /// They are the same in all exchanges.
  void list_pieces(const std::vector<Message>& messages_of_step) {
    std::vector<CopiedPiece> sent, received;
    for (const Way& way : ways_) {
      long there = 0, here = way.here;
      for (const Message& one : messages_of_step) {
        if (one.other != way.other) continue;
        if (one.sent_bytes > 0) {
          sent.push_back({static_cast<const Word*>(one.sent), way.there + there, words_sent_, 0, way.stride_there});
          there += words_of(one.sent_bytes);
          words_sent_ += words_of(one.sent_bytes);
        }
        if (one.received_bytes > 0) {
          received.push_back({memory_.words() + here, static_cast<Word*>(one.received), words_received_, stride_, 0});
          here += words_of(one.received_bytes);
          words_received_ += words_of(one.received_bytes);
        }
      }
    }
    sent_ = to_device("pieces sent", sent);
    received_ = to_device("pieces received", received);
  }

  OpenMemory memory_;
  PinnedArray<int*> given_up_;
  long stride_ = 0;
  std::vector<Way> ways_;
  std::vector<std::unique_ptr<ReachedMemory>> reached_;
  Array<CountThere*> theirs_;
  Array<Word*> exchanges_;
  Array<CopiedPiece*> sent_, received_;
  long words_sent_ = 0, words_received_ = 0;
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
