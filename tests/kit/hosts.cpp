#include "tests/kit/hosts.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sched.h>
#include <sys/prctl.h>
#include <unistd.h>

#include <algorithm>
#include <boost/process/args.hpp>
#include <boost/process/child.hpp>
#include <boost/process/exe.hpp>
#include <boost/process/extend.hpp>
#include <boost/process/io.hpp>
#include <boost/process/search_path.hpp>
#include <csignal>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <thread>

namespace fastball::test_kit {
namespace {

namespace bp = boost::process;
namespace fs = std::filesystem;

constexpr const char* kTable = "inet fastball_test";

/// The namespace of a process, as a number for it.
ino_t networkOf(const std::string& pid) {
  std::error_code gone;
  const std::string name = fs::read_symlink("/proc/" + pid + "/ns/net", gone).string();
  const auto number = name.find('[');  // net:[4026532000]
  return number == std::string::npos ? 0 : std::strtoull(name.c_str() + number + 1, nullptr, 10);
}

/// @param wait_for_line so that what the program says first has been done when this returns
bp::child spawn(const std::vector<std::string>& words, bool wait_for_line) {
  const auto path = bp::search_path(words.front());
  if (path.empty() && words.front().find('/') == std::string::npos)
    throw std::runtime_error("there is no program " + words.front());
  const auto end_with_us = [](auto& /*executor*/) { prctl(PR_SET_PDEATHSIG, SIGKILL); };
  const auto program = path.empty() ? boost::filesystem::path(words.front()) : path;
  const std::vector<std::string> arguments(words.begin() + 1, words.end());
  if (!wait_for_line)
    return bp::child(bp::exe = program, bp::args = arguments, bp::std_in < bp::null,
                     bp::extend::on_exec_setup = end_with_us);
  bp::ipstream output;
  bp::child child(bp::exe = program, bp::args = arguments, bp::std_in<bp::null, bp::std_out> output,
                  bp::extend::on_exec_setup = end_with_us);
  std::string line;
  if (!std::getline(output, line))
    throw std::runtime_error(fmt::format("no namespace: {} failed", fmt::join(words, " ")));
  return child;
}

int runToEnd(const std::vector<std::string>& words) {
  bp::child child = spawn(words, false);
  child.wait();
  return WIFEXITED(child.native_exit_code()) ? child.exit_code() : -1;
}

}  // namespace

/// What holds the namespaces: a process that sleeps in them.
struct Hosts::Machine {
  Machine(const std::string& name, int its_number)
      : number(its_number),
        holder(spawn({"unshare", "-num", "sh", "-c",
                      "hostname \"$0\" && ip link set lo up && echo && exec sleep infinity", name},
                     true)),
        network(networkOf(std::to_string(holder.id()))) {}
  ~Machine() {
    holder.terminate();
    holder.wait();
  }
  std::vector<std::string> enter() const {
    return {"nsenter", "-t", std::to_string(holder.id()), "-n", "-u", "-m", "--wd=."};
  }
  void must(const std::string& line) const {
    std::vector<std::string> words = enter();
    words.insert(words.end(), {"sh", "-ec", line});
    if (const int status = runToEnd(words); status != 0)
      throw std::runtime_error(fmt::format("'{}' failed with exit status {}", line, status));
  }

