#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "model/ranks/transport.hpp"

/// Runs of several processes, which mpirun starts. Rank 0 is the program as it is alone: it reads, writes, reports and
/// decides; the others say nothing and compute what it asks for.
namespace railwave {

/// What another rank does in place of `railwave run`. @return its exit code: that of rank 0 is what counts
int follow_run(const std::string& case_file, const std::vector<std::string>& overrides);

/// Rank 0's word that it begins the run, or, where this ends before, that it does not.
class OtherRanks {
 public:
  /// Throws TooLittleMemory where MPI would not find enough to begin, std::runtime_error where another rank has been
  /// given another case, or the same with other settings.
  OtherRanks(const std::string& case_file, const std::vector<std::string>& overrides);
  ~OtherRanks();
  OtherRanks(const OtherRanks&) = delete;
  OtherRanks& operator=(const OtherRanks&) = delete;

  /// Throws std::runtime_error where another rank could not make the model.
  void begin();
  /// Null: there are none.
  Transport* transport() const { return transport_.get(); }

  /// Does `work`. Where that ends for want of memory, or fails after begin(), other than by the user's input, all ranks
  /// end with a message: the others may be waiting for this one in the middle of a step. What else it throws passes
  /// through.
  int end_together(const std::function<int()>& work);

 private:
  std::unique_ptr<Transport> transport_;
  bool told_ = false;
};

}  // namespace railwave
