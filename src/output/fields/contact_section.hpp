#pragma once

#include <optional>
#include <vector>

#include "model/sets/point_search.hpp"
#include "output/fields/field_snapshot.hpp"
#include "output/hdf5/hdf5.hpp"

namespace railwave {

/// Group /contact/NAME of a results file: both surfaces of one contact pair at each output time. Made from the pair's
/// first state, whose nodes and facets hold for the whole run.
class ContactSection {
 public:
  /// @param margin m, see scene::Output::contact_margin
  ContactSection(const hdf5::Group& contacts_group, const FieldSource& source, int contact,
                 std::optional<double> margin = {});

  /// Writes the state at one more output time, then its time: see ResultsWriter::flush().
  void add_values(const FieldSource& source, long step);
  void add_time(double time) { times_.append(&time, 1); }

  std::size_t node_count(bool slave) const { return side(slave).nodes.size(); }
  std::size_t facet_count(bool slave) const { return side(slave).facet_count; }

 private:
  struct Side {
    std::vector<int> nodes;
    std::size_t facet_count = 0;
    hdf5::Dataset area, displacement, position, velocity, normal, normal_force, tangential_force, pressure, shear;
    Side() = default;
    Side(const hdf5::Group& group, const ContactSide& first, const FieldSource& source);
    /// @param box outside of which nodes have no values
    void add(const ContactSide& state, const FieldSource& source, const std::optional<Bounds>& box);
  };
  const Side& side(bool slave) const { return slave ? slave_ : master_; }

  int contact_;
  std::optional<double> margin_;
  bool falling_friction_;
  Side slave_, master_;
  hdf5::Dataset times_, steps_, gap_, slip_velocity_, slipping_, friction_;
};

/// Of each node of one side: the contact force along the inward normal over the node's area, Pa, pressure positive.
std::vector<double> nodal_pressure(const ContactSide& side);

/// Of each node of one side: tangential contact force over the node's area, Pa, three components, global axes.
std::vector<double> nodal_shear(const ContactSide& side);

}  // namespace railwave
