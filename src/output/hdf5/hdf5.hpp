#pragma once

#include <hdf5.h>

#include <functional>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "output/file_kind.hpp"

/// The little of HDF5's C interface that Railwave needs, with identifiers that close themselves. Every failing call
/// throws std::runtime_error saying what was tried and HDF5's own reason.
namespace railwave::hdf5 {

/// HDF5 would print its error stack to the terminal; the reason travels in the exception instead. HDF5 built for
/// several threads keeps this for each thread: to be called in each one that uses it. File::create() and File::open()
/// do so.
void be_quiet();

/// Whoever uses HDF5 while other threads may holds this, as the library need not be built for several.
std::recursive_mutex& in_use();

/// An HDF5 identifier together with the function that closes it.
class Handle {
 public:
  using Closer = herr_t (*)(hid_t);
  Handle() = default;
  Handle(hid_t id, Closer closer) : id_(id), closer_(closer) {}
  Handle(Handle&& other) noexcept : id_(std::exchange(other.id_, -1)), closer_(other.closer_) {}
  Handle& operator=(Handle&& other) noexcept;
  ~Handle() { close(); }
  hid_t get() const { return id_; }
  void close() noexcept;
  hid_t release() { return std::exchange(id_, -1); }  ///< the caller closes it

 private:
  hid_t id_ = -1;
  Closer closer_ = nullptr;
};

using Shape = std::vector<hsize_t>;

/// How many threads may compress what is written now, the caller's among them; empty: HDF5 compresses, on that thread.
using ThreadCount = std::function<int()>;

/// Name of groups whose datasets have any number of rows for each output. The group that holds such a one has a growing
/// dataset `rows`: how many there are up to and with each output.
inline constexpr const char* near_nodes = "near";

/// A row of an array as it goes into the file, see Dataset::pack().
using PackedRow = std::vector<unsigned char>;

/// How rows of an array lie in the file of which each is one compressed chunk.
struct RowLayout {
  hsize_t values = 0;
  bool in_single = false;
  int level = 0;  ///< of deflate
};

/// Array in a file. Element types are double, float, int, long, signed and unsigned char; an array of one of them can
/// be appended and read as any other.
class Dataset {
 public:
  Dataset() = default;
  Dataset(Handle id, std::string name, ThreadCount threads = {})
      : id_(std::move(id)), name_(std::move(name)), threads_(std::move(threads)) {}

  Shape shape() const;
  bool is_single() const;  ///< numbers of single precision

  /// Adds `count` rows (entries along the first dimension) at the end.
  template <class T>
  void append(const T* rows, hsize_t count);

  /// Compresses a row without any use of HDF5, so that other threads may use it meanwhile, for append(). The bytes are
  /// those that HDF5's own filters make.
  /// @return empty: HDF5 is to compress it, as in an array that is not made by Group::create_growing() in a file with
  /// compress_on(), whose rows are not one chunk each, or where memory is little
  PackedRow pack(const double* row) const;
  /// Whether pack() is for its rows; how many values they have.
  bool packs() const { return layout_.has_value(); }
  hsize_t values_of_packed() const { return layout_ ? layout_->values : 0; }
  void append(const PackedRow& row);

  /// Asks HDF5 how its rows lie.
  void find_layout();

  template <class T>
  std::vector<T> read() const;

  /// Reads one entry along the first dimension. Throws if there is none of that number.
  template <class T>
  std::vector<T> read_row(hsize_t row) const;

  /// Reads `count` entries from `row` on. Throws if there are fewer.
  template <class T>
  std::vector<T> read_rows(hsize_t row, hsize_t count) const;

 private:
  Shape extent() const;  ///< shape() without checking for free memory
  Handle id_;
  std::string name_;
  ThreadCount threads_;
  std::optional<RowLayout> layout_;
};

/// How a growing dataset is stored. Compressed chunks are written once and whole: one that is rewritten in another size
/// moves, and its old place is lost.
struct Storage {
  hsize_t rows_in_chunk = 1;
  bool compressed = false;
};

/// How damaged values are recognised: by a checksum with each of their chunks, or by one of the whole file (seal() in
/// output/atomic_file.hpp).
enum class Check { by_chunk, by_seal };

/// A group, or a file's root.
class Group {
 public:
  Group() = default;
  Group(Handle id, std::string name, bool extends = false, ThreadCount threads = {})
      : id_(std::move(id)), name_(std::move(name)), extends_(extends), threads_(std::move(threads)) {}

  Group create_group(const std::string& name) const;
  Group group(const std::string& name) const;
  Dataset dataset(const std::string& name) const;
  bool has(const std::string& name) const;
  std::vector<std::string> names() const;  ///< of everything in this group, by alphabet

  /// Dataset that grows along its first dimension; `row` is the shape of one entry. Its attribute `unit` is that of
  /// dataset_units.hpp.
  template <class T>
  Dataset create_growing(const std::string& name, const Shape& row, const Storage& storage) const;

