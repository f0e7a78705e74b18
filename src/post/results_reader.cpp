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
const std::vector<std::string> side_arrays = {"area",   "position",     "velocity",
                                              "normal", "normal_force", "tangential_force"};
const std::vector<std::string> slave_arrays = {"gap", "slip_velocity", "slipping"};

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

ContactSide read_side(const hdf5::Group& group, std::size_t index) {
  ContactSide side;
  side.nodes = group.dataset("nodes").read<int>();
  const std::vector<int> corners = group.dataset("facets").read<int>();
  if (corners.size() % 4 != 0) throw std::runtime_error("a facet has no four corners");
  side.facets.resize(corners.size() / 4);
  for (std::size_t i = 0; i < corners.size(); ++i) {
    if (corners[i] < 0 || corners[i] >= static_cast<int>(side.nodes.size()))
      throw std::runtime_error("a facet has a corner that is no node");
    side.facets[i / 4][i % 4] = corners[i];
  }
  side.area = group.dataset("area").read_row<double>(index);
  side.position = group.dataset("position").read_row<double>(index);
  side.velocity = group.dataset("velocity").read_row<double>(index);
  side.normal = group.dataset("normal").read_row<double>(index);
  side.normal_force = group.dataset("normal_force").read_row<double>(index);
  side.tangential_force = group.dataset("tangential_force").read_row<double>(index);
  const std::size_t count = side.nodes.size();
  if (side.area.size() != count) throw std::runtime_error("an array has another length than the nodes");
  for (const auto* vectors : {&side.position, &side.velocity, &side.normal, &side.normal_force, &side.tangential_force})
    if (vectors->size() != 3 * count) throw std::runtime_error("an array has another length than the nodes");
  return side;
}

/// The values of some entries, of which each has so many.
template <class Value>
std::vector<Value> picked(const std::vector<Value>& all, const std::vector<std::size_t>& entries,
                          std::size_t components) {
  std::vector<Value> result;
  result.reserve(components * entries.size());
  for (const std::size_t entry : entries)
    result.insert(result.end(), all.begin() + static_cast<long>(components * entry),
                  all.begin() + static_cast<long>(components * (entry + 1)));
  return result;
}

/// Positions of the nodes of a side that have values: all, but where the case has output.contact_margin.
std::vector<std::size_t> nodes_with_values(const ContactSide& side) {
  std::vector<std::size_t> nodes;
  for (std::size_t i = 0; i < side.nodes.size(); ++i)
    if (!std::isnan(side.area[i])) nodes.push_back(i);
  return nodes;
}

/// Leaves out the other nodes, and the facets that have one of them.
void keep_nodes(ContactSide& side, const std::vector<std::size_t>& kept) {
  std::vector<int> place(side.nodes.size(), -1);
  for (std::size_t k = 0; k < kept.size(); ++k) place[kept[k]] = static_cast<int>(k);
  std::vector<std::array<int, 4>> facets;
  for (std::array<int, 4> facet : side.facets) {
    for (int& corner : facet) corner = place[corner];
    if (std::find(facet.begin(), facet.end(), -1) == facet.end()) facets.push_back(facet);
  }
  side.facets = std::move(facets);
  side.nodes = picked(side.nodes, kept, 1);
  side.area = picked(side.area, kept, 1);
  for (auto* vectors : {&side.position, &side.velocity, &side.normal, &side.normal_force, &side.tangential_force})
    *vectors = picked(*vectors, kept, 3);
}

void leave_out_nodes_without_values(ContactState& state) {
  const auto slave = nodes_with_values(state.slave), master = nodes_with_values(state.master);
  if (master.size() < state.master.nodes.size()) keep_nodes(state.master, master);
  if (slave.size() == state.slave.nodes.size()) return;
  keep_nodes(state.slave, slave);
  state.gap = picked(state.gap, slave, 1);
  state.slip_velocity = picked(state.slip_velocity, slave, 3);
  state.slipping = picked(state.slipping, slave, 1);
  if (!state.friction_now.empty()) state.friction_now = picked(state.friction_now, slave, 1);
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

std::vector<double> ResultsReader::contact_times(const std::string& contact) const {
  const std::vector<std::string> known = contacts();
  if (std::find(known.begin(), known.end(), contact) == known.end())
    throw InputError(
        fmt::format("results file {} has no contact '{}'; {}", path_, contact, suggestion(contact, known)));
  try {
    const hdf5::Group group = file_.root().group("contact").group(contact);
    std::vector<double> times = group.dataset("time").read<double>();
    // A kill in the middle of a flush may leave the arrays with different lengths.
    std::size_t complete = times.size();
    for (const char* side : {"slave", "master"})
      for (const std::string& name : side_arrays)
        complete = std::min<std::size_t>(complete, group.group(side).dataset(name).shape().at(0));
    for (const std::string& name : slave_arrays)
      complete = std::min<std::size_t>(complete, group.group("slave").dataset(name).shape().at(0));
    if (group.group("slave").has("friction"))
      complete = std::min<std::size_t>(complete, group.group("slave").dataset("friction").shape().at(0));
    times.resize(complete);
    return times;
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    throw InputError(fmt::format("results file {} is damaged: {}", path_, error.what()));
  }
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

ContactState ResultsReader::contact_state(const std::string& contact, std::size_t index) const {
  try {
    const hdf5::Group group = file_.root().group("contact").group(contact);
    ContactState state;
    state.name = contact;
    state.friction = group.number_attribute("friction");
    const hdf5::Group slave = group.group("slave");
    state.slave = read_side(slave, index);
    state.master = read_side(group.group("master"), index);
    state.gap = slave.dataset("gap").read_row<double>(index);
    state.slip_velocity = slave.dataset("slip_velocity").read_row<double>(index);
    const auto slipping = slave.dataset("slipping").read_row<signed char>(index);
    state.slipping.assign(slipping.begin(), slipping.end());
    if (slave.has("friction")) state.friction_now = slave.dataset("friction").read_row<double>(index);
    const std::size_t count = state.slave.nodes.size();
    if (state.gap.size() != count || state.slip_velocity.size() != 3 * count || state.slipping.size() != count ||
        (!state.friction_now.empty() && state.friction_now.size() != count))
      throw std::runtime_error("an array has another length than the nodes");
    leave_out_nodes_without_values(state);
    return state;
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    throw InputError(fmt::format("results file {} is damaged: contact '{}', output time {}: {}", path_, contact, index,
                                 error.what()));
  }
}

Eigen::Vector3d read_vector(const hdf5::Group& group, const std::string& name) {
  const std::vector<double> values = group.dataset(name).read<double>();
  if (values.size() != 3 || !std::all_of(values.begin(), values.end(), [](double x) { return std::isfinite(x); }))
    throw std::runtime_error(name + " is not three numbers");
  return Eigen::Vector3d(values.data());
}

}  // namespace railwave
