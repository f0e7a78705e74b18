#pragma once

#include <string>
#include <vector>

#include "model/contact/contact_state.hpp"
#include "output/hdf5/hdf5.hpp"

namespace railwave {

class ResultsReader;

/// Reads what one contact did from a results file, also from one whose run was killed.
class ContactReader {
 public:
  /// Throws InputError: no such contact, or the file is damaged, or lacks what a contact solution is made of.
  ContactReader(const ResultsReader& results, const std::string& contact);

  /// Output times that are there in full, s.
  const std::vector<double>& times() const { return times_; }

  /// State at one of these. Of a case with output.contact_margin it has the nodes near the contact; of one with
  /// output.contact_fields what is not there is left empty, but areas and normals, which follow from the positions.
  /// Throws InputError where the file is damaged.
  ContactState state(std::size_t index) const;

 private:
  struct Side {
    hdf5::Group group;
    bool written = false, near_only = false;
    std::vector<int> nodes;
    std::vector<std::array<int, 4>> facets;
    std::vector<double> coordinates;  ///< read where there are no positions
    std::vector<long> rows;           ///< of near nodes, up to each output

    struct Rows {
      hsize_t first, count;
    };
    bool has(const std::string& name) const { return written && group.has(name); }
    std::size_t outputs(std::size_t most) const;
    Rows rows_of(std::size_t output) const;
    /// Of one output; empty where they are not written. Throws std::runtime_error unless there are `count`.
    template <class Value>
    std::vector<Value> values(const char* name, std::size_t output, std::size_t count) const;
  };
  Side side(const hdf5::Group& contact, bool slave) const;
  ContactState read(std::size_t index) const;
  ContactSide read_side(const Side& side, std::size_t index) const;

  std::string path_, contact_;
  double friction_ = 0;
  Side slave_, master_;
  std::vector<double> times_;
};

/// The states of several contacts at one instant as that of one: where a body's surface touches two rails beside a gap,
/// or both sides of a crack, each by a contact of its own, its patch is one.
///
/// Nodes that several contacts have are there once, with the sum of their forces; each slave node slips as in the
/// contact in which it touches, by that one's friction, and has the least gap. What one of the states lacks the whole
/// lacks. Throws std::logic_error without a state.
/// @param states all at one instant, of one results file
ContactState contacts_together(const std::vector<ContactState>& states);

}  // namespace railwave
