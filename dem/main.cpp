// dipper-dem CONFIG: the rock side of a paired run, under mpirun. Rank 0 receives the requests;
// every rank carries them out. dipper-dem --hosts: prints the place of each rank.
#include <fmt/core.h>
#include <mpi.h>
#include <sys/prctl.h>

#include <array>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <string>
#include <thread>
#include <vector>

#include "common/host_identity.hpp"
#include "coupler/setup/peer_config.hpp"
#include "coupler/transport/codec.hpp"
#include "coupler/transport/lcm_transport.hpp"
#include "coupler/transport/serve.hpp"
#include "dem/liggghts_rock.hpp"
#include "dem/rank_count.hpp"
#include "dem/work_folder.hpp"

namespace dipper::dem {
namespace {

/// MPI_Bcast from rank 0 without spinning: the other ranks wait between windows for as long as the
/// machine side needs, and on a small computer that side needs the core.
void broadcast(void* data, int bytes) {
  MPI_Request request;
  MPI_Ibcast(data, bytes, MPI_BYTE, 0, MPI_COMM_WORLD, &request);
  int done = 0;
  for (int spins = 0; MPI_Test(&request, &done, MPI_STATUS_IGNORE), done == 0; ++spins) {
    if (spins > 100) std::this_thread::sleep_for(std::chrono::microseconds(20));
  }
}

/// Sends rank 0's bytes to every rank.
std::string share(std::string bytes) {
  std::int64_t size = static_cast<std::int64_t>(bytes.size());
  broadcast(&size, sizeof size);
  bytes.resize(size);
  broadcast(bytes.data(), static_cast<int>(size));
  return bytes;
}

/// In the format of launch::read_places.
void report_hosts() {
  int rank = 0, ranks = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Comm_size(MPI_COMM_WORLD, &ranks);
  using Line = std::array<char, 512>;
  Line own{};
  std::vector<Line> all(rank == 0 ? static_cast<std::size_t>(ranks) : 0);
  fmt::format_to_n(own.data(), own.size() - 1, "rank\t{}\t{}\t{}\n", rank, host_name(),
                   network_identity());
  MPI_Gather(own.data(), own.size(), MPI_CHAR, all.data(), own.size(), MPI_CHAR, 0, MPI_COMM_WORLD);
  for (const Line& line : all) fmt::print("{}", line.data());
}

bool is_stop(const core::Message& m) {
  const auto* c = std::get_if<core::Command>(&m.body);
  return c != nullptr && c->action == core::Action::stop;
}

void run(const char* config_file) {
  const setup::PeerConfig config = setup::read_peer_config(config_file);
  const setup::RockSetup rock_setup = setup::rock_setup_from(config.settings);
  check_rank_count(rock_setup.ranks);
  int rank = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  const std::filesystem::path links = std::filesystem::absolute(config_file).string() + ".links";
  LiggghtsRock rock(enter_work_folder(rock_setup, links, MPI_COMM_WORLD), MPI_COMM_WORLD);
  if (rank != 0) {
    while (true) {
      const core::Message m = transport::decode(share({}));
      if (is_stop(m)) return;
      transport::answer(rock, m);
    }
  }
  transport::LcmTransport lcm(config.lcm_url, transport::Channels::to_dem, config.secret);
  transport::serve(lcm, transport::Channels::from_dem, config.checkpoints,
                   [&](const core::Message& m) {
                     share(transport::encode(m));
                     return transport::answer(rock, m);
                   });
}

}  // namespace
}  // namespace dipper::dem

int main(int argc, char** argv) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);          // with mpirun, however that ends
  std::setvbuf(stdout, nullptr, _IOLBF, 0);  // MPI_Abort drops what a buffer holds
  prctl(PR_SET_TIMERSLACK, 1000UL);          // ns: sleeps between windows are tens of microseconds
  MPI_Init(&argc, &argv);
  if (argc != 2) {
    fmt::print(stderr, "usage: dipper-dem CONFIG   (started by `dipper run`)\n");
    MPI_Abort(MPI_COMM_WORLD, 2);
  }
  try {
    std::string(argv[1]) == "--hosts" ? dipper::dem::report_hosts() : dipper::dem::run(argv[1]);
  } catch (const std::exception& e) {
    fmt::print(stderr, "dipper-dem: {}\n", e.what());
    MPI_Abort(MPI_COMM_WORLD, 3);
  }
  MPI_Finalize();
  return 0;
}
