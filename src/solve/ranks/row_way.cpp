#include <fmt/format.h>

#include <cstdlib>
#include <map>
#include <string>

#include "case/error.hpp"
#include "solve/ranks/row_exchange.hpp"

namespace railwave {
namespace {

constexpr int unknown = -1;

std::string text_of_user() {
  const char* const text = std::getenv("RAILWAVE_RANK_MESSAGES");
  return text == nullptr ? std::string() : text;
}

int way_of(const std::string& text) {
  static const std::map<std::string, RowWay> ways = {{"", RowWay::automatic},    {"auto", RowWay::automatic},
                                                     {"direct", RowWay::direct}, {"nccl", RowWay::nccl},
                                                     {"mpi", RowWay::mpi},       {"host", RowWay::host}};
  const auto found = ways.find(text);
  return found == ways.end() ? unknown : static_cast<int>(found->second);
}

bool has(const Transport& transport, RowWay way) {
  if (way == RowWay::direct) return has_direct_messages;
  if (way == RowWay::nccl) return has_nccl_messages;
  return way != RowWay::mpi || transport.takes_device_memory();
}

std::string why_not(RowWay way) {
  if (way == RowWay::direct) return "program was built for no GPU of NVIDIA's";
  if (way == RowWay::nccl) return "program was built without NCCL, or for no GPU of NVIDIA's";
  return "MPI does not say that it takes the GPU's memory; one that was built for that does (Open MPI: "
         "--with-cuda or --with-rocm)";
}

}  // namespace

RowWay wanted_row_way(Transport& transport) {
  int way = transport.rank() == 0 ? way_of(text_of_user()) : unknown;
  transport.broadcast(&way, sizeof way);
  if (way == unknown)
    throw InputError(fmt::format(
        "the environment variable RAILWAVE_RANK_MESSAGES is '{}': auto, direct, nccl, mpi or host is wanted; unset it "
        "for auto",
        text_of_user()));
  const RowWay wanted = static_cast<RowWay>(way);
  const int without = transport.first_to_refuse(has(transport, wanted));
  if (without >= 0)
    throw InputError(
        fmt::format("the environment variable RAILWAVE_RANK_MESSAGES is '{}', which rank {} does not have: its {}. "
                    "Unset it, and rows go the best way that there is",
                    text_of_user(), without, why_not(wanted)));
  return wanted;
}

const char* description(RowWay way) {
  switch (way) {
    case RowWay::direct:
      return "from GPU to GPU";
    case RowWay::nccl:
      return "from GPU to GPU by NCCL";
    case RowWay::mpi:
      return "by MPI from the device's memory";
    case RowWay::host:
      return "through the host";
    case RowWay::automatic:
      break;
  }
  return "the best way that there is";
}

}  // namespace railwave
