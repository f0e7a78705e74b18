#include "commands/command_line.hpp"

namespace railwave {
namespace {

struct KindHelp {
  SignalKind kind;
  const char* name;
  const char* help;
  const char* channel;
};

constexpr KindHelp kind_helps[] = {
    {SignalKind::psd, "psd", "power spectral density by Welch's method", "what is analysed; may be repeated"},
    {SignalKind::wavelet, "wavelet", "power by time and frequency, Morlet's wavelet", "what is analysed: one"},
    {SignalKind::bandpass, "bandpass", "the part of a history in a band, without delay",
     "what is filtered; may be repeated"},
    {SignalKind::cross, "cross", "phase and coherence of two channels, or of pairs of them",
     "two of them: what is compared, and what with"},
    {SignalKind::ellipse, "ellipse", "the ellipse that a particle runs through",
     "two of them: along the wave's travel, and out of the surface"},
    {SignalKind::speed, "speed", "how fast a wave comes along a row of sets", "the row, e.g. 'rail.row_*.velocity.z'"},
};

}  // namespace

void add_signal_command(CLI::App& app, SignalRequest& request, const std::function<void()>& run) {
  CLI::App* command =
      app.add_subcommand("signal", "spectra, wavelets, phases, ellipses and wave speeds of a run's histories");
  command->require_subcommand(1);
  for (const KindHelp& kind : kind_helps) {
    CLI::App* c = command->add_subcommand(kind.name, kind.help);
    const bool welch = kind.kind == SignalKind::psd || kind.kind == SignalKind::cross;
    c->add_option("results", request.results, "results file")->required();
    c->add_option("--channel", request.channels,
                  std::string(kind.channel) +
                      "; SET.velocity.z, contact.NAME.normal_force.z, energy.kinetic ... (docs/signals.md)")
        ->allow_extra_args(false);
    c->add_flag("--average", request.average, "make one channel, their mean, of all that a --channel finds");
    c->add_option("--from", request.from, "leave out what is before, s");
    c->add_option("--to", request.to, "leave out what is after, s");
    c->add_option("--low", request.low, "lower edge of the band, Hz");
    c->add_option("--high", request.high, "upper edge of the band, Hz");
    c->add_option("--trend", request.trend, "what is taken out first: none, mean or line; default mean");
    if (kind.kind != SignalKind::wavelet && !welch)
      c->add_option("--order", request.order, "of the Butterworth filter that makes the band; default 4");
    if (welch) {
      c->add_option("--segment", request.segment,
                    "length of a segment, s; default: eight of them, of several pairs everything");
      c->add_option("--overlap", request.overlap, "share of a segment that the next one has too; default 0.5");
      c->add_option("--window", request.window, "rectangular, hann, hamming, flat_top or tukey; default hann");
    }
    if (kind.kind == SignalKind::wavelet) {
      c->add_option("--w0", request.w0,
                    "of Morlet's wavelet: the larger, the finer in frequency and the coarser in time; default 6");
      c->add_option("--scale-spacing", request.scale_spacing, "octaves from one scale to the next; default 0.125");
    }
    c->add_option("--csv", request.csv, "also write the table as CSV, in SI units");
    c->add_option("--hdf5", request.hdf5, "also write everything as HDF5, which scripts/picture --signal draws");
    c->add_flag("--overwrite", request.overwrite,
                "replace files that are there even if railwave has not written them; never the results");
    c->callback([&request, kind, run] {
      request.kind = kind.kind;
      run();
    });
  }
}

}  // namespace railwave
