#include "output/fields/xdmf.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <stdexcept>

#include <fmt/format.h>

#include "output/atomic_file.hpp"
#include "output/disk.hpp"

namespace railwave {
namespace {

const std::string head =
    "<?xml version=\"1.0\" ?>\n"
    "<!DOCTYPE Xdmf SYSTEM \"Xdmf.dtd\" []>\n";
const std::string begin_of_times =
    "<Xdmf Version=\"2.0\">\n"
    " <Domain>\n"
    "  <Grid Name=\"run\" GridType=\"Collection\" CollectionType=\"Temporal\">\n";
const std::string footer = "  </Grid>\n </Domain>\n</Xdmf>\n";

std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (c == '&')
      result += "&amp;";
    else if (c == '<')
      result += "&lt;";
    else if (c == '>')
      result += "&gt;";
    else if (c == '"')
      result += "&quot;";
    else
      result += c;
  }
  return result;
}

/// Writes the grids of one output time.
class TimeText {
 public:
  TimeText(const std::string& results_file_name, double time, std::size_t number, int float_bytes)
      : file_(escaped(results_file_name)), float_bytes_(float_bytes) {
    text_ = fmt::format(
        "   <Grid Name=\"time {}\" GridType=\"Collection\" CollectionType=\"Spatial\">\n    <Time Value=\"{:.17g}\" "
        "/>\n",
        number, time);
  }

  /// @param index of the grid's own output
  void open_grid(const std::string& name, int corner_count, std::size_t cells, const std::string& cells_path,
                 std::size_t index) {
    index_ = index;
    text_ += fmt::format(
        "    <Grid Name=\"{}\" GridType=\"Uniform\">\n"
        "     <Topology TopologyType=\"{}\"{} NumberOfElements=\"{}\">\n"
        "      <DataItem Format=\"HDF\" NumberType=\"Int\" Precision=\"4\" Dimensions=\"{} {}\">{}:{}</DataItem>\n"
        "     </Topology>\n",
        escaped(name),
        corner_count == 2   ? "Polyline"
        : corner_count == 4 ? "Quadrilateral"
                            : "Hexahedron",
        corner_count == 2 ? " NodesPerElement=\"2\"" : "", cells, cells, corner_count, file_, escaped(cells_path));
  }
  void geometry(std::size_t nodes, const std::string& path) {
    text_ += fmt::format(
        "     <Geometry GeometryType=\"XYZ\">\n"
        "      <DataItem Format=\"HDF\" NumberType=\"Float\" Precision=\"8\" Dimensions=\"{} 3\">{}:{}</DataItem>\n"
        "     </Geometry>\n",
        nodes, file_, escaped(path));
  }
  void attribute(const std::string& name, const char* centre, std::size_t entries, int components,
                 const std::string& path, const char* number = "Float", int bytes = 0) {
    if (bytes == 0) bytes = float_bytes_;
    const char* type = components == 1 ? "Scalar" : components == 3 ? "Vector" : "Matrix";
    text_ +=
        fmt::format("     <Attribute Name=\"{}\" AttributeType=\"{}\" Center=\"{}\">\n", escaped(name), type, centre) +
        slab(entries, components, path, number, bytes) + "     </Attribute>\n";
  }
  void close_grid() { text_ += "    </Grid>\n"; }
  std::string finished() const { return text_ + "   </Grid>\n"; }

 private:
  /// The entry of this time of a dataset that grows along its first dimension.
  std::string slab(std::size_t entries, int components, const std::string& path, const char* number, int bytes) const {
    const bool scalar = components == 1;
    const std::string shape = scalar ? fmt::format("{}", entries) : fmt::format("{} {}", entries, components);
    return fmt::format(
        "      <DataItem ItemType=\"HyperSlab\" Dimensions=\"{}\" NumberType=\"{}\" Precision=\"{}\">\n"
        "       <DataItem Format=\"XML\" NumberType=\"Int\" Dimensions=\"3 {}\">{}</DataItem>\n"
        "       <DataItem Format=\"HDF\" NumberType=\"{}\" Precision=\"{}\" Dimensions=\"{} {}\">{}:{}</DataItem>\n"
        "      </DataItem>\n",
        shape, number, bytes, scalar ? 2 : 3,
        scalar ? fmt::format("{} 0 1 1 1 {}", index_, entries)
               : fmt::format("{} 0 0 1 1 1 1 {} {}", index_, entries, components),
        number, bytes, index_ + 1, shape, file_, escaped(path));
  }

