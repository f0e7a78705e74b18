#pragma once

#include <string>

/// What of a user's wish fits into this machine: asked before memory is, so that the answer is a message and not the
/// system's.
namespace railwave {

/// Measured on boxes of 200 and 600 thousand elastic elements, with a node an element: what reading or making a mesh
/// and putting it among the others takes, and what the model's arrays take on top, on the host or on the device.
inline constexpr double bytes_of_mesh_element = 250, bytes_of_model_element = 230;

/// Bytes that this process may still take: what the system has free or can free, within limits set for the process
/// (ulimit -v) or for the container around it. Infinity where the system doesn't tell.
double available_memory();

/// The most bytes of memory that this process has taken so far; 0 where the system doesn't tell.
double peak_memory();

/// Small pieces that were freed go back to the system where they are whole pages.
void give_freed_memory_back();

/// "3.2 GB", by powers of 1000.
std::string bytes_text(double bytes);

/// Whether an exception's words are those by which Kokkos says that it found no memory; takes none itself.
bool is_refusal_of_kokkos(const char* said);

/// What Kokkos wanted by such words: "3.725 GiB for the array position, in memory of Host".
std::string refused_by_kokkos(const std::string& said);

/// Throws MemoryShortage "`what` about 3.2 TB of memory, but this machine has 22 GB left; `mend`" when `bytes` are more
/// than `available`. `what` begins with the place and ends in a verb: "[meshes.rail] (line 3): ... needs".
void expect_memory(double bytes, const std::string& what, const std::string& mend, double available);
void expect_memory(double bytes, const std::string& what, const std::string& mend);

}  // namespace railwave
