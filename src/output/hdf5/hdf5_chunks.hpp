#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "output/hdf5/hdf5.hpp"

/// Compression of large arrays on several threads. HDF5 filters one chunk after the other, on the thread that calls it;
/// here its filters (shuffle, deflate, fletcher32) are applied to several chunks at once, and that thread writes them
/// as they are, in order. The file's bytes are those that HDF5's own filters make where both use the same zlib.
namespace railwave::hdf5 {

/// HDF5's checksum of the filter fletcher32: of the bytes taken by twos, the first the higher, and an odd one at the
/// end the higher of a pair.
std::uint32_t fletcher32(const unsigned char* bytes, std::size_t size);

/// Writes rows of a dataset that has chunks and room for them, unless H5Dwrite is to: where it would be one chunk, the
/// rows begin amid a chunk, HDF5 would have to convert the values otherwise than from double to single, the filters are
/// others, the program was built without zlib, or memory is little.
/// @param name for messages
/// @param first row in the dataset
/// @param block shape of what is written; block[0]: how many rows
/// @param threads how many may compress; asked again before each chunk
/// @return whether it has
template <class T>
bool write_chunks(hid_t dataset, const std::string& name, hsize_t first, const Shape& block, const T* values,
                  const ThreadCount& threads);

/// How rows lie of a dataset of numbers whose rows are one chunk each and have those filters; nothing: it is another.
std::optional<RowLayout> row_layout(hid_t dataset, const std::string& name);

/// Applies the filters to a row. @return empty: there was no memory for it
PackedRow pack_row(const RowLayout& layout, const double* row);

/// Writes a chunk as it goes into the file.
/// @param offset of its first value in the dataset
void write_chunk(hid_t dataset, const std::string& name, const Shape& offset, const void* bytes, std::size_t size);

}  // namespace railwave::hdf5
