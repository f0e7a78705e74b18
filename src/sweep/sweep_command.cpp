#include "sweep/sweep_command.hpp"

#include <algorithm>
#include <ostream>

#include <fmt/format.h>

#include "case/error.hpp"
#include "case/memory.hpp"
#include "case/number_text.hpp"
#include "case/read_case.hpp"
#include "sweep/member_row.hpp"
#include "sweep/run_members.hpp"
#include "sweep/study.hpp"

namespace railwave::sweep {
namespace {

std::vector<const Member*> wanted_members(const Study& study, const SweepRequest& request) {
  if (request.members && request.job)
    throw InputError("--members and --job exclude each other: both say which members are run; give one of them");
  if (request.members) return chosen_members(study, *request.members);
  if (request.job) {
    const auto slash = request.job->find('/');
    const auto index = parse_integer(request.job->substr(0, slash));
    const auto count = slash == std::string::npos ? std::nullopt : parse_integer(request.job->substr(slash + 1));
    constexpr int most = 1000000;
    if (!index || !count || *index > most || *count > most || *index < 1 || *count < 1)
      throw InputError("--job " + *request.job + ": must be which of how many jobs, such as 2/8");
    return share_of_job(study, static_cast<int>(*index), static_cast<int>(*count));
  }
  std::vector<const Member*> all;
  for (const Member& member : study.members) all.push_back(&member);
  return all;
}

/// Throws InputError for histories that the runs will not write. One of the members that are still to be run stands for
/// all: their meshes have sets of the same names.
void expect_histories(const Study& study, const std::vector<const Member*>& members) {
  const auto next =
      std::find_if(members.begin(), members.end(), [&](const Member* one) { return !is_done(study, *one); });
  if (next == members.end()) return;
  case_file::Complaints complaints(study.path);
  check_histories(study.figures, read_case(study.case_file, (*next)->overrides), complaints);
  complaints.throw_if_any();
}

void describe(const Study& study, const std::vector<const Member*>& members, std::ostream& out) {
  double memory = 0;
  for (const Member* member : members) {
    const auto row = read_row(*member);
    out << fmt::format("member {}: {}: {}\n", member->number, member->called,
                       is_done(study, *member) ? status_names[static_cast<int>(row->status)] : "to be run");
    memory = std::max(memory, member->memory);
  }
  out << fmt::format("{} members of {}, {} figures, in {}; a member takes about {} of memory at most\n", members.size(),
                     study.case_file, study.figures.figures.size(), study.folder, bytes_text(memory));
}

int report(const Study& study, const Tally& tally, std::ostream& out) {
  out << fmt::format("{} completed, {} broke down, {} refused, {} unfinished\n", tally.completed, tally.broke_down,
                     tally.refused, tally.unfinished);
  if (tally.unfinished > 0)
    out << fmt::format(
        "railwave sweep {} goes on with what is unfinished; why it is: the table's column 'reason', and "
        "log.txt in each member's folder\n",
        study.path);
  if (tally.stopped) return interrupted;
  if (tally.unfinished > 0) return failed;
  return tally.broke_down + tally.refused > 0 ? broken_down : done;
}

}  // namespace

int sweep_command(const SweepRequest& request, const std::function<bool()>& stopped,
                  const std::function<void(const std::string& table)>& pictures, std::ostream& out) {
  const Study study = read_study(request.study);
  if (request.slurm && (request.snakemake || request.members || request.job || request.collect))
    throw InputError("--slurm hands the whole study over: leave out --snakemake, --members, --job and --collect");
  if (request.collect && (request.members || request.job))
    throw InputError("--collect writes the table of the whole study and runs nothing: leave out --members and --job");
  const std::vector<const Member*> members = wanted_members(study, request);
  if (!request.collect) expect_histories(study, members);
  if (!request.dry_run) check_tables(study);
  if (request.slurm) return hand_over_to_slurm(study, *request.slurm, request.dry_run, out);
  if (request.snakemake) return hand_over_to_snakemake(study, request.dry_run, out);
  if (request.dry_run) {
    describe(study, members, out);
    return done;
  }
  RunOptions options;
  options.jobs = request.jobs;
  options.threads = request.threads;
  options.retries = request.retries.value_or(study.retries);
  options.stopped = stopped;
  const bool all = members.size() == study.members.size();
  const Tally tally = request.collect ? tally_of(study, members) : run_members(study, members, options, out);
  if (all) {
    write_tables(study);
    out << fmt::format("{} and {}: {} members, {} figures\n", study.table_csv(), study.table_hdf5(),
                       study.members.size(), study.figures.figures.size());
    if (request.pictures && !tally.stopped) pictures(study.table_hdf5());
  }
  const int code = report(study, tally, out);
  return request.collect && code == broken_down ? done : code;  // the table is as it should be
}

}  // namespace railwave::sweep
