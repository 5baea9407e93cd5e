#include "tests/system/local_slurm.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <stdlib.h>
#include <unistd.h>

#include <boost/asio/ip/host_name.hpp>
#include <boost/process.hpp>
#include <boost/process/extend.hpp>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <thread>

#include "launch/child_setup.h"

namespace fastball::system_test {
namespace {

namespace bp = boost::process;
namespace fs = std::filesystem;
constexpr auto kReadyLimit = std::chrono::seconds(120);
constexpr auto kQuestionInterval = std::chrono::milliseconds(200);
constexpr int kFirstPort = 40000;
constexpr int kPorts = 10000;

/// A program's place; daemons may lie where only root looks.
boost::filesystem::path placeOf(const std::string& program) {
  std::vector<boost::filesystem::path> places = boost::this_process::path();
  places.emplace_back("/usr/sbin");
  return bp::search_path(program, places);
}

std::string hostName() {
  const std::string name = boost::asio::ip::host_name();
  return name.substr(0, name.find('.'));
}

}  // namespace

struct LocalSlurm::Daemons {
  std::vector<bp::child> all;
  ~Daemons() {
    for (auto daemon = all.rbegin(); daemon != all.rend(); ++daemon) {
      if (daemon->running())
        kill(daemon->id(), SIGTERM);
      daemon->wait();
    }
  }
  void start(const std::string& program,
             const std::vector<std::string>& words,
             const std::string& output) {
    const pid_t parent = getpid();
    all.emplace_back(
        placeOf(program), bp::args = words,
        bp::std_in<bp::null, (bp::std_out & bp::std_err)> output,
        bp::extend::on_exec_setup = [parent](auto& /*executor*/) {
          launch::prepareChild(parent, SIGTERM);
        });
  }
};

std::string LocalSlurm::whyNot() {
  for (const char* program : {"munged", "slurmctld", "slurmd", "sbatch", "squeue", "scancel"}) {
    if (placeOf(program).empty())
      return fmt::format("there is no {} here (Debian's packages slurm-wlm and munge)", program);
  }
  return geteuid() == 0 ? "" : "only root can start slurmd";
}

void LocalSlurm::writeFiles() const {
  std::ofstream key(at("munge.key"), std::ios::binary);
  std::random_device random;
  for (int i = 0; i < 256; ++i) {
    const unsigned word = random();
    key.write(reinterpret_cast<const char*>(&word), sizeof(word));
  }
  key.close();
  fs::permissions(at("munge.key"), fs::perms::owner_read);
  const int port = kFirstPort + 2 * (getpid() % kPorts);
  std::ofstream(at("slurm.conf")) << fmt::format(
      R"(ClusterName=fastball
SlurmctldHost={host}(127.0.0.1)
SlurmctldPort={control_port}
SlurmdPort={node_port}
SlurmUser=root
AuthType=auth/munge
AuthInfo=socket={folder}/munge.sock
CredType=cred/munge
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
SlurmdParameters=config_overrides
MpiDefault=none
ReturnToService=2
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/slurmd.pid
NodeName={host} NodeAddr=127.0.0.1 CPUs=2 State=UNKNOWN
PartitionName=all Nodes=ALL Default=YES MaxTime=INFINITE State=UP
)",
      fmt::arg("host", hostName()), fmt::arg("folder", folder_.path().string()),
      fmt::arg("control_port", port), fmt::arg("node_port", port + 1));
}

LocalSlurm::LocalSlurm() : daemons_(std::make_unique<Daemons>()) {
  writeFiles();
  setenv("SLURM_CONF", at("slurm.conf").c_str(), 1);
  daemons_->start("munged",
                  {"--foreground", "--force", "--key-file=" + at("munge.key"),
                   "--socket=" + at("munge.sock"), "--pid-file=" + at("munged.pid"),
                   "--log-file=" + at("munged.log"), "--seed-file=" + at("munge.seed")},
                  at("munged.txt"));
  const auto begun = std::chrono::steady_clock::now();
  const auto in_time = [begun] { return std::chrono::steady_clock::now() - begun < kReadyLimit; };
  while (!fs::exists(at("munge.sock")) && in_time())
    std::this_thread::sleep_for(kQuestionInterval);
  daemons_->start("slurmctld", {"-D"}, at("slurmctld.txt"));
  daemons_->start("slurmd", {"-D", "-N", hostName()}, at("slurmd.txt"));
  while (!ready() && in_time())
    std::this_thread::sleep_for(kQuestionInterval);
  for (const char* output : {"munged.txt", "slurmctld.txt", "slurmd.txt"}) {
    std::ifstream file(at(output));
    if (!in_time())
      ADD_FAILURE() << "Slurm does not become ready; " << output << ":\n" << file.rdbuf();
  }
}

LocalSlurm::~LocalSlurm() = default;

bool LocalSlurm::ready() const {
  return ask("sinfo", {"--noheader", "--format=%T"}).find("idle") != std::string::npos;
}

std::string LocalSlurm::ask(const std::string& program,
                            const std::vector<std::string>& words) const {
  bp::ipstream output;
  bp::child child(placeOf(program), bp::args = words, bp::std_in<bp::null, bp::std_out> output,
                  bp::std_err > bp::null);
  std::string text{std::istreambuf_iterator<char>(output), {}};
  child.wait();
  return text;
}

}  // namespace fastball::system_test
