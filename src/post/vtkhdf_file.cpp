#include "post/vtkhdf_file.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include <fmt/format.h>

#include "case/field_table.hpp"

namespace railwave {
namespace {

constexpr OwnFormat format{"Railwave VTKHDF export", 1, "railwave export --vtkhdf"};
constexpr std::size_t values_in_chunk = 65536;

/// VTK's numbers of cell types.
unsigned char cell_type(std::size_t corners) { return corners == 8 ? 12 : corners == 4 ? 9 : 3; }

template <class T>
void extend(std::vector<T>& all, const std::vector<T>& more) {
  all.insert(all.end(), more.begin(), more.end());
}

/// An array that gets the values of one time after the other.
class GrowingArray {
 public:
  GrowingArray(const hdf5::Group& group, const std::string& name, std::size_t components, std::size_t rows, bool single)
      : name_(name), components_(components), single_(single) {
    const hdf5::Shape row = components == 1 ? hdf5::Shape{} : hdf5::Shape{components};
    const hdf5::Storage storage{
        std::clamp<std::size_t>(values_in_chunk / components, 1, std::max<std::size_t>(rows, 1)), true};
    dataset_ =
        single ? group.create_growing<float>(name, row, storage) : group.create_growing<double>(name, row, storage);
  }

  /// Adds the values of a time; keeps where they begin.
  void add(const std::vector<double>& values) {
    offsets_.push_back(static_cast<long>(rows_));
    rows_ += values.size() / components_;
    if (single_) {
      const std::vector<float> narrow(values.begin(), values.end());
      dataset_.append(narrow.data(), narrow.size() / components_);
    } else {
      dataset_.append(values.data(), values.size() / components_);
    }
  }

  const std::string& name() const { return name_; }
  const std::vector<long>& offsets() const { return offsets_; }

 private:
  std::string name_;
  std::size_t components_;
  bool single_;
  hdf5::Dataset dataset_;
  std::size_t rows_ = 0;
  std::vector<long> offsets_;
};

/// The meshes of all times one after the other: one for each choice of sets, a part as the format calls it.
struct Meshes {
  std::vector<double> points;
  std::vector<long> connectivity, offsets, node, element, set;
  std::vector<unsigned char> types;
  std::vector<long> point_counts, cell_counts, connectivity_counts;  ///< by part
  std::vector<long> first_point, first_cell, first_connectivity;     ///< by part
  std::map<std::vector<std::size_t>, long> parts;                    ///< by the positions of its sets

  long part_of(const std::vector<FieldSet>& sets, const std::vector<std::size_t>& chosen) {
    const auto [place, is_new] = parts.emplace(chosen, static_cast<long>(parts.size()));
    if (is_new) add_part(sets, chosen);
    return place->second;
  }

 private:
  void add_part(const std::vector<FieldSet>& sets, const std::vector<std::size_t>& chosen) {
    first_point.push_back(static_cast<long>(node.size()));
    first_cell.push_back(static_cast<long>(types.size()));
    first_connectivity.push_back(static_cast<long>(connectivity.size()));
    offsets.push_back(0);
    for (const std::size_t one : chosen) add_set(sets[one], static_cast<long>(one));
    point_counts.push_back(static_cast<long>(node.size()) - first_point.back());
    cell_counts.push_back(static_cast<long>(types.size()) - first_cell.back());
    connectivity_counts.push_back(static_cast<long>(connectivity.size()) - first_connectivity.back());
  }

  void add_set(const FieldSet& one, long number) {
    const long before = static_cast<long>(node.size()) - first_point.back();
    for (const long corner : one.connectivity) connectivity.push_back(before + corner);
    for (std::size_t cell = 0; cell < one.cell_count(); ++cell)
      offsets.push_back(offsets.back() + static_cast<long>(one.corner_count));
    types.insert(types.end(), one.cell_count(), cell_type(one.corner_count));
    set.insert(set.end(), one.cell_count(), number);
    extend(points, one.coordinates);
    extend(node, one.nodes);
    extend(element, one.elements);
  }
};

/// Name of the array in the export: a beam's `force` beside stresses would not be known for what it is.
std::string shown_name(const FieldSet& set, const SetField& field) {
  return set.is_beam() && !field.of_nodes ? "beam_" + field.name : field.name;
}

class VtkhdfWriter {
 public:
  VtkhdfWriter(const hdf5::Group& file, const std::vector<FieldSet>& sets, const std::vector<ExportedTime>& times)
      : sets_(sets), times_(times), root_(file.create_group("VTKHDF")) {
    root_.set_attribute("Version", std::vector<long>{transient() ? 2 : 1, 0});
    root_.set_fixed_text_attribute("Type", "UnstructuredGrid");
    for (const ExportedTime& time : times) part_.push_back(meshes_.part_of(sets, time.sets));
    write_meshes();
    const std::vector<GrowingArray> of_points = write_fields("PointData", true),
                                    of_cells = write_fields("CellData", false);
    if (transient()) {
      write_steps(of_points, of_cells);
    } else {
      root_.create_group("FieldData").write("TimeValue", std::vector<double>{times[0].time}, {1}, "s");
    }
  }

 private:
  bool transient() const { return times_.size() > 1; }

  template <class T>
  static void write(const hdf5::Group& group, const char* name, const std::vector<T>& values, const char* unit = "1") {
    group.write(name, values, {values.size()}, unit);
  }

  void write_meshes() {
    write(root_, "NumberOfPoints", meshes_.point_counts);
    write(root_, "NumberOfCells", meshes_.cell_counts);
    write(root_, "NumberOfConnectivityIds", meshes_.connectivity_counts);
    root_.write("Points", meshes_.points, {meshes_.points.size() / 3, 3}, "m");
    write(root_, "Connectivity", meshes_.connectivity);
    write(root_, "Offsets", meshes_.offsets);
    write(root_, "Types", meshes_.types);
  }

