#include "post/own_file.hpp"

#include <fmt/format.h>

#include "case/error.hpp"
#include "output/atomic_file.hpp"
#include "output/hdf5/hdf5.hpp"

namespace railwave {

FileKind OwnFormat::kind() const { return {FileKind::Form::hdf5, fmt::format("a file of '{}'", command), name, ""}; }

FileKind table_kind(const std::string& called, const std::string& columns, const std::string& more) {
  return {FileKind::Form::table, called, columns, more};
}

void check_wanted_files(const std::vector<std::string>& results, const std::vector<WantedFile>& files, bool overwrite) {
  OutputPlaces places(overwrite);
  for (const std::string& path : results) places.reads(path, "the results file");
  for (const WantedFile& file : files) {
    if (!file.path) continue;
    const bool table = file.kind.form == FileKind::Form::table;
    places.writes(*file.path, file.kind, file.option, table ? "the table" : "the HDF5 file");
    if (!table) places.uses(*file.path + ".new", file.option, "where the HDF5 file is written first");
  }
  places.check();
}

void write_own_file(const std::string& path, const OwnFormat& format, const ResultsReader& results,
                    const std::function<void(const hdf5::Group&)>& fill) {
  const std::string title = results.title();  // before anything is made: a damaged file may end this process
  try {
    hdf5::File file = hdf5::File::create(path, format.kind());
    const hdf5::Group root = file.root();
    root.set_attribute("format_version", format.version);
    root.set_attribute("results_file", results.path());
    root.set_attribute("title", title);
    fill(root);
    file.close();
  } catch (const InputError&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    throw InputError(fmt::format("{} was not written: {}", path, error.what()));
  }
}

void write_table(const std::string& path, const std::string& text, const FileKind& kind) {
  try {
    write_whole_file(path, text, kind);
  } catch (const InputError&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    throw InputError(fmt::format("the table was not written: {}", error.what()));
  }
}

}  // namespace railwave
