#pragma once

#include <array>
#include <initializer_list>
#include <optional>
#include <string>
#include <vector>

#include "case/field_table.hpp"
#include "case/surface_names.hpp"
#include "model/contact/contact_state.hpp"
#include "output/fields/compressed_rows.hpp"
#include "output/fields/field_snapshot.hpp"
#include "output/fields/number_format.hpp"
#include "output/hdf5/hdf5.hpp"

namespace railwave {

/// A contact surface as it is undeformed.
struct ContactSurface {
  std::vector<int> nodes;                  ///< model node numbers
  std::vector<std::array<int, 4>> facets;  ///< positions in `nodes`, turned outwards
  std::vector<double> coordinates;         ///< m, 3 of each node
};

/// What a results file says of one contact whatever the time.
struct ContactDescription {
  std::string name, slave;
  scene::SurfaceNames master;
  std::vector<int> master_facets = {};  ///< how many each of the masters has, in their order
  double friction = 0;                  ///< at rest, where it falls with speed
  bool falling_friction = false;
  ContactSurface slave_surface = {}, master_surface = {};
};

/// What is written of contacts, see scene::Output.
struct ContactOutput {
  std::optional<double> margin = {};  ///< m; the states have the nodes near the contact only, see contact_state()
  std::vector<std::string> fields = contact_field_names();
  bool slave = true, master = true;
  NumberFormat format = NumberFormat();

  bool near_only() const { return margin.has_value(); }
  /// Whether `fields` names one of these.
  bool has_any(std::initializer_list<const char*> names) const;
  /// What must be known of a contact to write this.
  ContactWish wish() const;
  bool has_side(bool of_slave) const { return of_slave ? slave : master; }
};

/// Of each node of one side: the contact force along the inward normal over the node's area, Pa, pressure positive.
std::vector<double> nodal_pressure(const ContactSide& side);

/// Of each node of one side: tangential contact force over the node's area, Pa, three components, global axes.
std::vector<double> nodal_shear(const ContactSide& side);

/// A field of the table at the nodes of one side, node by node. Throws std::logic_error for one that the side does not
/// have, or that has not the length of its nodes.
/// @param state of the contact
/// @param slave which of its sides
/// @param row   of contact_field_table()
std::vector<double> contact_values(const ContactState& state, bool slave, const ContactFieldRow& row);

/// Whether the side has it: the coefficient of friction is a field of contacts where it falls with speed.
bool has_values(const ContactFieldRow& row, bool slave, bool falling_friction);

/// Group /contact/NAME of a results file: both surfaces of one contact pair at each output time.
class ContactSection {
 public:
  ContactSection(const hdf5::Group& contacts_group, const ContactDescription& contact, int number,
                 const ContactOutput& output);

  /// As those of FieldSection.
  void add_rows(const FieldSource& source, CompressedRows& rows) const;
  void add_values(const FieldSource& source, long step, const CompressedRows& packed = {});
  void add_time(double time) { times_.append(&time, 1); }

 private:
  struct Column {
    const ContactFieldRow* row;
    hdf5::Dataset dataset;
  };
  struct Side {
    bool slave = true;
    const ContactSurface* surface = nullptr;
    std::vector<Column> columns;
    hdf5::Dataset rows, nodes;  ///< of near nodes: how many rows there are up to each output, and whose they are
    long row_count = 0;
    std::vector<double> values_of(const Column& column, const ContactState& state, const ContactOutput& output) const;
    void add(const ContactState& state, const ContactOutput& output, const CompressedRows& packed);
  };
  Side make_side(const hdf5::Group& group, bool slave, const ContactDescription& contact) const;

  int number_;
  ContactOutput output_;
  std::vector<Side> sides_;
  hdf5::Dataset times_, steps_;
};

}  // namespace railwave
