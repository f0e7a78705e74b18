#include "model/ranks/transport.hpp"

#ifdef RAILWAVE_MPI
#include <mpi.h>
// What else than the standard's functions there is. MPICH has its own in mpi.h.
#if (defined(OPEN_MPI) || defined(MVAPICH2_VERSION)) && __has_include(<mpi-ext.h>)
#include <mpi-ext.h>
#endif
#endif

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <iostream>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "case/error.hpp"
#include "case/number_text.hpp"
#include "kernels/support/spaces.hpp"

namespace railwave {

#ifdef RAILWAVE_MPI
namespace {

/// s that a rank may take for its part of a step before the others give up, unless RAILWAVE_RANK_PATIENCE says
/// otherwise. Only steps are waited for so: while rank 0 settles the scene or writes, the others wait without end.
constexpr double usual_patience = 25;

double patience_of_user() {
  const char* const text = std::getenv("RAILWAVE_RANK_PATIENCE");
  if (text == nullptr || *text == 0) return usual_patience;
  const auto seconds = parse_real(text);
  if (!seconds || !(*seconds > 0))
    throw InputError(fmt::format(
        "the environment variable RAILWAVE_RANK_PATIENCE is '{}': a time in s above 0 is wanted, such as 60; unset it "
        "for {:.0f} s",
        text, usual_patience));
  return *seconds;
}

/// s that ranks may take to answer whether they live. Whoever waits for another answers at once.
constexpr double patience_for_answers = 3;

/// MPI counts bytes in an int.
constexpr std::size_t most_bytes = std::size_t{1} << 30;
constexpr int failed = 1;

/// What messages of one kind are known by: data, "do you live?" and "yes". The last two are empty.
enum Tag : int { data_tag, question_tag, answer_tag };

/// s by a clock that only goes on.
double clock_time() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

void check(int code, const char* what) {
  if (code == MPI_SUCCESS) return;
  char text[MPI_MAX_ERROR_STRING] = {};
  int length = 0;
  MPI_Error_string(code, text, &length);
  throw std::runtime_error(fmt::format("MPI could not {}: {}", what, text));
}

#if defined(MPIX_GPU_SUPPORT_CUDA) || defined(MPIX_GPU_SUPPORT_HIP)
bool mpich_takes(int kind_of_gpu) {
  int yes = 0;
  check(MPIX_GPU_query_support(kind_of_gpu, &yes), "say whether it takes a GPU's memory");
  return yes != 0;
}
#endif

/// What MPI says of the memory of GPUs; false where it cannot be asked. MPI must have begun.
bool takes_gpu_memory() {
#if defined(KOKKOS_ENABLE_IMPL_CUDA_MALLOC_ASYNC) || defined(KOKKOS_ENABLE_IMPL_HIP_MALLOC_ASYNC)
  return false;  // Kokkos takes memory from a pool that other processes cannot be shown
#elif defined(KOKKOS_ENABLE_HIP)
#if defined(OMPI_HAVE_MPI_EXT_ROCM)
  return MPIX_Query_rocm_support() == 1;
#elif defined(MPIX_GPU_SUPPORT_HIP)
  return mpich_takes(MPIX_GPU_SUPPORT_HIP);
#else
  return false;
#endif
#elif defined(MPIX_CUDA_AWARE_SUPPORT)
  return MPIX_Query_cuda_support() == 1;
#elif defined(MPIX_GPU_SUPPORT_CUDA)
  return mpich_takes(MPIX_GPU_SUPPORT_CUDA);
#else
  return false;
#endif
}

class MpiTransport : public Transport {
 public:
  MpiTransport() {
    MPI_Init(nullptr, nullptr);
    MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
    MPI_Comm_size(MPI_COMM_WORLD, &ranks_);
    takes_device_memory_ = !on_device || takes_gpu_memory();
  }
  ~MpiTransport() override { MPI_Finalize(); }
  MpiTransport(const MpiTransport&) = delete;
  MpiTransport& operator=(const MpiTransport&) = delete;

  int rank() const override { return rank_; }
  int ranks() const override { return ranks_; }
  bool takes_device_memory() const override { return takes_device_memory_; }

  void broadcast(void* data, std::size_t bytes) override {
    MPI_Request request;
    check(MPI_Ibcast(data, static_cast<int>(bytes), MPI_BYTE, 0, MPI_COMM_WORLD, &request), "send to all ranks");
    wait_until([&] { return is_done(request); }, rank_ == 0 ? patience_ : without_end);
  }

  void start_send(int to, const void* data, std::size_t bytes) override {
    const auto* from = static_cast<const char*>(data);
    for (std::size_t at = 0; at < bytes; at += most_bytes)
      check(MPI_Isend(from + at, static_cast<int>(std::min(most_bytes, bytes - at)), MPI_BYTE, to, data_tag,
                      MPI_COMM_WORLD, next(to)),
            "send");
  }

  void start_receive(int from, void* data, std::size_t bytes) override {
    auto* to = static_cast<char*>(data);
    for (std::size_t at = 0; at < bytes; at += most_bytes)
      check(MPI_Irecv(to + at, static_cast<int>(std::min(most_bytes, bytes - at)), MPI_BYTE, from, data_tag,
                      MPI_COMM_WORLD, next(from)),
            "receive");
  }

  void finish() override {
    if (!requests_.empty())
      wait_until([this] {
        int done = 0;
        check(MPI_Testall(static_cast<int>(requests_.size()), requests_.data(), &done, MPI_STATUSES_IGNORE), "wait");
        return done != 0;
      });
    requests_.clear();
    others_.clear();
  }

  void wait_until(const std::function<bool()>& come) override { wait_until(come, patience_); }

