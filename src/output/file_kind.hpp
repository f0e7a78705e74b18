#pragma once

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
  /// `time [s]`, counts where
  ///   it is told here.
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
