#include "output/file_kind.hpp"

#include <fcntl.h>
#include <sys/stat.h>

#include <algorithm>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "output/disk.hpp"

namespace railwave {
namespace {

using Form = FileKind::Form;

std::string beginning(const std::string& path) {
  constexpr off_t enough = 65536;  // for headings of many columns
  const disk::Descriptor file(open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
  if (file.get() < 0) return {};
  std::string bytes(static_cast<std::size_t>(std::clamp<off_t>(disk::length_of(file.get()), 0, enough)), '\0');
  return disk::read_at(file.get(), bytes.data(), bytes.size(), 0) ? bytes : std::string();
}

/// The columns of a heading, without quotes.
std::vector<std::string> columns_of(std::string_view line) {
  std::vector<std::string> names(1);
  bool quoted = false;
  for (const char c : line) {
    if (c == '"')
      quoted = !quoted;
    else if (c == ',' && !quoted)
      names.emplace_back();
    else
      names.back() += c;
  }
  if (!names.back().empty() && names.back().back() == '\r') names.back().pop_back();
  return names;
}

bool has_unit(const std::string& column) { return column.find(" [") != std::string::npos && column.back() == ']'; }

bool is_column(const std::string& wanted, const std::string& there) {
  return there == wanted || (!has_unit(wanted) && has_unit(there) && there.compare(0, there.find(" ["), wanted) == 0);
}

bool has_heading(const std::string& bytes, const FileKind& kind) {
  const auto end = bytes.find('\n');
  if (end == std::string::npos) return false;
  const auto there = columns_of(std::string_view(bytes).substr(0, end)), wanted = columns_of(kind.mark);
  if (there.size() < wanted.size() || !std::equal(wanted.begin(), wanted.end(), there.begin(), is_column)) return false;
  return std::all_of(there.begin() + static_cast<std::ptrdiff_t>(wanted.size()), there.end(),
                     [&](const std::string& column) {
                       return !kind.more.empty() && column.find(kind.more) < column.find(" [") &&
                              (has_unit(column) || !has_unit(wanted.front()));
                     });
}

FileKind xdmf_of(const FileKind& kind) {
  FileKind companion{Form::text, "the XDMF companion of " + kind.called, "<!-- " + kind.mark + " -->", ""};
  return companion;
}

}  // namespace

namespace kinds {
FileKind results() { return {Form::hdf5, "the results of a run", "Railwave results", ""}; }
FileKind results_xdmf() { return xdmf_of(results()); }
FileKind checkpoint() { return {Form::hdf5, "a checkpoint of a run", "Railwave checkpoint", ""}; }
FileKind settled_state() { return {Form::hdf5, "a settled state", "Railwave settled state", ""}; }
FileKind fault() { return {Form::hdf5, "the surroundings of a fault", "Railwave fault", ""}; }
FileKind fault_xdmf() { return xdmf_of(fault()); }
FileKind model() { return {Form::hdf5, "a model of 'railwave mesh'", "Railwave model", ""}; }
FileKind model_xdmf() { return xdmf_of(model()); }
FileKind modes() { return {Form::hdf5, "shapes of 'railwave modes --out'", "Railwave modes", ""}; }
FileKind modes_xdmf() { return xdmf_of(modes()); }
FileKind lock() { return {Form::text, "the lock of a run", "Railwave lock", ""}; }
}  // namespace kinds

std::string xdmf_mark(const FileKind& kind) { return kind.mark + '\n'; }

bool is_of_kind(const std::string& path, const FileKind& kind) {
  struct stat facts;
  if (stat(path.c_str(), &facts) != 0 || !S_ISREG(facts.st_mode)) return false;
  if (kind.form == Form::hdf5) {
    const auto root = hdf5::read_root_attributes(path);
    return root && root->text("format").rfind(kind.mark, 0) == 0;
  }
  const std::string bytes = beginning(path);
  if (kind.form == Form::table) return has_heading(bytes, kind);
  return bytes.substr(0, 512).find(kind.mark) != std::string::npos;
}

std::string seems_to_be(const std::string& path) {
  struct stat facts;
  if (stat(path.c_str(), &facts) != 0) return "a link to nothing";
  if (S_ISDIR(facts.st_mode)) return "a folder";
  if (S_ISFIFO(facts.st_mode)) return "a named pipe (FIFO)";
  if (S_ISCHR(facts.st_mode) || S_ISBLK(facts.st_mode)) return "a device";
  if (S_ISSOCK(facts.st_mode)) return "a socket";
  if (!S_ISREG(facts.st_mode)) return "no regular file";
  if (facts.st_size == 0) return "an empty file";
  if (const auto root = hdf5::read_root_attributes(path)) {
    const std::string format = root->text("format");
    return format.rfind("Railwave ", 0) == 0 ? fmt::format("a file '{}'", format) : "an HDF5 file of another program";
  }
  const std::string bytes = beginning(path);
  if (bytes.empty()) return "a file that may not be read";
  if (bytes.find('\0') != std::string::npos) return "a file of another program";
  std::string line = bytes.substr(0, std::min(bytes.find('\n'), std::size_t{40}));
  for (char& c : line)
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = ' ';
  return fmt::format("text that begins with '{}'", line);
}

}  // namespace railwave
