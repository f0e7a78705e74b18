#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "post/results_reader.hpp"
#include "signal/frequency_response.hpp"

namespace railwave {

/// A load whose force is the input of a frequency response.
struct HammerInput {
  std::string load;
  std::string set;  ///< what it acts on
  Eigen::Vector3d direction;
};

/// Where and along what a response is taken.
struct HammerResponse {
  std::string set;
  Eigen::Vector3d direction;
  std::string name;  ///< SET:direction, as it was asked for
  std::string kind;  ///< direct, transfer (elsewhere, same direction) or cross (another direction)
};

/// How responses are made of histories.
struct ResponseSettings {
  /// Throws InputError naming the option that is out of range. `window` is "none" or "exponential".
  static ResponseSettings of(double resolution, const std::string& window, double window_end);

  double resolution = 1;  ///< Hz, at most, between two lines; zeros are added for that
  double window_end = 1;  ///< what the exponential window comes down to at the end; 1: none
};

/// What the user should know of the signals.
struct SignalNotes {
  std::vector<std::string> texts;  ///< each once
  double left_share = 0;           ///< of the largest acceleration at the end, where that is too much
  std::string left_at;             ///< set

  std::vector<std::string> summary() const;
};

/// One or several runs (blows) of the same hammer test.
class HammerTest {
 public:
  /// Throws InputError where a file can't be used, where the files have samples at different distances, and where
  /// `load` is empty and there is more than one load with a force (in files with hammers: more than one hammer).
  HammerTest(const std::vector<std::string>& files, const std::string& load);

  const HammerInput& input() const { return input_; }
  const ResultsReader& first() const { return results_.front(); }
  std::size_t blows() const { return results_.size(); }

  /// What the command line asks for by `SET[:DIRECTION]`. SET is a history set, the part of its name behind the dot, a
  /// pattern with *, or the name of a row of probes. DIRECTION is x, y, z, -x, -y, -z, a vector 1,0,0.5, or vertical,
  /// lateral, longitudinal: z, y, x turned to the side to which the force points; absent: that of the force.
  std::vector<HammerResponse> find(const std::string& text) const;

  /// All history sets of the files that hammers or probes asked for, else all, along the force; the struck one first.
  std::vector<HammerResponse> all() const;

  /// Accelerance; adds to the notes.
  FrequencyResponse accelerance(const HammerResponse& response, const ResponseSettings& settings,
                                SignalNotes& notes) const;

  /// m, where the set lies; nothing in files of older programs.
  std::optional<Eigen::Vector3d> place(const std::string& set) const;

  /// 1/s, of the exponential window.
  double decay(const ResponseSettings& settings) const;

 private:
  void choose_input(const std::string& load);
  void check_texts() const;
  Eigen::Vector3d direction_of(const std::string& text, const std::string& asked) const;
  std::vector<std::string> sets_named(const std::string& name) const;
  HammerResponse response(const std::string& set, const Eigen::Vector3d& direction, const std::string& text) const;
  std::string asker(const std::string& set) const;

  std::vector<ResultsReader> results_;
  std::vector<std::string> sets_;
  HammerInput input_;
  double duration_ = 0, interval_ = 0;
};

}  // namespace railwave