  std::string file_;
  int float_bytes_;
  std::size_t index_ = 0;
  std::string text_;
};

void add_set(TimeText& text, const OutputSet& set, std::size_t index, const std::vector<std::string>& fields) {
  const std::string group = set.group() + "/";
  text.open_grid((set.is_beam() ? "beam " : "") + set.name, set.corner_count, set.elements.size(),
                 group + "connectivity", index);
  text.geometry(set.nodes.size(), group + "coordinates");
  if (set.is_beam())
    for (const char* field : {"force", "moment"})
      text.attribute(field, "Cell", set.elements.size(), 3, group + field, "Float", sizeof(double));
  for (const std::string& name : fields)
    if (const FieldRow& row = field_named(name); set.has(row))
      text.attribute(name, row.of_nodes() ? "Node" : "Cell", set.numbers(row).size(), row.components, group + name);
  text.close_grid();
}

void add_side(TimeText& text, const XdmfContactSide& side, std::size_t index) {
  const char* name = side.slave ? "slave" : "master";
  const std::string group = "/contact/" + side.contact + "/" + name + "/";
  text.open_grid("contact " + side.contact + " " + name, 4, side.facet_count, group + "facets", index);
  text.geometry(side.node_count, group + "coordinates");
  const auto attribute = [&](const std::string& field, int components, const char* number = "Float", int bytes = 0) {
    if (std::find(side.fields.begin(), side.fields.end(), field) != side.fields.end())
      text.attribute(field, "Node", side.node_count, components, group + field, number, bytes);
  };
  attribute("displacement", 3);
  attribute("pressure", 1);
  attribute("shear", 3);
  attribute("velocity", 3);
  if (side.slave) {
    attribute("slip_velocity", 3);
    attribute("slipping", 1, "Char", 1);
  }
  text.close_grid();
}

}  // namespace

XdmfFile::XdmfFile(std::string path, std::string results_file_name, std::vector<std::string> fields, FileKind kind,
                   bool in_single)
    : path_(std::move(path)),
      results_file_name_(std::move(results_file_name)),
      fields_(std::move(fields)),
      kind_(std::move(kind)),
      float_bytes_(in_single ? sizeof(float) : sizeof(double)) {}

bool XdmfFile::is_there() const { return end_of_times_ == 0 || access(path_.c_str(), F_OK) == 0; }

bool XdmfFile::add(double time, std::size_t number, const XdmfGrids& at_this_time) {
  TimeText text(results_file_name_, time, number, float_bytes_);
  for (const auto& [set, index] : at_this_time.sets)
    if (!set->elements.empty()) add_set(text, *set, index, fields_);
  for (const auto& [side, index] : at_this_time.sides)
    if (side->facet_count > 0) add_side(text, *side, index);
  const std::string grids = text.finished();

  if (end_of_times_ == 0) {
    const std::string header = head + xdmf_mark(kind_) + begin_of_times;
    write_whole_file(path_, header + grids + footer, kind_);
    struct stat facts;
    if (stat(path_.c_str(), &facts) == 0) device_ = facts.st_dev, inode_ = facts.st_ino;
    end_of_times_ = static_cast<long>(header.size() + grids.size());
    return true;
  }
  const std::string tail = grids + footer;
  disk::Descriptor file(open(path_.c_str(), O_WRONLY | O_CLOEXEC | O_NONBLOCK));
  if (file.get() < 0 && errno == ENOENT) return false;
  struct stat facts;
  if (file.get() >= 0 && (fstat(file.get(), &facts) != 0 || facts.st_dev != device_ || facts.st_ino != inode_))
    throw std::runtime_error("another file has taken the name " + path_ + " while this run wrote it");
  if (file.get() < 0 || !disk::write_at(file.get(), tail.data(), tail.size(), end_of_times_)) {
    const std::string reason = disk::reason(), mend = disk::mend();
    // As it was: the file has held these bytes before.
    if (file.get() >= 0 && disk::write_at(file.get(), footer.data(), footer.size(), end_of_times_))
      static_cast<void>(!ftruncate(file.get(), end_of_times_ + static_cast<off_t>(footer.size())));
    throw std::runtime_error("cannot extend " + path_ + ": " + reason + (mend.empty() ? "" : "; ") + mend);
  }
  end_of_times_ += static_cast<long>(grids.size());
  return true;
}

}  // namespace railwave
