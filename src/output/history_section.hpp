#pragma once

#include <string>
#include <utility>
#include <vector>

#include "output/hdf5.hpp"
#include "solve/observer.hpp"

namespace railwave {

/// Group /history of a results file: energies, contact forces, mean motions and section forces of beams against time. Samples are kept in memory
/// until they are written. Their times are written by themselves, last: see ResultsWriter::flush().
class HistorySection {
 public:
  /// Names of contacts and sets; names of the scene's beams with the numbers of their elements; where the sets are (m, undeformed), if
  /// that is known.
  HistorySection(const hdf5::Group& root, const std::vector<std::string>& contacts, const std::vector<std::string>& sets,
                 const std::vector<std::pair<std::string, int>>& beams = {}, const std::vector<Vec3>& positions = {});

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

  struct BeamColumns {
    Column<double> force, moment;
  };

  Column<double> times_;
  Column<long> steps_;
  std::vector<Column<double>> energies_;
  std::vector<ContactColumns> contacts_;
  std::vector<MotionColumns> sets_;
  std::vector<BeamColumns> beams_;
};

}  // namespace railwave