  int first_to_refuse(bool yes) override {
    int own = yes ? ranks_ : rank_, least = 0;
    check(MPI_Allreduce(&own, &least, 1, MPI_INT, MPI_MIN, MPI_COMM_WORLD), "agree");
    return least == ranks_ ? -1 : least;
  }

  [[noreturn]] void end_all() override {
    MPI_Abort(MPI_COMM_WORLD, failed);
    std::abort();
  }

 private:
  MPI_Request* next(int other) {
    others_.push_back(other);
    requests_.push_back(MPI_REQUEST_NULL);
    return &requests_.back();
  }

  static bool is_done(MPI_Request& request) {
    int done = 0;
    check(MPI_Test(&request, &done, MPI_STATUS_IGNORE), "wait");
    return done != 0;
  }

  /// @param patience s
  template <class Come>
  void wait_until(const Come& come, double patience) {
    constexpr double usual_wait = 0.1;  // s that nobody loses patience in, so that no question can have come
    double began = clock_time();
    for (bool once_more = true; !come();) {
      const double waited = clock_time() - began;
      if (waited > usual_wait) answer_questions();
      if (!(waited > patience)) continue;
      // Where all live, all may have been held for a while, as by a scheduler, and what is waited for comes now.
      const std::vector<int> silent = silent_ranks();
      if (!silent.empty() || !once_more) give_up(silent);
      once_more = false;
      began = clock_time();
    }
  }

  static void answer_questions() {
    for (;;) {
      int asked = 0;
      MPI_Status status;
      check(MPI_Iprobe(MPI_ANY_SOURCE, question_tag, MPI_COMM_WORLD, &asked, &status), "look for questions");
      if (asked == 0) return;
      check(MPI_Recv(nullptr, 0, MPI_BYTE, status.MPI_SOURCE, question_tag, MPI_COMM_WORLD, MPI_STATUS_IGNORE),
            "receive a question");
      check(MPI_Send(nullptr, 0, MPI_BYTE, status.MPI_SOURCE, answer_tag, MPI_COMM_WORLD), "answer");
    }
  }

  /// Ranks that do not answer whether they live: they are stopped or busy. One that waits for others answers.
  std::vector<int> silent_ranks() {
    std::vector<MPI_Request> answers(ranks_, MPI_REQUEST_NULL);
    for (int other = 0; other < ranks_; ++other) {
      if (other == rank_) continue;
      MPI_Request question;
      check(MPI_Irecv(nullptr, 0, MPI_BYTE, other, answer_tag, MPI_COMM_WORLD, &answers[other]), "receive an answer");
      check(MPI_Isend(nullptr, 0, MPI_BYTE, other, question_tag, MPI_COMM_WORLD, &question), "ask");
      check(MPI_Request_free(&question), "ask");
    }
    std::vector<int> silent;
    const double began = clock_time();
    do {
      answer_questions();
      silent.clear();
      for (int other = 0; other < ranks_; ++other)
        if (!is_done(answers[other])) silent.push_back(other);
    } while (!silent.empty() && clock_time() - began < patience_for_answers);
    return silent;
  }

  /// Another rank that this one waits for; -1: of rows that go from GPU to GPU it is not known whose are missing, but
  /// with two ranks.
  int awaited_rank() {
    for (std::size_t k = 0; k < requests_.size(); ++k)
      if (!is_done(requests_[k])) return others_[k];
    return ranks_ == 2 ? 1 - rank_ : -1;
  }

  /// @param silent ranks that do not answer: who is waited for may wait for another itself
  [[noreturn]] void give_up(std::vector<int> silent) {
    if (silent.empty()) silent = {awaited_rank()};
    const std::string who = silent.size() > 1 ? fmt::format("ranks {} have", fmt::join(silent, ", "))
                            : silent[0] < 0   ? "another rank has"
                                              : fmt::format("rank {} has", silent[0]);
    std::cerr << fmt::format(
                     "railwave: {} not answered rank {} for {:.0f} s; all ranks end. If there is a checkpoint, "
                     "--restart goes on from the last one, on any number of ranks",
                     who, rank_, patience_)
              << std::endl;
    end_all();
  }

  static constexpr double without_end = std::numeric_limits<double>::infinity();
  const double patience_ = patience_of_user();
  int rank_ = 0, ranks_ = 1;
  bool takes_device_memory_ = false;
  std::vector<MPI_Request> requests_;
  std::vector<int> others_;  ///< by request
};

/// What launchers of MPI (Open MPI, MPICH) have set; 0: nothing.
int launched(const char* of_open_mpi, const char* of_mpich) {
  for (const char* name : {of_open_mpi, of_mpich})
    if (const char* text = std::getenv(name)) return std::max(0, std::atoi(text));
  return 0;
}

/// Other processes that start several programs, such as a scheduler's, leave each of them a run of its own.
int started_together() { return launched("OMPI_COMM_WORLD_SIZE", "PMI_SIZE"); }

}  // namespace

int rank_of_process() { return started_together() < 2 ? 0 : launched("OMPI_COMM_WORLD_RANK", "PMI_RANK"); }

bool others_were_started() { return started_together() >= 2; }

void hide_ranks() {
  for (const char* name : {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE"}) unsetenv(name);
}

std::unique_ptr<Transport> transport_of_processes() {
  if (!others_were_started()) return nullptr;
  auto transport = std::make_unique<MpiTransport>();
  if (transport->ranks() < 2) return nullptr;
  return transport;
}

#else

int rank_of_process() { return 0; }

bool others_were_started() { return false; }

void hide_ranks() {}

std::unique_ptr<Transport> transport_of_processes() { return nullptr; }

#endif

}  // namespace railwave
