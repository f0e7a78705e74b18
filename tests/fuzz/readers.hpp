#pragma once

#include <string>
#include <string_view>
#include <vector>

// The readers of users' files as functions of bytes, for libFuzzer (libfuzzer/) and for test_readers.cpp, which feeds
// them what libFuzzer has found. A file that is refused with an InputError, or read, is fine; every other exception
// goes on to the caller.
namespace railwave::fuzz {

struct Reader {
  std::string name;  ///< also of the folders below corpus/ and regressions/
  void (*read)(std::string_view bytes);
};

const std::vector<Reader>& readers();
const Reader& find_reader(const std::string& name);

}  // namespace railwave::fuzz
