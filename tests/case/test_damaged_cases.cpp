#include <catch2/catch_test_macros.hpp>

#include "source_folder.hpp"
#include "tests/case/temporary_case.hpp"

using namespace railwave;
using namespace railwave::test;

namespace {

std::string rolling_case() { return text_of(source_folder + "/cases/rolling.toml"); }

/// Reads the text as a case; anything but a scene or an InputError with a message fails the test.
void read_anyhow(const TemporaryCase& file, const std::string& text) {
  file.write("case.toml", text);
  try {
    read_case(file.path());
  } catch (const InputError& error) {
    if (std::string(error.what()).find(file.path()) != 0) FAIL("a message without the file's name: " << error.what());
  } catch (const std::exception& error) {
    FAIL("not an InputError: " << error.what() << "\nfor the text:\n" << text);
  }
}

}  // namespace

TEST_CASE("a case cut off anywhere is read or refused with a message", "[case]") {
  const auto text = rolling_case();
  REQUIRE(text.size() > 1000);
  TemporaryCase file("");
  for (std::size_t length = 0; length < text.size(); ++length) read_anyhow(file, text.substr(0, length));
}

TEST_CASE("a case that lacks a letter is read or refused with a message", "[case]") {
  const auto text = rolling_case();
  TemporaryCase file("");
  for (std::size_t at = 0; at < text.size(); at += 3) read_anyhow(file, text.substr(0, at) + text.substr(at + 1));
}

TEST_CASE("a case with a wrong letter is read or refused with a message", "[case]") {
  const auto text = rolling_case();
  const std::string wrong = std::string("[]{}=\"'#.,-\n\\e9x \x80\xff", 19) + std::string(1, '\0');
  TemporaryCase file("");
  for (std::size_t at = 0; at < text.size(); at += 2) {
    auto damaged = text;
    damaged[at] = wrong[at / 2 % wrong.size()];
    read_anyhow(file, damaged);
  }
}

TEST_CASE("no two wrong letters after one another make it fall over", "[case]") {
  const std::string wrong = "[]{}=\"'#.,-+\n\\e9x \x80";
  TemporaryCase file("");
  for (const char first : wrong) {
    for (const char second : wrong) {
      const std::string both{first, second};
      for (const auto& text : {both + " = 1\n", "a" + both + "b = 1\n", "a = " + both + "\n", "a = [" + both + "]\n",
                               "a = [1" + both + "2]\n", "a = {b" + both + "c = 1}\n", "[a" + both + "b]\n",
                               "[" + both + "\n", "[[a" + both + "]]\n", "a = \"" + both + "\"\n"}) {
        read_anyhow(file, text);
      }
    }
  }
}

TEST_CASE("deep nesting is refused with a message", "[case]") {
  TemporaryCase file("");
  read_anyhow(file, "a = " + std::string(10000, '['));
  std::string dotted = "a";
  for (int i = 0; i < 3000; ++i) dotted += ".a";
  read_anyhow(file, dotted + " = 1\n");
  read_anyhow(file, "[" + dotted + "]\n");
  for (int i = 0; i < 7; ++i) dotted += "." + dotted;
  read_anyhow(file, dotted + " = 1\n");
  read_anyhow(file, "x = { " + dotted + " = 1 }\n");
  CHECK(mistakes_of(file.path()) == file.path() + ":1: not valid TOML: a name has more than 200 dots");
}
