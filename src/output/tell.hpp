#pragma once

#include <cstdio>
#include <string>

namespace railwave {

/// Tells what can't wait for the run's summary, from whichever thread.
inline void tell_at_once(const std::string& what) { std::fputs(("railwave: warning: " + what + "\n").c_str(), stderr); }

}  // namespace railwave
