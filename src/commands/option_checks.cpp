#include "commands/command_line.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <string>
#include <vector>

#include "case/complaints.hpp"
#include "case/key.hpp"
#include "case/read_value.hpp"

namespace railwave {
namespace {

using case_file::between;
using case_file::printable;
using case_file::Range;

struct NumberOption {
  const char* command;  ///< "": of all
  const char* name;
  const char* unit;
  Range range;
  const char* example;
  bool whole = false;
};

const std::vector<NumberOption>& number_options() {
  constexpr double any = 1e9, tiny = 1e-9;  // s, Hz, m/s: nothing of a run lies beyond
  static const std::vector<NumberOption> all = {
      {"run", "--wall-time", "s", between(tiny, any), "3600"},
      {"check", "--ranks", "", between(1, 100000), "4", true},
      {"mesh", "--ranks", "", between(1, 100000), "4", true},
      {"sweep", "--jobs", "", between(1, 1000), "4", true},
      {"sweep", "--threads", "", between(1, 512), "2", true},
      {"sweep", "--slurm", "", between(1, 10000), "4", true},
      {"sweep", "--retries", "", between(0, 1000), "2", true},
      {"modes", "--up-to", "Hz", between(tiny, any), "5000"},
      {"contact", "--from", "s", between(-any, any), "1e-3"},
      {"contact", "--to", "s", between(-any, any), "2e-3"},
      {"contact", "--interval", "s", between(0, any), "1e-5"},
      {"contact", "--rolling-direction", "", between(-any, any), "1,0,0"},
      {"contact", "--ring", "", between(0, any), "1.5,3"},
      {"contact", "--rolling-velocity", "m/s", between(tiny, 1e5), "27.78"},
      {"frf", "--from", "Hz", between(0, any), "20"},
      {"frf", "--to", "Hz", between(tiny, any), "5000"},
      {"decay", "--from", "Hz", between(tiny, any), "100"},
      {"decay", "--to", "Hz", between(tiny, any), "5000"},
      {"report", "--instants", "", between(2, 10000), "60", true},
      {"report", "--size", "MB", between(1, 1000), "14"},
      {"", "--window-end", "", {tiny, 1, false, true}, "0.05"},
      {"", "--resolution", "Hz", between(tiny, any), "1"},
      {"frf", "--prominence", "dB", between(tiny, 1000), "3"},
      {"", "--from", "s", between(-any, any), "1e-3"},
      {"", "--to", "s", between(-any, any), "2e-3"},
      {"", "--low", "Hz", between(0, any), "100"},
      {"", "--high", "Hz", between(tiny, any), "2000"},
      {"", "--order", "", between(1, 20), "4", true},
      {"", "--segment", "s", between(tiny, any), "1e-3"},
      {"", "--overlap", "", {0, 1, false, true}, "0.5"},
      {"", "--w0", "", between(5, 50), "6"},
      {"", "--scale-spacing", "octaves", between(tiny, 1), "0.125"},
  };
  return all;
}

/// The whole text as a finite number.
bool read_number(const std::string& text, double& number) {
  const char* first = text.data();
  const char* last = first + text.size();
  if (first != last && *first == '+') ++first;
  const auto [end, trouble] = std::from_chars(first, last, number);
  return trouble == std::errc() && end == last && std::isfinite(number);
}

CLI::Validator number_check(const NumberOption& option) {
  const auto check = [&option](std::string& text) -> std::string {
    const std::string unit = *option.unit != 0 ? std::string(" ") + option.unit : "";
    const std::string wanted =
        fmt::format("must be {}{}, {}, such as {}", option.whole ? "a whole number" : "a number",
                    unit.empty() ? "" : " in" + unit, case_file::range_text(option.range), option.example);
    double number = 0;
    if (text.empty()) return "is empty, " + wanted;
    const bool good =
        read_number(text, number) && option.range.has(number) && (!option.whole || std::floor(number) == number);
    return good ? "" : fmt::format("is '{}', {}", printable(text, 40), wanted);
  };
  return CLI::Validator(check, "");
}

struct FileOption {
  const char* name;
  const char* what;
  const char* example;
};

constexpr FileOption file_options[] = {
    {"case", "a case file", "cases/rolling.toml"},
    {"results", "a results file", "results.h5"},
    {"study", "a study file", "studies/rolling_grid/rolling_grid.toml"},
    {"deck", "a keyword deck", "impact.k"},
    {"--out", "a file", "mesh.h5"},
    {"--csv", "a file", "table.csv"},
    {"--hdf5", "a file", "more.h5"},
    {"--nodes", "a file", "nodes.csv"},
    {"--cuts", "a file", "cuts.csv"},
};

CLI::Validator file_check(const FileOption& option) {
  const auto check = [&option](std::string& text) -> std::string {
    if (text.empty()) return fmt::format("is empty, must be the name of {}, such as {}", option.what, option.example);
    if (text == "-")
      return fmt::format(
          "is '-', which stands for no file here: standard input and output are not used; give the name of {}, such as "
          "{}",
          option.what, option.example);
    if (text.find('\0') != std::string::npos) return "holds a zero byte, which no file's name has";
    return "";
  };
  return CLI::Validator(check, "");
}

void add_checks(CLI::App& app, const std::string& command) {
  for (CLI::Option* option : app.get_options()) {
    const std::string name = option->get_name();
    const NumberOption* number = nullptr;
    for (const NumberOption& one : number_options())
      if (!number && one.name == name && (*one.command == 0 || one.command == command)) number = &one;
    if (number) option->check(number_check(*number));
    for (const FileOption& one : file_options)
      if (one.name == name) option->check(file_check(one));
  }
  for (CLI::App* sub : app.get_subcommands({})) add_checks(*sub, sub->get_name());
}

}  // namespace

void add_option_checks(CLI::App& app) { add_checks(app, ""); }

}  // namespace railwave
