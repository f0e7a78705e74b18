#pragma once

#include <string>
#include <vector>

#include "output/hdf5.hpp"
#include "solve/observer.hpp"

namespace railwave {

/// Group /history of a results file: energies, contact forces and mean motions against time. Samples are kept in memory
/// until they are written. Their times are written by themselves, last: see ResultsWriter::flush().
class HistorySection {
 public:
  HistorySection(const hdf5::Group& root, const std::vector<std::string>& contacts, const std::vector<std::string>& sets);

  void add(const HistorySample& sample);
  std::size_t waiting() const { return times_.values.size(); }
  void write_values();
  void write_times();

 private:
  template <class T>
  struct Column {
    hdf5::Dataset dataset;
    std::vector<T> values;
    void write(hsize_t rows);
  };
  struct ContactColumns {
    Column<double> normal_force, tangential_force, master_force;
    Column<long> nodes_in_contact, nodes_slipping;
  };
  struct MotionColumns {
    Column<double> displacement, velocity, acceleration;
  };

  Column<double> times_;
  Column<long> steps_;
  std::vector<Column<double>> energies_;
  std::vector<ContactColumns> contacts_;
  std::vector<MotionColumns> sets_;
};

}  // namespace railwave