  int number;
  bp::child holder;
  ino_t network;
  std::vector<bp::child> started;
};

std::string Hosts::whyNot() {
  for (const char* program : {"unshare", "nsenter", "ip"})
    if (bp::search_path(program).empty())
      return fmt::format("the program {} is missing (packages util-linux, iproute2)", program);
  const bool ours = std::system("unshare -num true 2>/dev/null") == 0;
  return ours ? "" : "no network namespaces to be had here";
}

Hosts::Hosts(const std::vector<std::string>& names)
    : folder_(fs::temp_directory_path() / fmt::format("fastball-hosts-{}", getpid())) {
  if (const std::string why = whyNot(); !why.empty())
    throw std::runtime_error(why);
  fs::create_directories(folder_);
  switch_ = std::make_unique<Machine>("switch", 0);
  // Without snooping: a bridge that learns who listens forgets it when nobody asks.
  switch_->must("ip link add bridge type bridge mcast_snooping 0 && ip link set bridge up");
  std::string cases;
  for (const std::string& name : names) {
    const int number = static_cast<int>(machines_.size()) + 1;
    Machine& machine = *(machines_[name] = std::make_unique<Machine>(name, number));
    switch_->must(
        fmt::format("ip link add port{0} type veth peer name eth0 netns {1}; "
                    "ip link set port{0} master bridge up",
                    number, machine.holder.id()));
    machine.must(
        fmt::format("ip addr add {}/24 dev eth0; ip link set eth0 up; "
                    "ip route add 224.0.0.0/4 dev eth0",
                    address(name)));
    cases += fmt::format("  {}) pid={};;\n", name, machine.holder.id());
  }
  for (const std::string& name : names)
    awaitLink(name);
  std::ofstream(sshStandIn()) << "#!/bin/sh\ncase $1 in\n"
                              << cases
                              << "  *) echo \"no host $1\" >&2; exit 255;;\nesac\n"
                                 "exec nsenter -t $pid -n -u -m --wd=. sh -c \"$2\"\n";
  fs::permissions(sshStandIn(), fs::perms::owner_all);
}

Hosts::~Hosts() {
  for (const auto& [name, machine] : machines_) {
    signalAll(*machine, SIGKILL);
    for (bp::child& child : machine->started)
      child.wait();
  }
  std::error_code ignored;
  fs::remove_all(folder_, ignored);
}

const Hosts::Machine& Hosts::machine(const std::string& host) const {
  return *machines_.at(host);
}

std::string Hosts::address(const std::string& host) const {
  return fmt::format("10.67.0.{}", machine(host).number);
}

std::string Hosts::sshStandIn() const {
  return folder_ + "/ssh";
}

std::vector<std::string> Hosts::enter(const std::string& host) const {
  return machine(host).enter();
}

int Hosts::start(const std::string& host, const std::vector<std::string>& command) {
  std::vector<std::string> words = enter(host);
  words.insert(words.end(), command.begin(), command.end());
  Machine& machine = *machines_.at(host);
  machine.started.push_back(spawn(words, false));
  return machine.started.back().id();
}

int Hosts::run(const std::string& host, const std::vector<std::string>& command) const {
  std::vector<std::string> words = enter(host);
  words.insert(words.end(), command.begin(), command.end());
  return runToEnd(words);
}

void Hosts::on(const std::string& host, const std::function<void()>& action) const {
  const int there =
      open(fmt::format("/proc/{}/ns/net", machine(host).holder.id()).c_str(), O_RDONLY | O_CLOEXEC);
  std::exception_ptr failure;
  // A thread of its own, so that this one stays where it is.
  std::thread([&] {
    try {
      if (setns(there, CLONE_NEWNET) != 0)
        throw std::runtime_error("cannot enter the network of " + host);
      action();
    } catch (...) {
      failure = std::current_exception();
    }
  }).join();
  close(there);
  if (failure)
    std::rethrow_exception(failure);
}

void Hosts::cutLink(const std::string& host) const {
  switch_->must(fmt::format("ip link set port{} down", machine(host).number));
}

void Hosts::restoreLink(const std::string& host) const {
  switch_->must(fmt::format("ip link set port{} up", machine(host).number));
  awaitLink(host);
}

void Hosts::awaitLink(const std::string& host) const {
  // The kernel takes a new carrier to notice in its own time, and drops what is sent before.
  const auto up = [](const Machine& where, const std::string& device) {
    where.must(
        fmt::format("for i in $(seq 1000); do ip link show {0} | grep -q 'state UP' && exit; sleep "
                    "0.01; done; exit 1",
                    device));
  };
  up(machine(host), "eth0");
  up(*switch_, fmt::format("port{}", machine(host).number));
  switch_->must(
      fmt::format("for i in $(seq 1000); do bridge link show dev port{} | grep -q 'state "
                  "forwarding' && exit; sleep 0.01; "
                  "done; exit 1",
                  machine(host).number));
}

void Hosts::losePackets(const std::string& host, double share) const {
  machine(host).must(
      fmt::format("nft add table {0}; nft delete table {0}; nft add table {0}; "
                  "nft add chain {0} input '{{ type filter hook input priority 0; }}'; "
                  "nft add rule {0} input iifname eth0 numgen random mod 10000 '<' {1} drop",
                  kTable, static_cast<int>(share * 10000)));
}

void Hosts::signalAll(const Machine& machine, int number) const {
  // Until no new one has come: a process may be starting another.
  for (std::vector<int> before, now;; before = std::exchange(now, {})) {
    for (const auto& entry : fs::directory_iterator("/proc")) {
      const std::string pid = entry.path().filename().string();
      const bool is_process =
          std::all_of(pid.begin(), pid.end(), [](char c) { return c >= '0' && c <= '9'; });
      if (is_process && networkOf(pid) == machine.network && std::stoi(pid) != machine.holder.id())
        now.push_back(std::stoi(pid));
    }
    std::sort(now.begin(), now.end());
    if (now == before || now.empty())
      return;
    for (const int pid : now)
      ::kill(pid, number);
  }
}

void Hosts::freeze(const std::string& host) const {
  signalAll(machine(host), SIGSTOP);
}

void Hosts::thaw(const std::string& host) const {
  signalAll(machine(host), SIGCONT);
}

void Hosts::kill(const std::string& host) const {
  signalAll(machine(host), SIGKILL);
}

void Hosts::mountDisk(const std::string& host, const std::string& path, int64_t bytes) const {
  machine(host).must(fmt::format("mount -t tmpfs -o size={} none '{}'", bytes, path));
}

}  // namespace fastball::test_kit