  /// In a file opened by File::extend() these take what is there; throw if that is of another shape.
  /// Dataset of fixed shape, written at once.
  /// @param unit its attribute `unit`; empty: that of dataset_units.hpp, none where that does not know it
  template <class T>
  void write(const std::string& name, const std::vector<T>& values, const Shape& shape, const std::string& unit = {},
             Check check = Check::by_chunk) const;

  /// Entries of the growing dataset with the fewest in this group and those below; none: there is none.
  std::optional<hsize_t> least_entries() const;
  /// Leaves so many entries of each growing dataset in this group and those below; they have no fewer. In groups of
  /// near nodes the rows of so many outputs are left.
  void cut(hsize_t entries) const;
  /// Reads this group's attributes and the last entry of each growing dataset in it and in those below: throws
  /// std::runtime_error where one is damaged.
  void check_last() const;

  void set_attribute(const std::string& name, double value) const;
  void set_attribute(const std::string& name, long value) const;
  void set_attribute(const std::string& name, const std::string& value) const;
  void set_attribute(const std::string& name, const char* value) const { set_attribute(name, std::string(value)); }
  void set_attribute(const std::string& name, const std::vector<std::string>& values) const;
  void set_attribute(const std::string& name, const std::vector<long>& values) const;
  /// As ASCII characters of just that number, for readers that know no texts of any length.
  void set_fixed_text_attribute(const std::string& name, const std::string& value) const;

  bool has_attribute(const std::string& name) const;
  double number_attribute(const std::string& name) const;
  std::string text_attribute(const std::string& name) const;
  std::vector<std::string> texts_attribute(const std::string& name) const;  ///< what was set as a list of texts

 private:
  Handle new_attribute(const std::string& name, hid_t type, hid_t space) const;
  template <class Do>
  void each_growing(const Do& one, bool with_near_nodes) const;
  void cut_near_nodes(hsize_t outputs) const;
  Handle id_;
  std::string name_;
  bool extends_ = false;  ///< takes what is there
  ThreadCount threads_;
};

/// Another file has the name of one that is being written; says where what was written is now.
class NameTaken : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

class File {
 public:
  File() = default;

  /// Makes a new file, called PATH.new until it gets its name: nobody ever sees half of it, and a PATH that is there
  /// stays until then. Where PATH.new is somebody else's it is PATH.new.1, and so on. Symbolic links of PATH are
  /// followed. The file has its mark, the attribute `format` of its kind, from the start; it does not take a name that
  /// has become somebody else's, see expect_replaceable(). What has not got its name goes with this object. Every
  /// flush() happens or does not, also when the program is killed amid it or the disk is full (see hdf5_journal.hpp).
  static File create(const std::string& path, const FileKind& kind);

  /// For reading. A flush that a killed program began is finished first.
  static File open(const std::string& path);

  /// For adding to what is there, as if it had just been made: groups and datasets that exist are taken. Flushes are as
  /// after create().
  static File extend(const std::string& path);

  File(File&& other) noexcept;
  File& operator=(File&& other) noexcept;
  ~File();

  /// What groups that are asked for from now on, and their datasets, compress on several threads where it pays.
  void compress_on(ThreadCount threads) { threads_ = std::move(threads); }

  bool is_open() const { return id_.get() >= 0; }
  Group root() const;
  void flush() const;

  /// Gives it its name while it goes on being written.
  void take_name();

  /// @return what was done where somebody has moved or removed the file (see hdf5::keep_name); empty: nothing
  std::string keep_name() const;

  /// Writes everything, closes, and gives a file that has it not its name when all is on the disk; throws if that
  /// fails, unlike the destructor.
  /// @param before_naming is given the name that the file has until then
  void close(const std::function<void(const std::string&)>& before_naming = {});

 private:
  enum class Name { own, unfinished };
  File(Handle id, std::string path) : id_(std::move(id)), path_(std::move(path)) {}
  void abandon() noexcept;
  Handle id_;
  std::string path_;
  Name name_ = Name::own;
  std::string beside_;  ///< its name while that is unfinished
  FileKind kind_;
  bool extends_ = false;
  ThreadCount threads_;
};

/// HDF5 may loop without end in a damaged file. From now on a call of the readers may take so many seconds of
/// processor time; one that takes longer ends the process by SIGPROF. For processes that do nothing but read.
/// @param seconds 0: no limit, as at the start
void limit_calls(double seconds);

/// A call of HDF5, from making this to its end.
class LimitedCall {
 public:
  LimitedCall();
  ~LimitedCall();
  LimitedCall(const LimitedCall&) = delete;
  LimitedCall& operator=(const LimitedCall&) = delete;
};

}  // namespace railwave::hdf5

namespace railwave {

/// SI unit of a dataset in results, model, mode and fault files, which each gets as its attribute `unit`; "1" of
/// numbers, counts and shares. Empty for a dataset that is none of these, as in checkpoints. Files of columns (contact
/// solutions, signals, responses, decay rates) have units of their own.
/// @param path in the file, e.g. /history/set/rail.middle/stress
std::string unit_of(const std::string& path);

}  // namespace railwave
