#pragma once

#include <Eigen/Core>
#include <new>
#include <string>
#include <vector>

#include "case/error.hpp"
#include "output/hdf5/hdf5.hpp"

namespace railwave {

/// Reads a results file, also one whose run was killed.
class ResultsReader {
 public:
  /// Throws InputError saying what is wrong: no such file, no HDF5 file, cut short, not Railwave's, of a newer
  /// Railwave.
  explicit ResultsReader(const std::string& path);

  const std::string& path() const { return path_; }

  /// What `read` returns, which reads this file: what it throws becomes an InputError that names the file as damaged.
  template <class Read>
  auto report_damage(const Read& read) const {
    try {
      return read();
    } catch (const InputError&) {
      throw;
    } catch (const std::bad_alloc&) {
      throw;
    } catch (const std::exception& error) {
      throw InputError("results file " + path_ + " is damaged: " + error.what());
    }
  }

  const std::string& title() const { return title_; }
  bool completed() const;
  std::string reason() const;  ///< why not completed

  std::vector<std::string> contacts() const;

  /// Name of its slave surface in the case.
  std::string slave_surface(const std::string& contact) const;

  /// Its group in the file; see ContactReader.
  hdf5::Group contact_group(const std::string& contact) const;

  /// Velocity of one of the run's history sets, m/s, at each of `times`, between two samples in proportion. Throws
  /// InputError if there is no such set.
  std::vector<Eigen::Vector3d> set_velocity(const std::string& set, const std::vector<double>& times) const;

  hdf5::Group root() const { return file_.root(); }

  /// Group /history. Throws InputError if there is none.
  hdf5::Group history() const;

 private:
  std::string path_, title_;
  hdf5::File file_;
};

/// A dataset of three numbers. Throws std::runtime_error if it has others.
Eigen::Vector3d read_vector(const hdf5::Group& group, const std::string& name);

}  // namespace railwave
