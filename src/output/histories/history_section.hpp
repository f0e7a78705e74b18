#pragma once

#include <string>
#include <utility>
#include <vector>

#include "output/hdf5/hdf5.hpp"
#include "output/histories/history_values.hpp"
#include "solve/observer.hpp"

namespace railwave {

/// A load whose force, or moment, is written.
struct LoadNames {
  std::string name, target;
  bool torque = false;
  bool hammer = false;  ///< made of one of [hammers.NAME]
  Vec3 direction{};     ///< of the force, where it doesn't turn; of a torque's axis
};

/// Group /history of a results file: energies, contact forces, mean motions, loads and section forces of beams against
/// time. Samples are kept in memory until they are written.
class HistorySection {
 public:
  /// Names of contacts and sets; names of the scene's beams with the numbers of their elements; where the sets are (m,
  /// undeformed), if that is known; loads; what in the case asked for each set, if known; which
  /// quantities of nodes are written of each set, all unless given; sets of which quantities of elements are written,
  /// which may have the names of others; names of prescribed motions.
  HistorySection(const hdf5::Group& root, const std::vector<std::string>& contacts,
                 const std::vector<std::string>& sets, const std::vector<std::pair<std::string, int>>& beams = {},
                 const std::vector<Vec3>& positions = {}, const std::vector<LoadNames>& loads = {},
                 const std::vector<std::string>& askers = {},
                 const std::vector<std::vector<const FieldRow*>>& motions = {},
                 const std::vector<HistorySet>& elements = {}, const std::vector<std::string>& prescribed_motions = {});

  void add(const HistorySample& sample);
  std::size_t waiting() const { return times_.values.size(); }
  void write();

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
  /// One quantity of a set; Values says where it is in the set's means.
  template <class Values>
  struct QuantityColumn {
    int components;
    Values values;
    Column<double> column;
    template <class Means>
    void push(const Means& means);
  };

  struct BeamColumns {
    Column<double> force, moment;
  };

  struct LoadColumn {
    bool torque;
    Column<double> value;  ///< force, three a row, or moment
    Column<double> work;
  };

  struct ReactionColumns {
    Column<double> force, work;
  };

  Column<double> times_;
  Column<long> steps_;
  std::vector<Column<double>> energies_;
  std::vector<ContactColumns> contacts_;
  std::vector<std::vector<QuantityColumn<MotionValues>>> sets_;
  std::vector<std::vector<QuantityColumn<ElementValues>>> elements_;
  std::vector<BeamColumns> beams_;
  std::vector<LoadColumn> loads_;
  std::vector<ReactionColumns> reactions_;
};

}  // namespace railwave
