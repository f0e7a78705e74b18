#include "post/contact_tables.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "post/facet.hpp"

namespace railwave {
namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

const std::vector<Column> patch_columns = {{"time", "s"},
                                           {"patch", "1"},
                                           {"nodes_in_contact", "1"},
                                           {"area_by_count", "m2"},
                                           {"area", "m2"},
                                           {"peak_nodal_pressure", "Pa"},
                                           {"peak_facet_pressure", "Pa"},
                                           {"peak_shear", "Pa"},
                                           {"peak_facet_shear", "Pa"},
                                           {"normal_force", "N"},
                                           {"creep_force", "N"},
                                           {"lateral_force", "N"},
                                           {"traction_coefficient", "1"},
                                           {"centre_x", "m"},
                                           {"centre_y", "m"},
                                           {"centre_z", "m"},
                                           {"normal_x", "1"},
                                           {"normal_y", "1"},
                                           {"normal_z", "1"},
                                           {"along_x", "1"},
                                           {"along_y", "1"},
                                           {"along_z", "1"},
                                           {"across_x", "1"},
                                           {"across_y", "1"},
                                           {"across_z", "1"},
                                           {"semi_axis_along", "m"},
                                           {"semi_axis_across", "m"},
                                           {"ellipse_turn", "rad"},
                                           {"slipping_by_force", "1"},
                                           {"slipping_by_velocity", "1"},
                                           {"slipping_by_solver", "1"},
                                           {"agreement_force_velocity", "1"},
                                           {"agreement_force_solver", "1"},
                                           {"agreement_velocity_solver", "1"},
                                           {"peak_micro_slip", "m/s"},
                                           {"micro_slip_difference", "m/s"},
                                           {"stray_nodes", "1"},
                                           {"stray_force", "N"},
                                           {"rigid_slip_along", "m/s"},
                                           {"rigid_slip_across", "m/s"},
                                           {"rigid_slip_spin", "rad/s"},
                                           {"ring_nodes_slave", "1"},
                                           {"ring_nodes_master", "1"},
                                           {"mean_velocity_along", "m/s"},
                                           {"rolling_velocity", "m/s"},
                                           {"longitudinal_creepage", "1"},
                                           {"lateral_creepage", "1"},
                                           {"spin_creepage", "1/m"},
                                           {"longitudinal_creepage_spread", "1"},
                                           {"lateral_creepage_spread", "1"},
                                           {"spin_creepage_spread", "1/m"},
                                           {"small", "1"}};

const std::vector<Column> node_columns = {{"row", "row"},
                                          {"time", "s"},
                                          {"patch", "1"},
                                          {"node", "1"},
                                          {"x", "m"},
                                          {"y", "m"},
                                          {"z", "m"},
                                          {"along", "m"},
                                          {"across", "m"},
                                          {"height", "m"},
                                          {"area", "m2"},
                                          {"touching", "1"},
                                          {"gap", "m"},
                                          {"pressure", "Pa"},
                                          {"traction_bound", "Pa"},
                                          {"shear_along", "Pa"},
                                          {"shear_across", "Pa"},
                                          {"micro_slip_along", "m/s"},
                                          {"micro_slip_across", "m/s"},
                                          {"parting_velocity", "m/s"},
                                          {"solver_slip_along", "m/s"},
                                          {"solver_slip_across", "m/s"},
                                          {"slips_by_force", "1"},
                                          {"slips_by_velocity", "1"},
                                          {"slips_by_solver", "1"}};

const std::vector<Column> facet_columns = {{"row", "row"},      {"corner_0", "row"},   {"corner_1", "row"},
                                           {"corner_2", "row"}, {"corner_3", "row"},   {"area", "m2"},
                                           {"pressure", "Pa"},  {"shear_along", "Pa"}, {"shear_across", "Pa"}};

const std::vector<Column> cut_columns = {{"row", "row"},
                                         {"time", "s"},
                                         {"patch", "1"},
                                         {"cut", "1"},
                                         {"distance", "m"},
                                         {"pressure", "Pa"},
                                         {"traction_bound", "Pa"},
                                         {"shear_along", "Pa"},
                                         {"shear_across", "Pa"},
                                         {"micro_slip_along", "m/s"},
                                         {"micro_slip_across", "m/s"},
                                         {"parting_velocity", "m/s"},
                                         {"slips_by_force", "1"},
                                         {"slips_by_velocity", "1"}};

FileKind kind_of(const std::string& called, const std::vector<Column>& columns) {
  std::string names = Table(columns).csv_heading();
  names.pop_back();  // the line's end
  return {FileKind::Form::table, called, names, ""};
}

}  // namespace

