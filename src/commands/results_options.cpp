// Options of the commands that read results files as wholes: frf, decay, report and export.
#include "commands/command_line.hpp"

namespace railwave {

void add_response_command(CLI::App& app, ResponseRequest& request, const std::function<void()>& run) {
  CLI::App* command = app.add_subcommand("frf", "frequency responses of a hammer test from results files");
  command->add_option("results", request.results, "results files; several are blows whose responses are averaged")
      ->required();
  command->add_option("--input", request.input, "hammer, or load, that is the input; default: the only one");
  command
      ->add_option("--response", request.responses,
                   "SET[:DIRECTION] of an answer: a history set, probe or row of probes; vertical, lateral, x, -z, "
                   "1,0,0.05 ...; may be repeated; default: all, along the force")
      ->allow_extra_args(false);
  command->add_option("--quantity", request.quantity, "accelerance (default), mobility or receptance");
  command->add_option("--window", request.window, "none (default) or exponential");
  command->add_option("--window-end", request.window_end, "value of the exponential window at its end; default 0.05");
  command->add_option("--resolution", request.resolution, "largest distance of two lines, Hz; default 1");
  command->add_option("--prominence", request.prominence,
                      "least prominence of peaks and troughs in the report, dB; default 3");
  command->add_option("--from", request.from, "Hz; default 20");
  command->add_option("--to", request.to, "Hz; default: where the force's spectrum is 20 dB down");
  command->add_option("--csv", request.csv, "also write all lines as CSV");
  command->add_option("--hdf5", request.hdf5, "also write them as HDF5: a file of its own");
  command->add_flag("--overwrite", request.overwrite,
                    "replace files that are there even if railwave has not written them; never the results");
  command->callback(run);
}

void add_decay_command(CLI::App& app, DecayRequest& request, const std::function<void()>& run) {
  CLI::App* command = app.add_subcommand("decay", "track decay rate by EN 15461 from a row of probes in a hammer test");
  command->add_option("results", request.results, "results files; several are blows whose responses are averaged")
      ->required();
  command->add_option("--input", request.input, "hammer that strikes beside the row; default: the only one");
  command
      ->add_option("--row", request.rows,
                   "row of probes, or set; may be repeated; default: all probes on the struck part")
      ->allow_extra_args(false);
  command->add_option("--at", request.at,
                      "set beside the force whose motion is taken for that at the force, as of an accelerometer beside "
                      "a hammer; default: the struck set");
  command->add_option("--direction", request.direction, "of the motion, as of frf; default: that of the force");
  command->add_option("--from", request.from, "Hz; default 100");
  command->add_option("--to", request.to, "Hz; default 5000");
  command->add_option("--resolution", request.resolution, "largest distance of two lines, Hz; default 1");
  command->add_option("--window", request.window, "none (default) or exponential");
  command->add_option("--window-end", request.window_end, "value of the exponential window at its end; default 0.05");
  command->add_option("--csv", request.csv, "also write the rates, and the levels along the row, as CSV");
  command->add_option("--hdf5", request.hdf5, "also write them as HDF5: a file of its own");
  command->add_flag("--overwrite", request.overwrite,
                    "replace files that are there even if railwave has not written them; never the results");
  command->callback(run);
}

void add_report_command(CLI::App& app, ReportRequest& request, const std::function<void()>& run) {
  CLI::App* command = app.add_subcommand(
      "report", "one HTML file of results, for any browser: summary, histories, contact patches, bodies in 3D, tables");
  command->add_option("results", request.results, "results files; several are shown side by side")->required();
  command->add_option("--out", request.out,
                      "HTML file to write; default: RESULTS with the ending .html, of several report.html beside the "
                      "first");
  command->add_option("--instants", request.instants,
                      "contact patches and fields at no more than so many of the output times, evenly chosen; default "
                      "60");
  command->add_option("--size", request.size,
                      "MB that the page is to have at most: fewer instants and samples where it would have more; "
                      "default 14");
  command->add_flag("--overwrite", request.overwrite,
                    "replace a file that is there even if railwave has not written it; never the results");
  command->callback(run);
}

void add_export_command(CLI::App& app, ExportRequest& request, const std::function<void()>& run) {
  CLI::App* command = app.add_subcommand("export", "the fields of a results file for other programs");
  command->add_option("results", request.results, "results file")->required();
  command->add_flag("--vtkhdf", request.vtkhdf,
                    "as VTKHDF, which ParaView 5.12 and later reads without its XDMF reader");
  command->add_option("--out", request.out, "file to write; default: RESULTS with the ending .vtkhdf");
  command->add_option("--show", request.show,
                      "NAME,NAME: sets of output.field_sets and beams to take; default: all that are not within "
                      "another");
  command->add_option("--from", request.from, "leave out output times before, s");
  command->add_option("--to", request.to, "leave out output times after, s");
  command->add_flag("--overwrite", request.overwrite,
                    "replace a file that is there even if railwave has not written it; never the results");
  command->callback(run);
}

}  // namespace railwave
