#pragma once

#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "case/document.hpp"
#include "sweep/figure.hpp"

/// A study: one case, run with many sets of numbers, and a table of what came out.
namespace railwave::sweep {

/// Exit codes of the program, docs/commands.md.
enum ExitCode { done = 0, failed = 1, wrong_input = 2, broken_down = 3, interrupted = 130 };

/// A key of the case that differs between members.
struct Parameter {
  std::string key;   ///< as --set takes it: contacts.tread.friction, parts.wheel.position[1]
  std::string unit;  ///< "1" of a mere number
};

/// One run of the study.
struct Member {
  int number = 0;                       ///< from 1, in the order of the study
  std::vector<std::string> overrides;   ///< key=value, as --set takes them
  std::vector<case_file::Node> values;  ///< of the study's parameters; a text without letters where nobody says one
  std::string called;                   ///< "friction=0.3, position[1]=0.01"
  std::string folder;                   ///< its own, below the study's
  std::vector<std::string> files;       ///< that its case names
  std::string hash;                     ///< of all that its results depend on, see MemberHash
  double memory = 0;                    ///< bytes that a run of it takes, estimated
  bool settles = false;
};

struct SlurmChoice {
  int cpus_per_job = 1;
  std::vector<std::string> options;  ///< of sbatch, such as --time=2:00:00
};

struct Study {
  std::string path, title;
  std::string case_file;
  std::string folder;  ///< of all that the sweep writes
  std::vector<Parameter> parameters;
  std::vector<Member> members;
  FigureChoice figures;
  int retries = 2;           ///< further attempts at a member that was killed
  bool keep_results = true;  ///< results files of members whose row is there
  SlurmChoice slurm;

  std::string table_csv() const { return folder + "/sweep.csv"; }
  std::string table_hdf5() const { return folder + "/sweep.h5"; }
};

/// Reads a study file (TOML; docs/sweep.md lists its keys), and the case once for each member. Throws InputError with
/// every mistake of the study, or the first member whose case has mistakes.
Study read_study(const std::string& path);

/// The members that `words` name: "3,17-20". Throws InputError for what is not there.
std::vector<const Member*> chosen_members(const Study& study, const std::string& words);

/// Every `count`-th member, from the `index`-th on (from 1): a job's share, so that neighbours, which take alike long,
/// are of different jobs. Throws InputError unless 1 <= index <= count.
std::vector<const Member*> share_of_job(const Study& study, int index, int count);

/// Throws InputError where a sweep of the study must not write its tables: something else has their names, or another
/// study's table is there. Changes no file.
void check_tables(const Study& study);

/// Writes sweep.csv and sweep.h5 of a study: a row for each member, whether it has ended or not, with its parameters,
/// how it ended, and its figures. The rows are read from the members' folders, so it does not matter which process,
/// machine or scheduler ran them. Throws InputError or std::runtime_error where they cannot be written.
void write_tables(const Study& study);

}  // namespace railwave::sweep
