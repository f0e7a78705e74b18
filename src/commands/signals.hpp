#pragma once

#include <sys/types.h>

/// SIGINT, SIGTERM, SIGHUP, SIGXCPU, SIGUSR1 and SIGUSR2 (schedulers send these before a job's time is up) end the
/// program in good order. Those that whoever started it has it ignore stay ignored (nohup, jobs in a shell's
/// background). SIGPIPE and SIGXFSZ are ignored: what is written then is refused with EPIPE and EFBIG.
namespace railwave {

/// From now on such a signal takes away what was half written, says so and ends the program with exit code 130.
void end_on_signals();

/// From now on it is a wish to stop (request_stop()), which the run's loop looks at.
void stop_on_signals();

/// From now on such a signal is passed on to a child, which ends in good order itself; this process waits for it. 0: no
/// longer.
void pass_signals_to(pid_t child);

/// Whether there was such a wish.
bool was_signalled();

}  // namespace railwave
