#include "commands/follow.hpp"

#include <fmt/format.h>

#include <csignal>
#include <cstdlib>
#include <iostream>
#include <stdexcept>

#include "case/document.hpp"
#include "case/error.hpp"
#include "case/read_case.hpp"
#include "commands/process.hpp"
#include "commands/threads.hpp"
#include "mesh/contact_zone.hpp"
#include "model/assembly.hpp"
#include "model/model.hpp"
#include "output/free_memory.hpp"
#include "solve/ranks/rank_team.hpp"

namespace railwave {
namespace {

constexpr int done = 0, failed = 1, wrong_input = 2;

/// In one piece: launchers of MPI put their own words between what comes in several.
void complain(int rank, const std::string& what) {
  std::cerr << fmt::format("railwave: rank {}: {}\n", rank, what) << std::flush;
}

std::string text_of(const std::exception& error) {
  return is_out_of_memory(error) ? out_of_memory(error) : error.what();
}

/// Address space in bytes: what MPI takes to begin, as it does not live through a lack of memory, and what it may take
/// for a message.
constexpr std::size_t of_mpi = std::size_t{96} << 20, of_messages = std::size_t{16} << 20;

bool lacks_memory(const std::exception& error) { return is_out_of_memory(error) || !can_be_had(of_messages); }

/// Without memory MPI may lose what others are sent, and they would wait without end: nothing is sent any more.
[[noreturn]] void end_all(Transport& transport, const std::exception& error) {
  complain(transport.rank(), text_of(error) +
                                 "; all ranks end. If there is a checkpoint, --restart goes on from it, on any number "
                                 "of ranks");
  transport.end_all();
  std::abort();  // which compilers do not see that it never comes to
}

std::unique_ptr<Transport> begin_mpi() {
  if (others_were_started() && !can_be_had(of_mpi)) throw TooLittleMemory(of_mpi);
  auto transport = transport_of_processes();
  if (transport) meet(*transport);  // ways to others are made at the first message
  return transport;
}

/// What a rank has been given to run; where the case cannot be read, the settings alone.
std::string given(const std::string& case_file, const std::vector<std::string>& overrides) {
  std::string text;
  for (const std::string& one : overrides) text += one + '\n';
  try {
    return text + case_file::load_text(case_file);
  } catch (const InputError&) {
    return text;
  }
}

/// Makes the model. Whoever reads sees what rank 0 says of the case; this rank says what it alone finds.
int build(const std::string& case_file, const std::vector<std::string>& overrides, Transport& transport, Model& model) {
  try {
    scene::Scene scene = read_case(case_file, overrides, nullptr);
    place_contact_zones(scene);
    std::vector<std::string> notes;
    build_model(scene, assemble(scene, notes), model, &transport);
    return done;
  } catch (const InputError& error) {
    if (lacks_memory(error)) end_all(transport, error);
    if (transport.first_to_refuse(false) == transport.rank()) complain(transport.rank(), error.what());
    transport.followers_have_ended = true;
    return wrong_input;
  } catch (const std::exception& error) {
    if (transport.followers_have_ended) return done;  // another rank has failed, and says so
    if (lacks_memory(error)) end_all(transport, error);
    complain(transport.rank(), error.what());
    return failed;
  }
}

}  // namespace

int follow_run(const std::string& case_file, const std::vector<std::string>& overrides) {
  // Rank 0 decides when a run that is to stop has come to a whole step.
  for (const int one : {SIGINT, SIGTERM, SIGHUP, SIGXCPU, SIGUSR1, SIGUSR2}) std::signal(one, SIG_IGN);
  std::cout.rdbuf(nullptr);
  std::unique_ptr<Transport> transport;
  try {
    transport = begin_mpi();
  } catch (const std::bad_alloc& error) {
    complain(rank_of_process(), out_of_memory(error));
    return failed;
  } catch (const InputError&) {
    return wrong_input;  // rank 0 says it
  }
  if (!transport) return failed;
  try {
    wanted_row_way(*transport);
    expect_one_case(*transport, given(case_file, overrides));
  } catch (const InputError&) {
    return wrong_input;  // rank 0 says it
  } catch (const std::runtime_error&) {
    return failed;  // the same
  }
  const KokkosScope kokkos;
  Model model;
  const int built = build(case_file, overrides, *transport, model);
  if (transport->followers_have_ended) return built;  // all know that it is over
  if (!transport->all_agree(built == done)) return built;
  try {
    follow_rank_0(model, *transport);
  } catch (const std::exception& error) {
    end_all(*transport, error);
  }
  return done;
}

OtherRanks::OtherRanks(const std::string& case_file, const std::vector<std::string>& overrides)
    : transport_(begin_mpi()) {
  if (!transport_) return;
  wanted_row_way(*transport_);  // a mistake is said before there is anything to wait for
  expect_one_case(*transport_, given(case_file, overrides));
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
  if (transport_) meet(*transport_);
}

int OtherRanks::end_together(const std::function<int()>& work) {
  try {
    return work();
  } catch (const std::exception& error) {
    const bool of_input = dynamic_cast<const InputError*>(&error) != nullptr;
    if (!transport_ || transport_->followers_have_ended || !(lacks_memory(error) || (told_ && !of_input))) throw;
    end_all(*transport_, error);
  }
}

}  // namespace railwave
