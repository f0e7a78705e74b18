#pragma once

#include <string>
#include <vector>

#include "coupling.hpp"

namespace railwave::vehicle {

/// How well both sides account for the same energy, J.
struct EnergyClosure {
  double largest = 0;     ///< that has passed over the interface at a time, either way
  double difference = 0;  ///< the largest between what one side gave and the other got
};

/// All numbers of a sample, in the order of the table's columns.
std::vector<double> table_row(const CoupledSample& sample);

/// A coupled run as a table.
class VehicleTable {
 public:
  /// @param histories of the simulation, whose values the samples have
  VehicleTable(const Simulation& simulation, const std::vector<std::string>& histories);

  void add(const CoupledSample& sample);
  EnergyClosure closure() const;

  /// Writes CSV with names and units in its first line, all digits. Throws std::runtime_error where it cannot; then a
  /// file that was there is as it was.
  void write(const std::string& path) const;

  /// Writes the force of each load of the interface as FOLDER/LOAD.csv, a curve that a case can name.
  void write_curves(const std::string& folder, const Interface& interface) const;

 private:
  std::vector<std::string> columns_;
  std::vector<CoupledSample> samples_;
};

}  // namespace railwave::vehicle
