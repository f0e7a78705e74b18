#pragma once

#include <string>
#include <utility>
#include <vector>

#include "post/history_series.hpp"
#include "post/signal_command.hpp"
#include "post/table.hpp"

namespace railwave {

inline constexpr double degrees_per_radian = 57.29577951308232;

/// What one kind of analysis found.
struct SignalReport {
  struct Array {
    std::string name, unit;
    hdf5::Shape shape;
    std::vector<double> values;
  };
  std::string text;                                     ///< for the screen
  std::vector<std::pair<std::string, Table>> tables;    ///< the first is the CSV; all are groups of the HDF5 file
  std::vector<Array> arrays;                            ///< its datasets
  std::vector<std::pair<std::string, double>> figures;  ///< its attributes
};

/// The channels of a request, one series for each of its entries, all at the same times and without their trend.
struct SignalInput {
  const SignalRequest& request;
  std::vector<HistorySeries> entries;

  double interval() const { return entries.front().interval; }
  double time(std::size_t n) const { return entries.front().time(n); }
  std::size_t length() const { return entries.front().length(); }
  std::vector<const HistoryChannel*> channels() const;  ///< of all entries
  std::size_t segment(std::size_t otherwise)
      const;  ///< samples in one of Welch's segments; `otherwise` where the request leaves it open
};

SignalReport report_psd(const SignalInput& input);
SignalReport report_wavelet(const SignalInput& input);
SignalReport report_bandpass(const SignalInput& input);
SignalReport report_cross(const SignalInput& input);
SignalReport report_ellipse(const SignalInput& input);
SignalReport report_speed(const SignalInput& input);

/// The two entries of a request that compares channels pair by pair: (first, second). Throws InputError unless there
/// are two of equal numbers.
std::vector<std::pair<const HistoryChannel*, const HistoryChannel*>> channel_pairs(const SignalInput& input);

/// Values in the request's band; as they are where it is open.
std::vector<double> in_band(const std::vector<double>& values, const SignalInput& input);

/// Unit of a product: "(m/s)2" or "N2" of a unit with itself.
std::string product_unit(const std::string& a, const std::string& b);

double mean_square(const std::vector<double>& values);

/// "from 100 Hz to 500 Hz", "above 100 Hz", "below 500 Hz", "at all frequencies".
std::string band_text(const SignalRequest& request);

}  // namespace railwave
