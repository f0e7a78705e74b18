#include "model/ranks/transport.hpp"

#ifdef RAILWAVE_MPI
#include <mpi.h>
// What else than the standard's functions there is. MPICH has its own in mpi.h.
#if (defined(OPEN_MPI) || defined(MVAPICH2_VERSION)) && __has_include(<mpi-ext.h>)
#include <mpi-ext.h>
#endif
#endif

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <iostream>
#include <stdexcept>
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

/// MPI counts bytes in an int.
constexpr std::size_t most_bytes = std::size_t{1} << 30;
constexpr int failed = 1;

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
    check(MPI_Bcast(data, static_cast<int>(bytes), MPI_BYTE, 0, MPI_COMM_WORLD), "tell all ranks");
  }

  void start_send(int to, const void* data, std::size_t bytes) override {
    const auto* from = static_cast<const char*>(data);
    for (std::size_t at = 0; at < bytes; at += most_bytes)
      check(MPI_Isend(from + at, static_cast<int>(std::min(most_bytes, bytes - at)), MPI_BYTE, to, 0, MPI_COMM_WORLD,
                      next(to)),
            "send");
  }

  void start_receive(int from, void* data, std::size_t bytes) override {
    auto* to = static_cast<char*>(data);
    for (std::size_t at = 0; at < bytes; at += most_bytes)
      check(MPI_Irecv(to + at, static_cast<int>(std::min(most_bytes, bytes - at)), MPI_BYTE, from, 0, MPI_COMM_WORLD,
                      next(from)),
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

  void wait_until(const std::function<bool()>& come) override {
    const auto began = std::chrono::steady_clock::now();
    while (!come())
      if (std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count() > patience_) give_up();
  }

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

  [[noreturn]] void give_up() {
    // Of rows that go from GPU to GPU it is not known whose are missing, but with two ranks.
    int silent = ranks_ == 2 ? 1 - rank_ : -1;
    for (std::size_t k = 0; k < requests_.size(); ++k) {
      int done = 0;
      MPI_Test(&requests_[k], &done, MPI_STATUS_IGNORE);
      if (done == 0) silent = others_[k];
    }
    std::cerr << fmt::format(
                     "railwave: {} has not answered rank {} for {:.0f} s; all ranks end. The last checkpoint is "
                     "good: --restart goes on from it, on any number of ranks",
                     silent < 0 ? std::string("another rank") : fmt::format("rank {}", silent), rank_, patience_)
              << std::endl;
    end_all();
  }

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
