#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>

namespace railwave {

/// How ranks, processes of one run, reach each other. Messages between two of them arrive in the order in which they
/// were started. Bytes lie in the host's memory; those that are sent to one rank or received from one may lie in the
/// device's where takes_device_memory() says so.
class Transport {
 public:
  virtual ~Transport() = default;
  virtual int rank() const = 0;
  virtual int ranks() const = 0;
  /// This rank's side of it.
  virtual bool takes_device_memory() const = 0;

  /// From rank 0 to all. Others wait as long as rank 0 takes.
  virtual void broadcast(void* data, std::size_t bytes) = 0;

  virtual void start_send(int to, const void* data, std::size_t bytes) = 0;
  virtual void start_receive(int from, void* data, std::size_t bytes) = 0;
  /// Waits for all that was started. Ends all ranks with a message where one of them does not answer in time.
  virtual void finish() = 0;

  /// Waits until something of the other ranks' has come that is asked for again and again. Ends all ranks with a
  /// message where that takes too long.
  virtual void wait_until(const std::function<bool()>& come) = 0;

  /// The lowest rank that says no; -1: all say yes. Each waits for all others.
  virtual int first_to_refuse(bool yes) = 0;
  bool all_agree(bool yes) { return first_to_refuse(yes) < 0; }

  /// After an error that others must not wait for.
  [[noreturn]] virtual void end_all() = 0;

  bool followers_have_ended = false;  ///< see end_followers() in rank_team.hpp
};

/// All ranks have come so far in making a model, or none goes on.
/// Throws std::runtime_error where another one has not. Whoever fails itself answers the others by all_agree(false),
/// or ends all of them where it has no memory left for messages.
inline void meet(Transport& transport) {
  const int failed = transport.first_to_refuse(true);
  if (failed < 0) return;
  transport.followers_have_ended = true;
  throw std::runtime_error("rank " + std::to_string(failed) + " could not make the model; nothing was run");
}

/// All ranks have been given the same case with the same settings, or none goes on.
/// Throws std::runtime_error where another one's text differs from rank 0's.
inline void expect_one_case(Transport& transport, const std::string& text) {
  std::string of_rank_0 = text;
  std::size_t size = text.size();
  transport.broadcast(&size, sizeof size);
  of_rank_0.resize(size);
  transport.broadcast(of_rank_0.data(), size);
  const int other = transport.first_to_refuse(of_rank_0 == text);
  if (other < 0) return;
  transport.followers_have_ended = true;
  throw std::runtime_error("rank " + std::to_string(other) +
                           ": this process has another model than rank 0: all that mpirun starts must be given the "
                           "same program, case and settings");
}

// Of solve/ranks/mpi_transport.cpp:

/// The number of this process among those that a launcher of MPI has started together, before MPI is begun; 0: alone,
/// the first, or the program was built without MPI.
int rank_of_process();

/// Whether a launcher of MPI has started several processes together, and the program was built with MPI.
bool others_were_started();

/// Processes that are started from now on take themselves for alone.
void hide_ranks();

/// That of the processes which mpirun has started; null where this one is alone, or the program was built without MPI.
/// MPI is begun then, and ended with the transport.
std::unique_ptr<Transport> transport_of_processes();

}  // namespace railwave