FileKind patch_table_kind() { return kind_of("a table of 'railwave contact --csv'", patch_columns); }
FileKind node_table_kind() { return kind_of("a table of 'railwave contact --nodes'", node_columns); }
FileKind cut_table_kind() { return kind_of("a table of 'railwave contact --cuts'", cut_columns); }

ContactTables::ContactTables()
    : patches(patch_columns), nodes(node_columns), facets(facet_columns), cuts(cut_columns) {}

void ContactTables::add(double time, const ContactState& state, const ContactSolution& solution,
                        std::vector<int> numbers) {
  add_patch(time, 0, solution, solution.whole);
  std::vector<int> order(solution.patches.size());
  std::iota(order.begin(), order.end(), 0);
  if (numbers.empty())
    for (const int p : order) numbers.push_back(p + 1);
  std::sort(order.begin(), order.end(), [&](int a, int b) { return numbers[a] < numbers[b]; });
  for (const int p : order) {
    const ContactPatch& patch = solution.patches[p];
    const int number = numbers[p];
    add_patch(time, number, solution, patch);
    const std::size_t first_node = nodes.row_count();
    if (with_nodes || with_facets) add_nodes(time, number, state, patch);
    if (with_facets) add_facets(state, patch, first_node);
    if (with_cuts)
      for (const CutDirection direction : {CutDirection::along, CutDirection::across})
        add_cut(time, number, state, patch, direction);
  }
  ++instant_count_;
}

void ContactTables::add_patch(double time, int number, const ContactSolution& solution, const ContactPatch& p) {
  const LocalFrame& f = p.frame;
  const SlipRegions& r = p.regions;
  const RigidSlip& s = p.rigid_slip;
  const bool touches = !p.touching.empty();
  // Of several patches together there is no one tangent plane, and so no creepage.
  const auto large = std::count_if(solution.patches.begin(), solution.patches.end(),
                                   [](const ContactPatch& one) { return !one.small(); });
  const bool creeps = touches && s.known && (number > 0 || large == 1 || solution.patches.size() == 1);
  const auto if_creeps = [&](double value) { return creeps ? value : unknown; };
  const auto if_touches = [&](double value) { return touches ? value : unknown; };
  const auto if_told = [&](double value) { return r.by_solver.size() == p.touching.size() ? value : unknown; };
  patches.add_row({time,
                   static_cast<double>(number),
                   static_cast<double>(p.touching.size()),
                   p.area_by_count,
                   p.area,
                   p.peak_nodal_pressure,
                   p.peak_facet_pressure,
                   p.peak_shear,
                   p.peak_facet_shear,
                   p.normal_force,
                   p.creep_force,
                   p.lateral_force,
                   p.traction_coefficient,
                   if_touches(f.centre[0]),
                   if_touches(f.centre[1]),
                   if_touches(f.centre[2]),
                   if_touches(f.normal[0]),
                   if_touches(f.normal[1]),
                   if_touches(f.normal[2]),
                   if_touches(f.along[0]),
                   if_touches(f.along[1]),
                   if_touches(f.along[2]),
                   if_touches(f.across[0]),
                   if_touches(f.across[1]),
                   if_touches(f.across[2]),
                   p.ellipse.semi_axis_along,
                   p.ellipse.semi_axis_across,
                   p.ellipse.turn,
                   static_cast<double>(count_of(r.by_force)),
                   static_cast<double>(count_of(r.by_velocity)),
                   if_told(count_of(r.by_solver)),
                   if_touches(agreement(r.by_force, r.by_velocity)),
                   if_touches(if_told(agreement(r.by_force, r.by_solver))),
                   if_touches(if_told(agreement(r.by_velocity, r.by_solver))),
                   p.peak_micro_slip,
                   p.slip_difference,
                   number == 0 ? solution.stray_nodes : 0.0,
                   number == 0 ? solution.stray_force : 0.0,
                   if_creeps(s.along),
                   if_creeps(s.across),
                   if_creeps(s.spin),
                   static_cast<double>(s.slave.nodes),
                   static_cast<double>(s.master.nodes),
                   if_creeps(s.mean_along),
                   unknown,
                   unknown,
                   unknown,
                   unknown,
                   if_creeps(s.spread_along),
                   if_creeps(s.spread_across),
                   if_creeps(s.spread_spin),
                   number > 0 && p.small() ? 1.0 : 0.0});
  instants_.push_back(instant_count_);
}

void ContactTables::set_patch_velocity(const std::vector<Vector>& velocities) {
  std::vector<Vector> of_rows;
  for (const int instant : instants_) of_rows.push_back(velocities[instant]);
  set_velocity_of_rows(of_rows);
}