  /// Names and components of the fields of all sets, in the order in which they are met.
  std::vector<std::pair<std::string, std::size_t>> fields(bool of_nodes) const {
    std::vector<std::pair<std::string, std::size_t>> found;
    for (const FieldSet& set : sets_)
      for (const SetField& field : set.fields)
        if (field.of_nodes == of_nodes)
          if (const std::pair one(shown_name(set, field), field.components);
              std::find(found.begin(), found.end(), one) == found.end())
            found.push_back(one);
    return found;
  }

  static const SetField* field_called(const FieldSet& set, const std::string& name, bool of_nodes) {
    for (const SetField& field : set.fields)
      if (field.of_nodes == of_nodes && shown_name(set, field) == name) return &field;
    return nullptr;
  }

  bool is_single(const std::string& name, bool of_nodes) const {
    return std::all_of(sets_.begin(), sets_.end(), [&](const FieldSet& set) {
      const SetField* field = field_called(set, name, of_nodes);
      return !field || set.group.dataset(field->name).is_single();
    });
  }

  /// Of all sets of a time; not-a-number where a set has not got the field.
  std::vector<double> values_at(const ExportedTime& time, const std::string& name, bool of_nodes,
                                std::size_t components) const {
    std::vector<double> all;
    for (std::size_t i = 0; i < time.sets.size(); ++i) {
      const FieldSet& set = sets_[time.sets[i]];
      if (const SetField* field = field_called(set, name, of_nodes))
        extend(all, set.values(*field, time.outputs[i]));
      else
        all.insert(all.end(), components * (of_nodes ? set.node_count() : set.cell_count()), std::nan(""));
    }
    return all;
  }

  std::vector<GrowingArray> write_fields(const char* group_name, bool of_nodes) {
    const hdf5::Group group = root_.create_group(group_name);
    if (of_nodes) {
      write(group, "node", meshes_.node);
    } else {
      write(group, "element", meshes_.element);
      write(group, "set", meshes_.set);
    }
    const long rows = of_nodes ? meshes_.point_counts[0] : meshes_.cell_counts[0];
    std::vector<GrowingArray> arrays;
    for (const auto& [name, components] : fields(of_nodes)) {
      GrowingArray& array =
          arrays.emplace_back(group, name, components, static_cast<std::size_t>(rows), is_single(name, of_nodes));
      for (const ExportedTime& time : times_) array.add(values_at(time, name, of_nodes, components));
    }
    return arrays;
  }

  std::vector<long> by_step(const std::vector<long>& by_part) const {
    std::vector<long> values;
    for (const long part : part_) values.push_back(by_part[static_cast<std::size_t>(part)]);
    return values;
  }

  void write_steps(const std::vector<GrowingArray>& of_points, const std::vector<GrowingArray>& of_cells) const {
    const hdf5::Group steps = root_.create_group("Steps");
    steps.set_attribute("NSteps", static_cast<long>(times_.size()));
    std::vector<double> values;
    for (const ExportedTime& time : times_) values.push_back(time.time);
    write(steps, "Values", values, "s");
    write(steps, "PartOffsets", part_);
    write(steps, "NumberOfParts", std::vector<long>(times_.size(), 1));
    const std::vector<long> points = by_step(meshes_.first_point), cells = by_step(meshes_.first_cell);
    write(steps, "PointOffsets", points);
    steps.write("CellOffsets", cells, {cells.size(), 1}, "1");
    steps.write("ConnectivityIdOffsets", by_step(meshes_.first_connectivity), {cells.size(), 1}, "1");
    const hdf5::Group point_offsets = steps.create_group("PointDataOffsets"),
                      cell_offsets = steps.create_group("CellDataOffsets");
    write(point_offsets, "node", points);
    for (const char* name : {"element", "set"}) write(cell_offsets, name, cells);
    for (const GrowingArray& array : of_points) write(point_offsets, array.name().c_str(), array.offsets());
    for (const GrowingArray& array : of_cells) write(cell_offsets, array.name().c_str(), array.offsets());
  }

  const std::vector<FieldSet>& sets_;
  const std::vector<ExportedTime>& times_;
  hdf5::Group root_;
  Meshes meshes_;
  std::vector<long> part_;  ///< by time
};

}  // namespace

FileKind vtkhdf_kind() { return format.kind(); }

std::vector<ExportedTime> times_of(const std::vector<FieldSet>& sets, double from, double to) {
  std::map<double, ExportedTime> by_time;
  for (std::size_t i = 0; i < sets.size(); ++i)
    for (std::size_t k = 0; k < sets[i].times.size(); ++k) {
      const double time = sets[i].times[k];
      if (!(time >= from && time <= to)) continue;
      ExportedTime& one = by_time[time];
      one.time = time;
      one.sets.push_back(i);
      one.outputs.push_back(k);
    }
  std::vector<ExportedTime> times;
  for (auto& [time, one] : by_time) times.push_back(std::move(one));
  return times;
}

void write_vtkhdf_file(const std::string& path, const ResultsReader& results, const std::vector<FieldSet>& sets,
                       const std::vector<ExportedTime>& times) {
  std::vector<std::string> names;
  for (const FieldSet& set : sets) names.push_back(set.name);
  write_own_file(path, format, results, [&](const hdf5::Group& file) {
    file.set_attribute("set_names", names);
    const VtkhdfWriter writer(file, sets, times);
  });
}

}  // namespace railwave
