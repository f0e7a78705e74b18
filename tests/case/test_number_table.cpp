#include <catch2/catch_test_macros.hpp>
#include <catch2/matchers/catch_matchers_string.hpp>

#include <clocale>
#include <locale>
#include <string>
#include <vector>

#include "case/error.hpp"
#include "case/number_table.hpp"
#include "case/number_text.hpp"
#include "tests/case/temporary_case.hpp"

using namespace railwave;
using namespace railwave::test;
using Catch::Matchers::ContainsSubstring;

namespace {

using Pairs = std::vector<std::array<double, 2>>;

/// A case with one curve from a file of these bytes.
struct CurveFile {
  TemporaryCase file{small_case + "[curves.c]\ntype = \"table\"\nfile = \"c.csv\"\n"};

  explicit CurveFile(const std::string& bytes) { file.write("c.csv", bytes); }
  std::string mistakes() const { return mistakes_of(file.path()); }
  Pairs points() const { return read_case(file.path()).curves.at(0).points; }
};

}  // namespace

TEST_CASE("a curve's file is read in every way of writing that has one meaning", "[case]") {
  const Pairs wanted{{0, 0.5}, {1e-3, -2}};
  for (const std::string bytes : {
           "0,0.5\n1e-3,-2\n",                           // commas
           "0;0.5\n1e-3;-2\n",                           // semicolons
           "0\t0.5\n1e-3\t-2",                           // tabs, no last line end
           "0   0.5\n 1e-3 -2 \n",                       // blanks
           "0, 0.5\r\n\r\n1e-3, -2\r\n",                 // blanks besides, line ends of Windows, an empty line
           "0,.5\r1.0E-3,-2.\r",                         // line ends of old, points at the ends
           "\xef\xbb\xbftime,value\n0,0.5\n+1e-3,-2\n",  // byte-order mark, names, a plus sign
           "\xef\xbb\xbf"
           "0,0.5\n1e-3,-2\n",                                   // byte-order mark before a number
           "# of channel 1, 25600 Hz\n0,0.5\n# end\n1e-3,-2\n",  // remarks
           "% 1\n0,0.5\n1e-3,-2\n",
           "Measured blow\n\"time (s)\";\"force (N)\"\n0;0.5\n0.001;-2\n",  // a title, names in quotes with units
           "t/s\tF/kN\n0\t0.5\n1D-3\t-2d0\n",                               // Fortran's exponents
           "0;\t0.5\n1e-3; -2\n",                                           // blanks around separators
       }) {
    const CurveFile curve(bytes);
    INFO(bytes << "\nsays: " << curve.mistakes());
    CHECK(curve.mistakes().empty());
    CHECK(curve.points() == wanted);
  }
}

