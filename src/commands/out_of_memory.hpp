#pragma once

#include <exception>
#include <string>

namespace railwave {

/// Whether an exception says that memory was refused, on the host or the device.
bool is_out_of_memory(const std::exception& error);

/// For people: how much was wanted, how much there is, what to do.
std::string out_of_memory(const std::exception& error);

}  // namespace railwave
