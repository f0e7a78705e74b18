#pragma once

#include <hdf5.h>

#include <string>

/// A file driver of HDF5 for files that grow while a program may be killed at any moment. Array data go to the file at
/// once, where nothing that was flushed before points to. The file's structure (everything else) is held back until
/// HDF5 flushes; then, in this order: what lies beyond the file's old end is written, to which nothing points yet; the
/// rest is written as a journal behind the new end, with a checksum; then to its places; and the journal is cut off. A
/// kill before the journal is whole leaves the file as it was flushed last, with bytes behind its end that HDF5 does
/// not look at; after that finish_journal() does the rest. So a flush happens or does not.
namespace railwave::hdf5 {

/// Has files be opened and made by this driver. They are locked (flock) for their writer alone.
void use_journal(hid_t access);

/// Writes what a killed program's journal holds to its places. Nothing is done to a file that a program is writing now,
/// and to one without a journal. Throws std::runtime_error if the system refuses.
void finish_journal(const std::string& path);

/// The descriptor of a file that this driver has open.
int& descriptor_of(hid_t file);

/// A file that is being written and whose name was taken from it, or that was moved, gets its name again; one without
/// any name is written anew from what the system still holds of it.
/// @return what was done, for people; empty: the name is there. Throws NameTaken (hdf5.hpp) if another file has taken
/// the name, std::runtime_error if the system refuses.
std::string keep_name(hid_t file, const std::string& path);

}  // namespace railwave::hdf5
