#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <ostream>

#include <fmt/format.h>

#include "case/error.hpp"
#include "output/atomic_file.hpp"
#include "output/hash.hpp"
#include "sweep/member_row.hpp"
#include "sweep/sweep_command.hpp"

/// A study that others run: Slurm as an array of jobs, Snakemake by a rule for each member. Both call `railwave sweep`
/// again, each for its share; the rows in the study's folder are what they have in common.
namespace railwave::sweep {
namespace {

namespace fs = std::filesystem;

constexpr const char* script_mark = "# Railwave sweep:";

FileKind script_kind() { return {FileKind::Form::text, "a script of a sweep", script_mark, ""}; }

/// As a shell takes it for one word.
std::string shell_word(const std::string& text) {
  std::string quoted = "'";
  for (const char c : text) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + '\'';
}

std::string python_text(const std::string& text) {
  std::string quoted = "\"";
  for (const char c : text) quoted += (c == '"' || c == '\\' ? std::string("\\") : "") + c;
  return quoted + '"';
}

struct Calls {
  std::string program, study, here, folder;  ///< absolute
  std::string sweep() const { return shell_word(program) + " sweep " + shell_word(study); }
};

Calls calls_of(const Study& study) {
  const std::string folder = fs::absolute(study.folder).lexically_normal().string();
  for (const std::string& path : {folder, fs::absolute(study.path).string()})
    if (path.find_first_of("\n\"{}") != std::string::npos)
      throw InputError(path +
                       ": names with quotes, braces or ends of lines do not fit into a script; name it otherwise");
  return {fs::read_symlink("/proc/self/exe").string(), fs::canonical(study.path).string(), fs::current_path().string(),
          folder};
}

std::string slurm_heading(const Study& study, const Calls& calls, const std::string& name, const std::string& output) {
  std::string text = fmt::format("#!/bin/bash\n{} {} of {}\n", script_mark, name, calls.study);
  text += fmt::format("#SBATCH --job-name=\"{}-{}\"\n#SBATCH --output=\"{}/{}\"\n",
                      fs::path(study.path).stem().string(), name, calls.folder, output);
  for (const std::string& option : study.slurm.options) text += "#SBATCH " + option + '\n';
  return text;
}

/// The shell makes way for the program, so that Slurm's signals reach it: it stops its runs, which write checkpoints.
std::string array_script(const Study& study, const Calls& calls, int jobs) {
  return slurm_heading(study, calls, "members", "slurm-%A_%a.txt") +
         fmt::format(
             "#SBATCH --array=1-{}\n#SBATCH --ntasks=1\n#SBATCH --cpus-per-task={}\n"
             "#SBATCH --signal=B:TERM@60\n"
             "cd {} || exit 1\nexec {} --job \"$SLURM_ARRAY_TASK_ID/{}\" --jobs {} --threads 1 --no-pictures\n",
             jobs, study.slurm.cpus_per_job, shell_word(calls.here), calls.sweep(), jobs, study.slurm.cpus_per_job);
}

std::string collecting_script(const Study& study, const Calls& calls) {
  return slurm_heading(study, calls, "table", "slurm-%j.txt") +
         fmt::format("#SBATCH --ntasks=1\ncd {} || exit 1\nexec {} --collect\n", shell_word(calls.here), calls.sweep());
}

std::string snakefile(const Study& study, const Calls& calls) {
  std::string text = fmt::format("{} a rule for each member of {}\n#   snakemake --snakefile {} --cores 2\n",
                                 script_mark, calls.study, shell_word(calls.folder + "/Snakefile"));
  text += "NUMBERS = {\n";
  double memory = 0;
  for (const Member& member : study.members) {
    text += fmt::format("    {}: {},\n", python_text(fs::path(member.folder).filename().string()), member.number);
    memory = std::max(memory, member.memory);
  }
  Hash figures;
  figures.add(study.figures.key());
  constexpr double megabyte = 1e6;
  text += fmt::format(
      R"(}}

workdir: {folder}


rule table:
    input:
        expand("members/{{name}}/row.toml", name=NUMBERS),
    output:
        "sweep.csv",
        "sweep.h5",
    shell:
        {collect}


rule member:
    output:
        "members/{{name}}/row.toml",
    params:
        number=lambda wildcards: NUMBERS[wildcards.name],
        figures={figures},  # a rule runs again when others are asked for
    threads: 1
    resources:
        mem_mb={memory:.0f},
    shell:
        # 3: it broke down, which its row says
        {member}
)",
      fmt::arg("folder", python_text(calls.folder)), fmt::arg("figures", python_text(figures.text())),
      fmt::arg("memory", memory / megabyte),
      fmt::arg("collect", python_text("cd " + shell_word(calls.here) + " && " + calls.sweep() + " --collect")),
      fmt::arg("member", python_text("cd " + shell_word(calls.here) + " && (" + calls.sweep() +
                                     " --members {params.number} --jobs 1 --threads {threads} || [ $? "
                                     "-eq 3 ])")));
  return text;
}

/// What sbatch says: the job's number. Throws std::runtime_error if there is no sbatch, or if it refuses.
std::string submitted(const std::string& arguments) {
  const std::string command = "sbatch --parsable " + arguments;
  std::fflush(nullptr);
  FILE* const pipe = popen(command.c_str(), "r");
  if (!pipe) throw std::runtime_error("sbatch cannot be started");
  std::string said;
  std::array<char, 256> piece{};
  while (std::fgets(piece.data(), piece.size(), pipe)) said += piece.data();
  if (pclose(pipe) != 0)
    throw std::runtime_error(fmt::format("'{}' failed; the script is written and can be submitted again", command));
  return said.substr(0, said.find_first_of(";\n"));
}

}  // namespace

int hand_over_to_slurm(const Study& study, int jobs, bool dry_run, std::ostream& out) {
  const Calls calls = calls_of(study);
  const int count = std::min(jobs, static_cast<int>(study.members.size()));
  const std::string array = array_script(study, calls, count), table = collecting_script(study, calls);
  if (dry_run) {
    out << array << '\n' << table;
    return done;
  }
  fs::create_directories(calls.folder);
  const std::string array_path = calls.folder + "/members.sbatch", table_path = calls.folder + "/table.sbatch";
  write_whole_file(array_path, array, script_kind());
  write_whole_file(table_path, table, script_kind());
  const std::string job = submitted(shell_word(array_path));
  const std::string last = submitted("--dependency=afterany:" + job + ' ' + shell_word(table_path));
  out << fmt::format("job {}: an array of {} jobs for {} members; job {} writes {} after them\n", job, count,
                     study.members.size(), last, study.table_csv());
  return done;
}

int hand_over_to_snakemake(const Study& study, bool dry_run, std::ostream& out) {
  const Calls calls = calls_of(study);
  const std::string text = snakefile(study, calls), path = calls.folder + "/Snakefile";
  if (dry_run) {
    out << text;
    return done;
  }
  fs::create_directories(calls.folder);
  write_whole_file(path, text, script_kind());
  out << fmt::format("{}: {} members; run it by\n  snakemake --snakefile {} --cores 2\n", path, study.members.size(),
                     shell_word(path));
  return done;
}

}  // namespace railwave::sweep