TEST_CASE("what of a curve's file may be misread is refused with line, column and mend", "[case]") {
  struct Refused {
    std::string bytes, wanted;
  };
  const std::vector<Refused> all = {
      {"0;0,5\n1;1,5\n", "c.csv:1: column 2 (value): '0,5' has a comma in it: a decimal comma? then write 0.5"},
      {"0,5;1\n", "c.csv:1: column 1 (time in s): '0,5' has a comma in it: a decimal comma? then write 0.5"},
      {"0\t0,5\n", "c.csv:1: column 2 (value): '0,5' has a comma in it"},
      {"0 0,5\n", "c.csv:1: column 1 (time in s): '0 0' has more than one number in it"},
      {"0,0,0,5\n",
       "c.csv:1: has 4 values, must have two: time,value (numbers have decimal points; a comma separates columns)"},
      {"0,0\n1,5,2\n", "c.csv:2: has 3 values, must have two: time,value"},
      {"0,0,9\n", "c.csv:1: has 3 values, must have two: time,value"},
      {"0;1.000,5\n",
       "column 2 (value): '1.000,5' has commas in it; write a decimal point, and thousands without separators"},
      {"0;1,000,000\n", "'1,000,000' has commas in it"},
      {"0;1 000\n", "'1 000' has more than one number in it"},
      {"0;1'000\n", "'1'000' has more than one number in it"},
      {"0;1_000\n", "'1_000' has more than one number in it"},
      {"0,0.5 N\n", "c.csv:1: column 2 (value): '0.5 N' has something behind the number; write the number alone"},
      {"0 s,0.5\n", "column 1 (time in s): '0 s' has something behind the number"},
      {"0,5%\n", "'5%' has something behind the number"},
      {"0,0x10\n", "'0x10' is hexadecimal; write the number in decimal"},
      {"0,1e400\n", "'1e400' is too large"},
      {"0,-1e400\n", "'-1e400' is too large"},
      {"nan,0\n", "c.csv:1: column 1 (time in s): 'nan' is no finite number"},
      {"0,nan\n", "'nan' is no finite number"},
      {"0,-Inf\n", "'-Inf' is no finite number"},
      {"0,1.0.0\n", "'1.0.0' has more than one decimal point"},
      {"0,1..0\n", "'1..0' has more than one decimal point"},
      {"0,--1\n", "'--1' is no number"},
      {"0,1e\n", "'1e' has something behind the number"},
      {"0,1-2\n", "'1-2' has more than one number in it"},
      {"0,\xe2\x88\x92"
       "1\n",
       "has characters other than plain ones, perhaps a typographic minus"},
      {"0,\"0.5\"\n", "stands in quotes; write the number without them"},
      {"0,1,\n", "c.csv:1: '0,1,' ends with a separator, behind which column 3 is empty"},
      {"0,\n", "column 2 (value): '' is empty"},
      {",1\n", "column 1 (time in s): '' is empty"},
      {"0,,1\n", "column 2 (value): '' is empty"},
      {"0,1\n,\n", "c.csv:2: column 1 (time in s): '' is empty"},
      {"0\n1\n", "c.csv:1: has one value, must have two: time,value"},
      {"0,1\n1;2\n", "c.csv:2: its columns are separated by semicolons, those of line 1 by commas"},
      {"0,1\n1 2\n", "c.csv:2: its columns are separated by blanks, those of line 1 by commas"},
      {"0,1\ntime,value\n1,2\n", "c.csv:2: 'time,value' is text among numbers"},
      {"0,1\nend of file\n", "c.csv:2: 'end of file' is text among numbers"},
      {"O,0.5\n1,1\n", "c.csv:1: column 1 (time in s): 'O' is no number"},
      {"rate,25600\n0,1\n",
       "'rate' is no number; write one such as 0.5 or 5e-1 (a line of names has nothing that begins like a number; "
       "write # before remarks)"},
      {"time (ms),force\n0,1\n",
       "c.csv:1: column 1 (time in s) is called 'time (ms)', but is read in s; convert the numbers"},
      {"t_ms;f\n0;1\n", "is called 't_ms', but is read in s"},
      {"t [\xc2\xb5s];f\n0;1\n", "but is read in s"},
      {"value,time\n0,1\n",
       "c.csv:1: column 1 (time in s) is called 'value'; the order of the columns must be time,value"},
      {"0,1\n0,2\n", "c.csv:2: time must increase from line to line, but has 0 s after 0 s"},
      {"0,1\n2,2\n1,2\n", "c.csv:3: time must increase from line to line, but has 1 s after 2 s"},
      {std::string("\xff\xfe"
                   "0\0,\0"
                   "1\0\n\0",
                   10),
       "c.csv:1: the file is UTF-16 or UTF-32 text, or none; save it as UTF-8"},
      {std::string("\xfe\xff\0"
                   "0\0,\0"
                   "1\0\n",
                   10),
       "is UTF-16"},
      {std::string("0\0,\0"
                   "1\0\n\0",
                   8),
       "is UTF-16"},
      {std::string("0,1\n1,\0"
                   "2\n",
                   9),
       "c.csv:2: column 2 (value): "},
      {"", "has no line with a pair time,value"},
      {"time,value\n", "has no line with a pair time,value"},
      {"\n\n# nothing\n", "has no line with a pair time,value"},
  };
  for (const Refused& one : all) {
    const std::string said = CurveFile(one.bytes).mistakes();
    INFO(one.bytes << "\nsays: " << said);
    CHECK_THAT(said, ContainsSubstring(one.wanted));
    CHECK_THAT(said, ContainsSubstring("case.toml:"));
  }
}

TEST_CASE("a decimal number is read whole or not at all", "[case]") {
  CHECK(parse_real("1e-400") == 0);
  CHECK(parse_real("-1.5d3") == -1500);
  CHECK(parse_real("4.9e-324") == 4.9e-324);
  for (const char* text :
       {"", "+", "-", ".", "e5", "1e", "0x1p3", "1,5", " 1", "1 ", "inf", "NaN", "1e400", "-1e999", "+-1", "1.0f"}) {
    INFO(text);
    CHECK_FALSE(parse_real(text));
  }
}

namespace {

/// The decimal comma of half the world, and thousands in groups.
struct DecimalComma : std::numpunct<char> {
  char do_decimal_point() const override { return ','; }
  char do_thousands_sep() const override { return '.'; }
  std::string do_grouping() const override { return "\3"; }
};

/// Both kinds of locale of this process for as long as this lives: that of C++, and that of C where the machine has
/// one.
class CommaLocale {
 public:
  CommaLocale() : before_(std::locale::global(std::locale(std::locale::classic(), new DecimalComma))) {
    for (const char* name : {"de_DE.UTF-8", "de_DE.utf8", "nl_NL.UTF-8", "fr_FR.UTF-8", "de_DE"})
      if (std::setlocale(LC_ALL, name) != nullptr) break;
  }
  ~CommaLocale() {
    std::locale::global(before_);
    std::setlocale(LC_ALL, "C");
  }

 private:
  std::locale before_;
};

}  // namespace

TEST_CASE("numbers are read the same whatever the locale", "[case]") {
  CommaLocale comma;
  CHECK(parse_real("1.5") == 1.5);
  CHECK_FALSE(parse_real("1,5"));
  CHECK(parse_real("1.5e-400") == 0);
  const CurveFile curve("0,0.5\n1.25e-3,1234.5\n");
  REQUIRE(curve.mistakes().empty());
  CHECK(curve.points() == Pairs{{0, 0.5}, {1.25e-3, 1234.5}});
  const auto scene = read_case(curve.file.path(), {"time.end=1.5e-3", "time.step_scale=0.75"});
  CHECK(scene.time.end == 1.5e-3);
  CHECK(scene.time.step_scale == 0.75);
  CHECK(scene.materials.at(0).poissons_ratio == 0.3);
  CHECK(scene.static_text.find("1234.5") != std::string::npos);
  CHECK(mistakes_of(curve.file.path(), {"time.end=0,5"}) != "");
}
