#include "commands/follow.hpp"

#include <fmt/format.h>

#include <csignal>
#include <iostream>
#include <stdexcept>

#include "case/error.hpp"
#include "case/read_case.hpp"
#include "commands/threads.hpp"
#include "mesh/contact_zone.hpp"
#include "model/assembly.hpp"
#include "model/model.hpp"
#include "model/ranks/block_partition.hpp"
#include "solve/ranks/rank_team.hpp"

namespace railwave {
namespace {

constexpr int done = 0, failed = 1, wrong_input = 2;

/// In one piece: launchers of MPI put their own words between what comes in several.
void complain(int rank, const std::exception& error) {
  std::cerr << fmt::format("railwave: rank {}: {}\n", rank, error.what()) << std::flush;
}

/// Whoever reads sees what rank 0 says; it says the same of the case.
int build(const std::string& case_file, const std::vector<std::string>& overrides, Transport& transport, Model& model) {
  try {
    scene::Scene scene = read_case(case_file, overrides, nullptr);
    place_contact_zones(scene);
    std::vector<std::string> notes;
    build_model(scene, assemble(scene, notes), model, &transport);
    refuse_on_ranks(model);
    return done;
  } catch (const InputError&) {
    return wrong_input;
  } catch (const std::exception& error) {
    if (transport.followers_have_ended) return done;  // another rank has failed, and says so
    complain(transport.rank(), error);
    return failed;
  }
}

}  // namespace

int follow_run(const std::string& case_file, const std::vector<std::string>& overrides) {
  // Rank 0 decides when a run that is to stop has come to a whole step.
  for (const int one : {SIGINT, SIGTERM, SIGHUP, SIGXCPU, SIGUSR1, SIGUSR2}) std::signal(one, SIG_IGN);
  std::cout.rdbuf(nullptr);
  const auto transport = transport_of_processes();
  if (!transport) return failed;
  const KokkosScope kokkos;
  Model model;
  const int built = build(case_file, overrides, *transport, model);
  if (transport->followers_have_ended) return built;  // all know that it is over
  if (!transport->all_agree(built == done)) return built;
  try {
    follow_rank_0(model, *transport);
  } catch (const std::exception& error) {
    complain(transport->rank(), error);
    transport->end_all();
  }
  return done;
}

OtherRanks::~OtherRanks() {
  if (!transport_ || transport_->followers_have_ended) return;
  if (told_)
    end_followers(*transport_);
  else
    transport_->all_agree(false);
}

void OtherRanks::begin() {
  told_ = true;
  if (transport_ && !transport_->all_agree(true)) {
    transport_->followers_have_ended = true;
    throw std::runtime_error("another rank could not make the model; nothing was run");
  }
}

}  // namespace railwave
