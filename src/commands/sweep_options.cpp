#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <iostream>
#include <string>

#include "case/shared_files.hpp"
#include "commands/command_line.hpp"
#include "commands/process.hpp"

extern char** environ;

namespace railwave {

void add_sweep_command(CLI::App& app, sweep::SweepRequest& request, const std::function<void()>& run) {
  CLI::App* command =
      app.add_subcommand("sweep", "run a case with many sets of numbers, and make one table of what comes out");
  command->add_option("study", request.study, "study file (TOML); docs/sweep.md lists its keys")->required();
  command->add_option("--jobs", request.jobs,
                      "members side by side at most; default: one a processor, as far as memory goes");
  command->add_option("--threads", request.threads, "of each member; default: processors that are left over");
  command->add_option("--retries", request.retries,
                      "further attempts at a member that was killed; default: as the study says, else 2");
  command->add_option("--members", request.members, "only these, such as 3,17-20");
  command->add_option("--job", request.job, "I/N: only every N-th member, from the I-th on, as one job of an array");
  command->add_flag("--collect", request.collect, "run nothing: tables and pictures of what is there");
  command->add_option("--slurm", request.slurm, "submit it to Slurm as an array of so many jobs");
  command->add_flag("--snakemake", request.snakemake, "write a Snakefile for it");
  command->add_flag("--dry-run", request.dry_run, "run and write nothing: which members there are, and which are done");
  command->add_flag("!--no-pictures", request.pictures, "draw no pictures");
  command->callback(run);
}

void draw_sweep(const std::string& table) {
  std::string script = first_present(places_of("scripts/picture", RAILWAVE_PICTURE_SCRIPT));
  std::string option = "--sweep", file = table;
  char* const words[] = {script.data(), option.data(), file.data(), nullptr};
  std::cout.flush();
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  sigset_t none;
  sigemptyset(&none);
  posix_spawnattr_setsigmask(&attributes, &none);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGMASK);
  pid_t child = 0;
  const bool there = access(script.c_str(), X_OK) == 0;
  int status = there ? posix_spawn(&child, script.c_str(), nullptr, &attributes, words, environ) : ENOENT;
  posix_spawnattr_destroy(&attributes);
  const bool started = status == 0;
  while (started && waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (started && WIFEXITED(status) && WEXITSTATUS(status) == 0) return;
  std::cout << "note: no pictures were drawn; the tables are whole. "
            << (there ? "To draw them: " : "Where the scripts are: ") << script_command("picture") << " --sweep "
            << table << std::endl;
}

}  // namespace railwave
