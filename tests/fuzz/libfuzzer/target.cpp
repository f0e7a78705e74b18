#include <cstddef>
#include <cstdint>

#include "tests/fuzz/readers.hpp"

// One program for each reader: RAILWAVE_READER is its name. What isn't an InputError ends the program, which is a
// finding.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const auto& reader = railwave::fuzz::find_reader(RAILWAVE_READER);
  reader.read({reinterpret_cast<const char*>(data), size});
  return 0;
}