void ContactTables::set_velocity_of_rows(const std::vector<Vector>& velocities) {
  for (std::size_t row = 0; row < patches.row_count(); ++row) {
    const Vector along(patches.at(row, "along_x"), patches.at(row, "along_y"), patches.at(row, "along_z"));
    // What passes through the patch: its own velocity less the mean of the two surfaces'.
    set_creepages(row, std::fabs(velocities[row].dot(along) - patches.at(row, "mean_velocity_along")));
  }
}

void ContactTables::set_rolling_velocity(double velocity) {
  for (std::size_t row = 0; row < patches.row_count(); ++row) set_creepages(row, velocity);
}

void ContactTables::set_creepages(std::size_t row, double rolling_velocity) {
  patches.at(row, "rolling_velocity") = rolling_velocity;
  for (const auto& [creepage, slip] :
       {std::pair{"longitudinal_creepage", "rigid_slip_along"}, std::pair{"lateral_creepage", "rigid_slip_across"},
        std::pair{"spin_creepage", "rigid_slip_spin"}}) {
    patches.at(row, creepage) = patches.at(row, slip) / rolling_velocity;
    patches.at(row, std::string(creepage) + "_spread") /= rolling_velocity;
  }
}

void ContactTables::add_nodes(double time, int number, const ContactState& state, const ContactPatch& patch) {
  const ContactSide& slave = state.slave;
  for (std::size_t i = 0; i < patch.surroundings.size(); ++i) {
    const int node = patch.surroundings[i];
    const auto found = std::lower_bound(patch.touching.begin(), patch.touching.end(), node);
    const bool touches = found != patch.touching.end() && *found == node;
    const std::size_t t = found - patch.touching.begin();
    const Vector position = entry(slave.position, node), place = patch.frame.place(position);
    const RelativeMotion& motion = patch.motion[i];
    const Vector slip = patch.frame.components(motion.slip),
                 run = state.slip_velocity.empty() ? Vector(Vector::Constant(unknown))
                                                   : patch.frame.components(entry(state.slip_velocity, node));
    const double area = slave.area[node];
    const Vector shear =
        touches ? Vector(patch.frame.components(entry(slave.tangential_force, node)) / area) : Vector(Vector::Zero());
    const double bound = touches ? state.friction_at(node) * entry(slave.normal_force, node).norm() / area : 0;
    nodes.add_row({static_cast<double>(patches.row_count() - 1),
                   time,
                   static_cast<double>(number),
                   static_cast<double>(slave.nodes[node]),
                   position[0],
                   position[1],
                   position[2],
                   place[0],
                   place[1],
                   place[2],
                   area,
                   touches ? 1.0 : 0.0,
                   state.gap.empty() ? unknown : state.gap[node],
                   touches ? patch.pressure[t] : 0,
                   bound,
                   shear[0],
                   shear[1],
                   motion.known ? slip[0] : unknown,
                   motion.known ? slip[1] : unknown,
                   motion.known ? motion.parting : unknown,
                   run[0],
                   run[1],
                   touches && patch.regions.by_force[t] ? 1.0 : 0.0,
                   touches && patch.regions.by_velocity[t] ? 1.0 : 0.0,
                   patch.regions.by_solver.empty()         ? unknown
                   : touches && patch.regions.by_solver[t] ? 1.0
                                                           : 0.0});
  }
}

void ContactTables::add_facets(const ContactState& state, const ContactPatch& patch, std::size_t first_node) {
  std::vector<double> pressure(state.slave.nodes.size(), 0.0);
  for (std::size_t i = 0; i < patch.touching.size(); ++i) pressure[patch.touching[i]] = patch.pressure[i];
  for (const int facet : patch.facets) {
    const FacetStress stress = facet_stress(state.slave, facet, pressure);
    const Vector shear = patch.frame.components(stress.shear);
    std::vector<double> row{static_cast<double>(patches.row_count() - 1)};
    for (const int corner : state.slave.facets[facet])
      row.push_back(static_cast<double>(first_node + place_in(patch.surroundings, corner)));
    row.insert(row.end(), {facet_area(state.slave, facet), stress.pressure, shear[0], shear[1]});
    facets.add_row(row);
  }
}

void ContactTables::add_cut(double time, int number, const ContactState& state, const ContactPatch& patch,
                            CutDirection direction) {
  for (const CutPoint& point : centre_cut(state, patch, direction)) {
    cuts.add_row({static_cast<double>(patches.row_count() - 1), time, static_cast<double>(number),
                  direction == CutDirection::along ? 0.0 : 1.0, point.distance, point.pressure, point.bound,
                  point.shear[0], point.shear[1], point.micro_slip[0], point.micro_slip[1], point.parting,
                  point.slip_by_force, point.slip_by_velocity});
  }
}

}  // namespace railwave
