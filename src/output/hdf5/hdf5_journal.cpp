#include "output/hdf5/hdf5_journal.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <iterator>
#include <memory>
#include <new>
#include <stdexcept>
#include <vector>

#include "output/disk.hpp"
#include "output/hash.hpp"

namespace railwave::hdf5 {
namespace {

/// Where a piece of structure goes.
struct Piece {
  std::uint64_t place, size;
};

/// The journal's last bytes; before them `size` bytes of pieces, each behind its Piece.
struct Footer {
  char mark[8];
  std::uint64_t size, length, checksum;  ///< length: the file's, once the journal is cut off
};
constexpr char mark[8] = {'R', 'W', 'j', 'o', 'u', 'r', 'n', '1'};

std::uint64_t checksum_of(const std::vector<char>& pieces, std::uint64_t length) {
  Hash hash;
  hash.add_words(pieces.data(), pieces.size());
  hash.add(&length, sizeof length);
  return hash.value();
}

void add_piece(std::vector<char>& pieces, const Piece& piece, const void* bytes) {
  const auto* head = reinterpret_cast<const char*>(&piece);
  const auto* from = static_cast<const char*>(bytes);
  pieces.insert(pieces.end(), head, head + sizeof piece);
  pieces.insert(pieces.end(), from, from + piece.size);
}

/// take(piece, bytes) for each, until one returns false.
template <class Take>
bool each_piece(const std::vector<char>& pieces, const Take& take) {
  for (std::size_t at = 0; at + sizeof(Piece) <= pieces.size();) {
    Piece piece;
    std::memcpy(&piece, pieces.data() + at, sizeof piece);
    at += sizeof piece;
    if (piece.size > pieces.size() - at) return false;
    if (!take(piece, pieces.data() + at)) return false;
    at += piece.size;
  }
  return true;
}

bool write_pieces(int file, const std::vector<char>& pieces) {
  return each_piece(pieces, [&](const Piece& piece, const char* bytes) {
    return disk::write_at(file, bytes, piece.size, static_cast<off_t>(piece.place));
  });
}

/// In which order pieces go to their places, for other programs that read a file as a kill left it amid that: first
/// what tells the file's length, then the indices of arrays from their roots to their leaves, then the rest, with the
/// arrays' extents. Who sees an extent thus finds what it counts.
int rank(const Piece& piece, const char* bytes) {
  constexpr int level_of_node = 5;
  if (piece.place == 0) return 0;
  if (piece.size > level_of_node && std::memcmp(bytes, "TREE", 4) == 0)
    return 1 + 255 - static_cast<unsigned char>(bytes[level_of_node]);
  const bool index = piece.size > 4 && (std::memcmp(bytes, "EA", 2) == 0 ||
                                        std::memcmp(bytes, "FA", 2) == 0);  // extensible and fixed arrays
  return index ? 257 : 258;
}

std::vector<char> in_order(const std::vector<char>& pieces) {
  struct Ranked {
    int rank;
    Piece piece;
    const char* bytes;
  };
  std::vector<Ranked> list;
  each_piece(pieces, [&](const Piece& piece, const char* bytes) {
    return list.push_back({rank(piece, bytes), piece, bytes}), true;
  });
  std::stable_sort(list.begin(), list.end(), [](const Ranked& a, const Ranked& b) { return a.rank < b.rank; });
  std::vector<char> ordered;
  ordered.reserve(pieces.size());
  for (const Ranked& one : list) add_piece(ordered, one.piece, one.bytes);
  return ordered;
}

struct JournalledFile {
  H5FD_t base;  // first: HDF5 knows only this
  int descriptor;
  std::string path;
  bool writes;
  int failed;                 ///< errno of the first call that the system refused; 0: none
  haddr_t end;                ///< of what HDF5 has given out
  haddr_t flushed_end;        ///< that of the last flush: nothing that lies beyond is pointed to
  std::vector<char> waiting;  ///< pieces of structure
};

JournalledFile& own(H5FD_t* file) { return *reinterpret_cast<JournalledFile*>(file); }
const JournalledFile& own(const H5FD_t* file) { return *reinterpret_cast<const JournalledFile*>(file); }

herr_t complain(const JournalledFile& file, const char* doing) {
  try {
    const std::string reason = disk::reason(), mend = disk::mend();
    H5Epush2(H5E_DEFAULT, __FILE__, __func__, __LINE__, H5E_ERR_CLS, H5E_IO, H5E_WRITEERROR, "%s %s: %s%s%s", doing,
             file.path.c_str(), reason.c_str(), mend.empty() ? "" : "; ", mend.c_str());
  } catch (const std::exception&) {  // not even memory for the words
  }
  return -1;
}

/// Once the system has refused a write the file is left as it was flushed last. HDF5 cannot undo its writes, so further
/// ones, and closing, report success to it and do nothing; every later flush fails as the first did.
herr_t give_up(JournalledFile& file, const char* doing) {
  file.failed = errno;
  const herr_t result = complain(file, doing);
  file.waiting.clear();
  return result;
}

herr_t flush(JournalledFile& file) {
  if (!file.writes || file.failed) return 0;
  if (file.waiting.empty()) return 0;  // also where HDF5 has not yet found out where a file ends that it opens
  std::vector<char> in_place;
  const bool beyond = each_piece(file.waiting, [&](const Piece& piece, const char* bytes) {
    if (piece.place >= file.flushed_end)
      return disk::write_at(file.descriptor, bytes, piece.size, static_cast<off_t>(piece.place));
    add_piece(in_place, piece, bytes);
    return true;
  });
  const off_t length = disk::length_of(file.descriptor);
  if (!beyond || length < 0) return give_up(file, "writing");
  if (!in_place.empty()) {
    in_place = in_order(in_place);
    Footer footer;
    std::memcpy(footer.mark, mark, sizeof mark);
    footer.size = in_place.size();
    footer.length = file.end;
    footer.checksum = checksum_of(in_place, file.end);
    std::vector<char> journal = in_place;
    const auto* bytes = reinterpret_cast<const char*>(&footer);
    journal.insert(journal.end(), bytes, bytes + sizeof footer);
    const off_t place = std::max(length, static_cast<off_t>(file.end));
    if (!disk::write_at(file.descriptor, journal.data(), journal.size(), place)) {
      const int reason = errno;
      static_cast<void>(!ftruncate(file.descriptor, static_cast<off_t>(file.flushed_end)));
      errno = reason;
      return give_up(file, "writing");
    }
    // From here on the journal is to stay until all of it is in place.
    if (!write_pieces(file.descriptor, in_place)) return give_up(file, "writing");
  }
  if (ftruncate(file.descriptor, static_cast<off_t>(file.end)) != 0) return give_up(file, "writing");
  file.flushed_end = file.end;
  file.waiting.clear();
  return 0;
}

/// HDF5's own switch.
bool locks() {
  const char* said = std::getenv("HDF5_USE_FILE_LOCKING");
  return !said || (std::strcmp(said, "FALSE") != 0 && std::strcmp(said, "0") != 0);
}

/// HDF5 is C: an exception that went through it would leave its lock taken for ever.
template <class Do>
herr_t without_exceptions(JournalledFile& file, const Do& one) {
  try {
    return one();
  } catch (const std::exception&) {
    errno = ENOMEM;
    return give_up(file, "writing");
  }
}

H5FD_t* open_file(const char* name, unsigned flags, hid_t, haddr_t) try {
  int how = (flags & H5F_ACC_RDWR) ? O_RDWR : O_RDONLY;
  if (flags & H5F_ACC_CREAT) how |= O_CREAT;
  if (flags & H5F_ACC_EXCL) how |= O_EXCL;
  auto file = std::unique_ptr<JournalledFile>(new (std::nothrow) JournalledFile{});
  if (!file) return nullptr;
  file->path = name;
  file->writes = (flags & H5F_ACC_RDWR) != 0;
  file->descriptor = open(name, how | O_CLOEXEC, 0666);
  if (file->descriptor < 0) {
    complain(*file, "opening");
    return nullptr;
  }
  disk::Descriptor guard(file->descriptor);
  // Locked before anything is cut: it may be another program's.
  if (file->writes && locks() && flock(file->descriptor, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
    H5Epush2(H5E_DEFAULT, __FILE__, __func__, __LINE__, H5E_ERR_CLS, H5E_FILE, H5E_CANTOPENFILE,
             "another program has it open (ParaView, a script, another run?); close it there");
    return nullptr;
  }
  if ((flags & H5F_ACC_TRUNC) && ftruncate(file->descriptor, 0) != 0) {
    complain(*file, "emptying");
    return nullptr;
  }
  file->flushed_end = static_cast<haddr_t>(std::max<off_t>(disk::length_of(file->descriptor), 0));
  guard.release();
  return &file.release()->base;
} catch (const std::exception&) {
  return nullptr;
}

herr_t close_file(H5FD_t* base) {
  const std::unique_ptr<JournalledFile> file(&own(base));
  const herr_t flushed = without_exceptions(*file, [&] { return flush(*file); });
  // What came after the last flush that went well is pointed to by nothing. A journal that is not yet in place is left.
  if (file->failed) {
    Footer footer{};
    const off_t length = disk::length_of(file->descriptor);
    const bool journal =
        length >= static_cast<off_t>(sizeof footer) &&
        disk::read_at(file->descriptor, &footer, sizeof footer, length - static_cast<off_t>(sizeof footer)) &&
        std::memcmp(footer.mark, mark, sizeof mark) == 0;
    if (!journal) static_cast<void>(!ftruncate(file->descriptor, static_cast<off_t>(file->flushed_end)));
  }
  const bool closed = close(file->descriptor) == 0;
  return flushed < 0 || !closed ? -1 : 0;
}

herr_t query(const H5FD_t*, unsigned long* flags) {
  if (flags)
    *flags = H5FD_FEAT_AGGREGATE_METADATA | H5FD_FEAT_DATA_SIEVE | H5FD_FEAT_AGGREGATE_SMALLDATA |
             H5FD_FEAT_DEFAULT_VFD_COMPATIBLE;
  return 0;
}

haddr_t get_end(const H5FD_t* file, H5FD_mem_t) { return own(file).end; }

herr_t set_end(H5FD_t* file, H5FD_mem_t, haddr_t end) {
  own(file).end = end;
  return 0;
}

haddr_t get_length(const H5FD_t* base, H5FD_mem_t) {
  const JournalledFile& file = own(base);
  auto length = static_cast<haddr_t>(std::max<off_t>(disk::length_of(file.descriptor), 0));
  each_piece(file.waiting, [&](const Piece& piece, const char*) {
    return length = std::max<haddr_t>(length, piece.place + piece.size), true;
  });
  return length;
}

herr_t get_handle(H5FD_t* file, hid_t, void** handle) {
  *handle = &own(file).descriptor;
  return 0;
}

herr_t read(H5FD_t* base, H5FD_mem_t, hid_t, haddr_t place, size_t size, void* buffer) {
  JournalledFile& file = own(base);
  if (!disk::read_at(file.descriptor, buffer, size, static_cast<off_t>(place))) return complain(file, "reading");
  each_piece(file.waiting, [&](const Piece& piece, const char* bytes) {
    const std::uint64_t from = std::max<std::uint64_t>(place, piece.place),
                        to = std::min<std::uint64_t>(place + size, piece.place + piece.size);
    if (from < to) std::memcpy(static_cast<char*>(buffer) + (from - place), bytes + (from - piece.place), to - from);
    return true;
  });
  return 0;
}

herr_t write(H5FD_t* base, H5FD_mem_t type, hid_t, haddr_t place, size_t size, const void* buffer) {
  JournalledFile& file = own(base);
  if (file.failed) return 0;
  // A chunk that was flushed and gets more rows is written again in its place, with another checksum: it waits like
  // structure.
  if (type == H5FD_MEM_DRAW && place >= file.flushed_end)
    return disk::write_at(file.descriptor, buffer, size, static_cast<off_t>(place)) ? 0 : give_up(file, "writing");
  return without_exceptions(file, [&] { return add_piece(file.waiting, {place, size}, buffer), 0; });
}

herr_t flush_file(H5FD_t* base, hid_t, hbool_t closing) {
  JournalledFile& file = own(base);
  if (!file.failed || closing) return without_exceptions(file, [&] { return flush(file); });
  errno = file.failed;
  return complain(file, "writing");
}

hid_t driver() {
  static const hid_t registered = [] {
    constexpr H5FD_mem_t kinds[] = H5FD_FLMAP_DICHOTOMY;  // array data never take freed places of structure
    H5FD_class_t driver{};
#if H5_VERSION_GE(1, 13, 0)
    driver.version = H5FD_CLASS_VERSION;
    driver.value = static_cast<H5FD_class_value_t>(512 + 'R');
#endif
    driver.name = "journal";
    driver.maxaddr = (haddr_t{1} << 62) - 1;
    driver.fc_degree = H5F_CLOSE_STRONG;  // nothing is to be written after a file has been closed and sealed
    driver.open = open_file;
    driver.close = close_file;
    driver.query = query;
    driver.get_eoa = get_end;
    driver.set_eoa = set_end;
    driver.get_eof = get_length;
    driver.get_handle = get_handle;
    driver.read = read;
    driver.write = write;
    driver.flush = flush_file;
    std::copy(std::begin(kinds), std::end(kinds), driver.fl_map);
    return H5FDregister(&driver);
  }();
  return registered;
}

}  // namespace

void use_journal(hid_t access) {
  if (driver() < 0 || H5Pset_driver(access, driver(), nullptr) < 0)
    throw std::runtime_error("HDF5 refuses the driver for results files");
}

void finish_journal(const std::string& path) {
  const auto fail = [&](const char* what) { throw std::runtime_error(path + " " + what + ": " + disk::reason()); };
  disk::Descriptor file(open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
  Footer footer{};
  const off_t length = file.get() < 0 ? -1 : disk::length_of(file.get());
  if (length < static_cast<off_t>(sizeof footer) ||
      !disk::read_at(file.get(), &footer, sizeof footer, length - static_cast<off_t>(sizeof footer)) ||
      std::memcmp(footer.mark, mark, sizeof mark) != 0)
    return;
  if (flock(file.get(), LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) return;
  const off_t before = static_cast<off_t>(sizeof footer);
  if (footer.size > static_cast<std::uint64_t>(length - before)) return;
  std::vector<char> pieces(footer.size);
  if (!disk::read_at(file.get(), pieces.data(), pieces.size(), length - before - static_cast<off_t>(footer.size)))
    fail("cannot be read");
  if (checksum_of(pieces, footer.length) != footer.checksum) return;
  disk::Descriptor written(open(path.c_str(), O_RDWR | O_CLOEXEC));
  if (written.get() < 0) fail("is as a killed run left it, and to finish it it must be writable");
  if (!write_pieces(written.get(), pieces) || ftruncate(written.get(), static_cast<off_t>(footer.length)) != 0 ||
      fsync(written.get()) != 0)
    fail("is as a killed run left it, and cannot be finished");
}

int& descriptor_of(hid_t file) {
  void* handle = nullptr;
  if (H5Fget_vfd_handle(file, H5P_DEFAULT, &handle) < 0 || !handle)
    throw std::runtime_error("HDF5 does not tell a file's descriptor");
  return *static_cast<int*>(handle);
}

}  // namespace railwave::hdf5
