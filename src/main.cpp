#include <CLI/CLI.hpp>

#include <algorithm>
#include <chrono>
#include <iostream>

#include "case/activity.hpp"
#include "case/error.hpp"
#include "case/read_case.hpp"
#include "case/reference.hpp"
#include "commands/check.hpp"
#include "commands/command_line.hpp"
#include "commands/ensemble.hpp"
#include "commands/follow.hpp"
#include "commands/import.hpp"
#include "commands/process.hpp"
#include "commands/standard_output.hpp"
#include "commands/threads.hpp"
#include "mesh/contact_zone.hpp"
#include "model/assembly.hpp"
#include "model/ranks/block_partition.hpp"
#include "modes/modes_command.hpp"
#include "output/checkpoint_file.hpp"
#include "output/paraview_files.hpp"
#include "output/progress.hpp"
#include "output/results_file.hpp"
#include "output/results_writer.hpp"
#include "output/run_places.hpp"
#include "output/settled_file.hpp"
#include "post/contact_command.hpp"
#include "solve/statics/settle.hpp"
#include "solve/time_loop.hpp"

namespace railwave {
namespace {

/// Exit codes, listed in docs/commands.md.
enum ExitCode { done = 0, failed = 1, wrong_input = 2, run_ended_early = 3, out_of_time = 4, interrupted = 130 };

struct Arguments {
  std::string case_file;
  std::vector<std::string> topic;
  std::vector<std::string> overrides;
  EnsembleRequest ensemble;
  ContactRequest contact;
  SignalRequest signal;
  ResponseRequest response;
  DecayRequest decay;
  ReportRequest report;
  ExportRequest exported;
  ModesRequest modes;
  ImportRequest import;
  sweep::SweepRequest sweep;
  std::optional<std::string> mesh_file;  ///< none: mesh.h5 in the case's own folder
  bool markdown = false, schema = false;
  bool restart = false, keep_state = false, overwrite = false;
  double wall_time = 0;  ///< s; 0: no limit
  int ranks = 1;         ///< that a check is to speak of, and a model's file to show
};

/// Reads the case, finds the contact bands of its meshes, and prints what there is to say at once: what follows may
/// take minutes.
scene::Scene read_and_warn(const Arguments& arguments) {
  std::vector<std::string> warnings;
  scene::Scene scene = read_case(arguments.case_file, arguments.overrides, &warnings);
  report("warning", warnings, std::cout);
  report("note", place_contact_zones(scene), std::cout);
  return scene;
}

/// A run of what was read, with the others where there are any.
/// @param began when the program did
int run_scene(const Arguments& arguments, const scene::Scene& scene, const RunFiles& files, OtherRanks& others,
              PatienceTimer& patience, std::chrono::steady_clock::time_point began) {
  const HeldPlaces places(scene, files);
  const KokkosScope kokkos;
  Model model;
  std::vector<std::string> notes;
  build_model(scene, assemble(scene, notes), model, others.transport());
  report("note", notes, std::cout);
  check_run_places(scene, files);  // again, now that meshes have read what they include
  ResultsFile results(model.scene, model.assembly, RAILWAVE_VERSION);
  results.check_disk_space(model, model);
  const CheckpointFile checkpoint(checkpoint_path(scene), checkpoint_key(model, RAILWAVE_VERSION));
  results.keep_checkpoints(checkpoint, arguments.keep_state);
  RunKeeping keeping;
  keeping.checkpoints = &results;
  keeping.at_end = arguments.keep_state;
  keeping.interval = scene.checkpoint.interval;
  Restart restart;
  if (arguments.restart) {
    restart = find_restart(scene.output.file, checkpoint, scene.time.end);
    for (const std::string& remark : restart.remarks) std::cout << "restart: " << remark << '\n';
    if (restart.complete) return done;
    results.go_on_from(*restart.state);
    keeping.from = &*restart.state;
  }
  Progress progress(std::cout);
  stop_on_signals();
  SettledFiles settled(RAILWAVE_VERSION);
  if (arguments.wall_time > 0)
    keeping.time_left = std::max(
        1e-9, arguments.wall_time - std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count());
  patience.stop();
  others.begin();
  keeping.transport = others.transport();
  const RunSummary summary = run(model, {&results, &progress}, &settled, keeping);
  report_next_steps(scene, summary.completed, std::cout);
  if (summary.completed) return done;
  if (summary.out_of_time) return out_of_time;
  return was_signalled() ? interrupted : run_ended_early;
}

int run_case(const Arguments& arguments) {
  if (rank_of_process() > 0) return follow_run(arguments.case_file, arguments.overrides);
  const auto began = std::chrono::steady_clock::now();
  PatienceTimer patience;
  const scene::Scene scene = read_and_warn(arguments);
  const RunFiles files{arguments.restart, arguments.overwrite};
  if (arguments.restart) {  // before anything is held that the child would let go
    check_run_places(scene, files);
    const std::string& file = scene.output.file;
    if (const auto code =
            after_reading_in_child("railwave run --restart", {file}, [&] { check_can_be_extended(file); }))
      return *code;
  }
  OtherRanks others(arguments.case_file, arguments.overrides);
  return others.end_together([&] { return run_scene(arguments, scene, files, others, patience, began); });
}

int run_members(const EnsembleRequest& request) {
  const EnsembleEnd end = run_ensemble(request, std::cout);
  if (was_signalled()) return interrupted;
  if (end.failed > 0) return failed;
  return end.ended_early > 0 ? run_ended_early : done;
}

int check_case(const Arguments& arguments) {
  const PatienceTimer patience;
  const scene::Scene scene = read_and_warn(arguments);
  check_run_places(scene, {});
  const KokkosScope kokkos;
  Model model;
  std::vector<std::string> notes;
  build_model(scene, assemble(scene, notes), model);
  report("note", notes, std::cout);
  refuse_moving_held_nodes(model, model.nodes.reference);
  ResultsFile results(model.scene, model.assembly, RAILWAVE_VERSION);  // checks the output section, writes nothing
  results.check_disk_space(model, model);
  describe_run(model, std::cout);
  if (arguments.ranks > 1) {
    std::cout << "On " << arguments.ranks << " ranks\n";
    for (const std::string& line : describe_ranks(model, partition_blocks(model, arguments.ranks)))
      std::cout << "  " << line << '\n';
    std::cout << "  railwave mesh " << arguments.case_file << " --ranks " << arguments.ranks
              << " writes which element is whose, for ParaView and scripts/picture --mesh\n";
  }
  report_what_gets_lost(scene, std::cout);
  return done;
}

int write_mesh(const Arguments& arguments) {
  const PatienceTimer patience;
  const scene::Scene scene = read_and_warn(arguments);
  const std::string path = arguments.mesh_file.value_or(default_results_folder(scene.path) + "/mesh.h5");
  check_model_places(scene, path, arguments.overwrite);
  const KokkosScope kokkos;
  Model model;
  std::vector<std::string> notes;
  build_model(scene, assemble(scene, notes), model);
  report("note", notes, std::cout);
  std::vector<int> ranks;
  if (arguments.ranks > 1) ranks = ranks_of_elements(model, partition_blocks(model, arguments.ranks));
  const Activity writing("writing " + path);
  make_own_folder(scene, path);
  write_model_file(model, model.absorbing, model.connectors.cells, path, ranks);
  std::cout << path << " and " << xdmf_path(path) << ": " << model.element_count() << " elements of "
            << model.assembly.parts.size() << " parts, " << model.connectors.cells.size() << " springs and dashpots";
  int beams = 0;
  for (const auto& chain : model.assembly.beam_chains) beams += static_cast<int>(chain.nodes.size()) - 1;
  if (beams > 0) std::cout << ", " << beams << " elements of beams";
  std::cout << '\n';
  return done;
}

int find_modes(const Arguments& arguments) {
  const PatienceTimer patience;
  const scene::Scene scene = read_and_warn(arguments);
  const KokkosScope kokkos;
  return modes_command(scene, arguments.modes, std::cout);
}

int print_reference(const Arguments& arguments) {
  if (arguments.schema)
    std::cout << case_schema_json();
  else
    std::cout << case_reference_markdown();
  return done;
}

void add_overwrite_option(CLI::App* command, bool& overwrite) {
  command->add_flag("--overwrite", overwrite,
                    "replace files that are there even if railwave has not written them; never what the command reads");
}

void add_contact_options(CLI::App* command, ContactRequest& request) {
  command->add_option("results", request.results, "results file")->required();
  command->add_option("--csv", request.csv,
                      "also write the table as CSV, in SI units: a row per output time and patch");
  command->add_option("--nodes", request.nodes,
                      "also write a CSV of the nodes of each patch: stresses, micro-slip, stick and slip");
  command->add_option("--cuts", request.cuts,
                      "also write a CSV of cuts along and across through the centre of each patch");
  command->add_option("--hdf5", request.hdf5,
                      "also write all of this, and the stresses of the facets, as HDF5: a file of its own");
  add_overwrite_option(command, request.overwrite);
  command
      ->add_option("--together", request.together,
                   "NAME,NAME: contacts that are one contact solution, with patches in common, such as those of a "
                   "wheel with the rails on both sides of a gap; may be repeated")
      ->allow_extra_args(false);
  command->add_option("--from", request.from, "leave out output times before, s");
  command->add_option("--to", request.to, "leave out output times after, s");
  command->add_option("--interval", request.interval, "leave out output times nearer to the one before, s");
  command
      ->add_option("--rolling-direction", request.rolling_direction,
                   "x,y,z, from which longitudinal is made; default 1,0,0")
      ->delimiter(',');
  command
      ->add_option("--ring", request.ring,
                   "inner,outer radius, in semi-axes of the patch, of the surface whose rigid motion gives the "
                   "creepage; default 1.5,3")
      ->delimiter(',');
  command->add_option("--axle", request.axle,
                      "history set that travels with the patch, e.g. wheel.bore, for the rolling velocity; default: "
                      "the patch's own travel");
  command->add_option("--rolling-velocity", request.rolling_velocity, "the rolling velocity instead, m/s");
}

void add_modes_options(CLI::App* command, ModesRequest& request) {
  command
      ->add_option("--part", request.parts,
                   "a part or point mass to take with what joins them; may be repeated; default: all")
      ->allow_extra_args(false);
  command->add_option("--up-to", request.up_to, "highest frequency, Hz; default 5000");
  command->add_option("--csv", request.csv, "also write the table as CSV, in SI units");
  command->add_option("--out", request.shapes,
                      "also write the shapes as HDF5; its XDMF companion, which ParaView opens, lies beside it");
  add_overwrite_option(command, request.overwrite);
}

int dispatch(int argc, char** argv) {
  CLI::App app{"Railwave: explicit finite elements for the dynamic interaction of wheel and rail"};
  app.set_version_flag("--version", std::string("railwave ") + RAILWAVE_VERSION);
  app.require_subcommand(1);
  Arguments arguments;
  int code = done;

  const auto add_case = [&](CLI::App* command) {
    command->add_option("case", arguments.case_file, "case file (TOML); docs/case-file.md lists its keys")->required();
    command
        ->add_option("--set", arguments.overrides,
                     "section.key=value in place of what the case file says; may be repeated")
        ->allow_extra_args(false);
  };
  CLI::App* run_command = app.add_subcommand("run", "run a case and write its results");
  add_case(run_command);
  CLI::Option* restart = run_command->add_flag(
      "--restart", arguments.restart, "go on from the last checkpoint of this case's run, adding to its results");
  add_overwrite_option(run_command, arguments.overwrite);
  run_command->get_option("--overwrite")->excludes(restart);
  run_command->add_flag("--keep-state", arguments.keep_state,
                        "keep the checkpoint at the run's end: --restart with a later time.end goes on from it");
  run_command->add_option("--wall-time", arguments.wall_time,
                          "s; when so long has passed, write a checkpoint, close everything and end with exit code 4");
  run_command->callback([&] { code = run_case(arguments); });
  add_ensemble_command(app, arguments.ensemble, [&] { code = run_members(arguments.ensemble); });
  CLI::App* check_command = app.add_subcommand("check", "check a case and describe its run");
  add_case(check_command);
  check_command->add_option("--ranks", arguments.ranks,
                            "also say how the case would be dealt out to so many processes of a run by mpirun");
  check_command->callback([&] { code = check_case(arguments); });
  CLI::App* mesh =
      app.add_subcommand("mesh", "write a case's model for ParaView: parts, sets, stable steps, connectors");
  add_case(mesh);
  mesh->add_option("--out", arguments.mesh_file,
                   "HDF5 file to write; its XDMF companion, which ParaView opens, lies beside it; default "
                   "results/NAME/mesh.h5, NAME being the case file's");
  mesh->add_option("--ranks", arguments.ranks,
                   "also write which of so many processes of a run by mpirun would compute each element");
  add_overwrite_option(mesh, arguments.overwrite);
  mesh->callback([&] { code = write_mesh(arguments); });
  add_import_command(app, arguments.import, [&] { import_command(arguments.import, std::cout); });
  CLI::App* modes = app.add_subcommand("modes", "frequencies and shapes of a case's free vibrations");
  add_case(modes);
  add_modes_options(modes, arguments.modes);
  modes->callback([&] { code = find_modes(arguments); });
  CLI::App* contact = app.add_subcommand("contact", "contact patch, pressure and forces from a results file");
  add_contact_options(contact, arguments.contact);
  contact->callback([&] {
    code = in_reading_child("railwave contact", {arguments.contact.results},
                            [&] { return contact_command(arguments.contact, std::cout); });
  });
  add_signal_command(app, arguments.signal, [&] {
    code = in_reading_child("railwave signal", {arguments.signal.results},
                            [&] { return signal_command(arguments.signal, std::cout); });
  });
  add_response_command(app, arguments.response, [&] {
    code = in_reading_child("railwave frf", arguments.response.results,
                            [&] { return response_command(arguments.response, std::cout); });
  });
  add_decay_command(app, arguments.decay, [&] {
    code = in_reading_child("railwave decay", arguments.decay.results,
                            [&] { return decay_command(arguments.decay, std::cout); });
  });
  add_report_command(app, arguments.report, [&] {
    code = in_reading_child("railwave report", arguments.report.results, [&] {
      return report_command(arguments.report, std::string("railwave ") + RAILWAVE_VERSION, std::cout);
    });
  });
  add_export_command(app, arguments.exported, [&] {
    code = in_reading_child("railwave export", {arguments.exported.results},
                            [&] { return export_command(arguments.exported, std::cout); });
  });
  add_sweep_command(app, arguments.sweep, [&] {
    stop_on_signals();
    hide_ranks();  // of which its runs are none
    code = sweep::sweep_command(arguments.sweep, was_signalled, draw_sweep, std::cout);
  });
  CLI::App* help = app.add_subcommand("help", "what a section or key of the case file means, or a command");
  help->add_option("topic", arguments.topic,
                   "parts, parts.hourglass, hourglass, run, signal psd ...; nothing: the list of sections");
  help->callback([&] { std::cout << help_on(app, arguments.topic) << '\n'; });
  CLI::App* reference = app.add_subcommand("reference", "the case file's reference page or JSON schema");
  reference->add_flag("--markdown", arguments.markdown, "the page (default)");
  reference->add_flag("--schema", arguments.schema, "the schema");
  reference->callback([&] { code = print_reference(arguments); });

  // Of processes that mpirun has started together the others have a part in runs and ensembles alone.
  const std::string command = argc < 2 ? "" : argv[1];
  if (rank_of_process() > 0 && command != "run" && command != "ensemble") return done;
  add_option_checks(app);
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& wish) {  // --help, --version
    app.exit(wish);
    return done;
  } catch (const CLI::ParseError& error) {
    throw InputError(usage_error(app, error, std::vector<std::string>(argv + 1, argv + argc)));
  }
  return code;
}

int work(int argc, char** argv) {
  const NoSuddenExit no_sudden_exit;
  try {
    return dispatch(argc, argv);
  } catch (const MemoryShortage& error) {
    std::cerr << "railwave: " << rank_for_messages() << error.what() << '\n';
    return wrong_input;
  } catch (const InputError& error) {
    std::cerr << "railwave: " << error.what() << '\n';
    return wrong_input;
  } catch (const std::exception& error) {
    const bool no_memory = is_out_of_memory(error);
    std::cerr << "railwave: " << (no_memory ? rank_for_messages() + out_of_memory(error) : error.what()) << '\n';
    return failed;
  }
}

}  // namespace
}  // namespace railwave

int main(int argc, char** argv) {
  railwave::keep_standard_descriptors();
  railwave::end_on_signals();
  // One thread stays on one core; Kokkos warns when nobody says.
  setenv("OMP_PROC_BIND", "false", 0);
  return railwave::with_enough_stack([&] {
    railwave::steady_memory();
    railwave::StandardOutput standard_output;
    return standard_output.end(railwave::work(argc, argv));
  });
}
