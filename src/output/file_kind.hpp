#pragma once

#include <map>
#include <optional>
#include <string>

namespace railwave {

/// A kind of file that this program writes, and by what it knows such a file again. It replaces or removes a file only
/// if it knows it, see output_place.hpp.
struct FileKind {
  enum class Form { hdf5, text, table };
  Form form = Form::hdf5;
  std::string called;  ///< "the results of a run", for messages
  /// - hdf5: how the root's attribute `format` begins;
  /// - text: what stands among its first bytes;
  /// - table (CSV, which has no room for a mark): the first columns of its heading, separated by commas; a unit, as in
  ///   `time [s]`, must agree where one is given here.
  std::string mark;
  std::string more;  ///< table: what each further column's name contains, which has a unit if the first has one; empty:
                     ///< there is none
};

/// Those of a run, of `railwave mesh` and of `railwave modes`; each HDF5 file with its XDMF companion.
namespace kinds {
FileKind results();
FileKind results_xdmf();
FileKind checkpoint();
FileKind settled_state();
FileKind fault();
FileKind fault_xdmf();
FileKind model();
FileKind model_xdmf();
FileKind modes();
FileKind modes_xdmf();
FileKind lock();
}  // namespace kinds

/// The remark with which an XDMF text says what it is, as a line.
std::string xdmf_mark(const FileKind& kind);

/// Whether the regular file at `path` is of that kind. Nothing that a file holds makes this crash or wait.
bool is_of_kind(const std::string& path, const FileKind& kind);

/// "an HDF5 file of another program", "a folder", "text that begins with '...'": for messages. Opens regular files
/// only.
std::string seems_to_be(const std::string& path);

}  // namespace railwave

namespace railwave::hdf5 {

/// Short texts and whole numbers among the attributes of an HDF5 file's root.
struct RootAttributes {
  std::map<std::string, std::string> texts;
  std::map<std::string, long> numbers;

  std::string text(const std::string& name) const;  ///< empty: there is none
  long number(const std::string& name, long otherwise) const;
};

/// Reads them from the bytes of the file, without the HDF5 library: a damaged file or one of another program may crash
/// that. Knows the layouts that this program writes and wrote (superblocks 0 to 3, object headers 1 and 2, attributes
/// in the header); of any other file it finds no attributes. Every address and length is checked. The file is not
/// changed, also where a killed run left a journal in it. Layout: HDF5 File Format Specification 3.0, sections II.A,
/// III.E, IV.A.1, IV.A.2.m.
/// @return nothing: it is no HDF5 file, or may not be read. The path must be that of a regular file.
std::optional<RootAttributes> read_root_attributes(const std::string& path);

}  // namespace railwave::hdf5
