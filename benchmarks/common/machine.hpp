#pragma once

#include <string>
#include <utility>
#include <vector>

/// Where and how a benchmark ran: what every results file begins with.
namespace railwave::bench {

/// Name and value, e.g. {"back end", "OpenMP"}, {"device", "..."}. `arguments` is the command as given.
/// Kokkos must be initialised.
std::vector<std::pair<std::string, std::string>> describe_machine(int count, char** arguments);

/// The one-minute load average, as text; "unknown" where the system does not tell. Taken before and after, it says
/// whether others were using the machine.
std::string load_average();

/// Threads or, on a device, 0.
int host_threads();

}  // namespace railwave::bench
