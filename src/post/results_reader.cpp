#include "post/results_reader.hpp"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <stdexcept>

#include <fmt/format.h>

#include "case/error.hpp"
#include "case/suggest.hpp"

namespace railwave {
namespace {

constexpr double known_version = 1;

void check_readable(const std::string& path) {
  std::error_code error;
  if (std::filesystem::is_directory(path, error))
    throw InputError(fmt::format("{} is a folder, not a results file", path));
  if (std::filesystem::exists(path, error) && !std::filesystem::is_regular_file(path, error))
    throw InputError(fmt::format("{} is a pipe, device or socket, not a results file", path));
  std::FILE* file = std::fopen(path.c_str(), "rb");
  if (!file) throw InputError(fmt::format("cannot open results file {}: {}", path, std::strerror(errno)));
  char mark[8] = {};
  const std::size_t length = std::fread(mark, 1, sizeof mark, file);
  std::fclose(file);
  if (length < sizeof mark || std::memcmp(mark, "\211HDF\r\n\032\n", sizeof mark) != 0)
    throw InputError(
        fmt::format("{} is no HDF5 file, so no results file of Railwave; 'railwave run' writes one under the name that "
                    "the case gives as output.file",
                    path));
}

}  // namespace

ResultsReader::ResultsReader(const std::string& path) : path_(path) {
  check_readable(path);
  try {
    file_ = hdf5::File::open(path);
    const hdf5::Group root = file_.root();
    if (!root.has_attribute("format") || root.text_attribute("format") != "Railwave results")
      throw InputError(fmt::format("{} is an HDF5 file, but no results file of Railwave", path));
    if (root.number_attribute("format_version") > known_version)
      throw InputError(fmt::format("{} was written by a newer program ({}), in a format that this one does not know",
                                   path, root.text_attribute("program")));
    if (root.has_attribute("title"))
      title_ = root.text_attribute("title");  // now, before a command has written half of its files
  } catch (const InputError&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    const std::string reason = error.what();
    if (reason.find("truncated") != std::string::npos)
      throw InputError(
          fmt::format("results file {} is cut short: copy it again, or repeat the run ({})", path, reason));
    throw InputError(fmt::format("results file {} cannot be read: {}", path, reason));
  }
}

bool ResultsReader::completed() const {
  return report_damage([&] { return file_.root().number_attribute("completed") != 0; });
}
std::string ResultsReader::reason() const {
  return report_damage([&] { return file_.root().text_attribute("reason"); });
}

std::vector<std::string> ResultsReader::contacts() const {
  return report_damage([&] { return file_.root().group("contact").names(); });
}

hdf5::Group ResultsReader::history() const {
  return report_damage([&] { return file_.root().group("history"); });
}

std::string ResultsReader::slave_surface(const std::string& contact) const {
  return report_damage([&] {
    const std::string surface = file_.root().group("contact").group(contact).group("slave").text_attribute("surface");
    if (surface.empty()) throw std::runtime_error("its slave surface has no name");
    return surface;
  });
}

hdf5::Group ResultsReader::contact_group(const std::string& contact) const {
  return file_.root().group("contact").group(contact);
}

std::vector<Eigen::Vector3d> ResultsReader::set_velocity(const std::string& set,
                                                         const std::vector<double>& times) const {
  try {
    const hdf5::Group history = file_.root().group("history");
    const std::vector<std::string> known =
        history.has("set") ? history.group("set").names() : std::vector<std::string>{};
    if (known.empty())
      throw InputError(
          fmt::format("results file {} has the history of no set; the case names them in output.history_sets", path_));
    if (std::find(known.begin(), known.end(), set) == known.end())
      throw InputError(
          fmt::format("results file {} has no history of set '{}'; {}", path_, set, suggestion(set, known)));
    const std::vector<double> sampled = history.dataset("time").read<double>();
    if (!history.group("set").group(set).has("velocity"))
      throw InputError(
          fmt::format("results file {} has the history of '{}' without its velocity; name a set of nodes, or a probe "
                      "whose quantities include velocity",
                      path_, set));
    const std::vector<double> velocity = history.group("set").group(set).dataset("velocity").read<double>();
    const std::size_t count = std::min(sampled.size(), velocity.size() / 3);
    if (count == 0) throw std::runtime_error("its history is empty");
    std::vector<Eigen::Vector3d> result;
    for (const double time : times) {
      const std::size_t after = std::upper_bound(sampled.begin(), sampled.begin() + count, time) - sampled.begin();
      const std::size_t one = after == 0 ? 0 : after - 1, other = std::min(after, count - 1);
      const double share = sampled[other] > sampled[one]
                               ? std::clamp((time - sampled[one]) / (sampled[other] - sampled[one]), 0.0, 1.0)
                               : 0.0;
      result.push_back((1 - share) * Eigen::Vector3d(&velocity[3 * one]) +
                       share * Eigen::Vector3d(&velocity[3 * other]));
    }
    return result;
  } catch (const InputError&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    throw InputError(fmt::format("results file {} is damaged: history of set '{}': {}", path_, set, error.what()));
  }
}

Eigen::Vector3d read_vector(const hdf5::Group& group, const std::string& name) {
  const std::vector<double> values = group.dataset(name).read<double>();
  if (values.size() != 3 || !std::all_of(values.begin(), values.end(), [](double x) { return std::isfinite(x); }))
    throw std::runtime_error(name + " is not three numbers");
  return Eigen::Vector3d(values.data());
}

}  // namespace railwave
