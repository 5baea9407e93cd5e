#include "tests/kit/ssh_servers.h"

#include <fmt/format.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <thread>

namespace fastball::test_kit {
namespace {

namespace fs = std::filesystem;

constexpr const char* kServer = "/usr/sbin/sshd";
constexpr int kPort = 2222;
constexpr auto kPatience = std::chrono::seconds(20);

/// sshd without root serves nobody but the user it runs as, and that user must not be root.
constexpr int kUser = 1000;

std::string asUser() {
  return fmt::format("unshare -U --map-user={0} --map-group={0}", kUser);
}

void write(const std::string& path, const std::string& text) {
  std::ofstream(path) << text;
  fs::permissions(path, fs::perms::owner_read | fs::perms::owner_write);
}

}  // namespace

std::string SshServers::whyNot() {
  if (std::string why = Hosts::whyNot(); !why.empty())
    return why;
  if (access(kServer, X_OK) != 0)
    return fmt::format("there is no {} (package openssh-server)", kServer);
  if (std::system("command -v ssh ssh-keygen >/dev/null") != 0)
    return "there is no ssh (package openssh-client)";
  const bool nested = std::system((asUser() + " true 2>/dev/null").c_str()) == 0;
  return nested ? "" : "no user namespace to be had here, in which sshd needs no root";
}

SshServers::SshServers(Hosts& hosts, const std::vector<std::string>& names)
    : folder_(fs::temp_directory_path() / fmt::format("fastball-ssh-{}", getpid())) {
  fs::create_directories(folder_);
  for (const char* key : {"host", "user"}) {
    const std::string path = folder_ + "/" + key;
    fs::remove(path);
    if (std::system(("ssh-keygen -q -t ed25519 -N '' -f " + path).c_str()) != 0)
      throw std::runtime_error("ssh-keygen made no key");
  }
  const std::string shell = "/bin/sh";
  write(folder_ + "/passwd",
        fmt::format("root:x:0:0::/root:{0}\ntester:x:{1}:{1}::{2}:{0}\n", shell, kUser, folder_));
  std::string client;
  for (const std::string& name : names) {
    const std::string config = fmt::format("{}/sshd-{}", folder_, name);
    write(config,
          fmt::format("ListenAddress {}:{}\nHostKey {}/host\nAuthorizedKeysFile {}/user.pub\n"
                      "StrictModes no\nUsePAM no\nPasswordAuthentication no\nPidFile none\n",
                      hosts.address(name), kPort, folder_, folder_));
    client += fmt::format("Host {}\n  HostName {}\n", name, hosts.address(name));
    if (hosts.run(name, {"mount", "--bind", folder_ + "/passwd", "/etc/passwd"}) != 0)
      throw std::runtime_error("no file system of its own for " + name);
    hosts.start(name,
                {"sh", "-c",
                 fmt::format("exec {} {} -D -f {} 2>{}.log", asUser(), kServer, config, config)});
  }
  write(folder_ + "/client",
        client + fmt::format("Host *\n  Port {0}\n  User tester\n  IdentityFile {1}/user\n"
                             "  IdentitiesOnly yes\n  BatchMode yes\n  ConnectTimeout 5\n"
                             "  ServerAliveInterval 1\n  ServerAliveCountMax 3\n"
                             "  StrictHostKeyChecking no\n  UserKnownHostsFile /dev/null\n"
                             "  LogLevel ERROR\n",
                             kPort, folder_));
  const auto end = std::chrono::steady_clock::now() + kPatience;
  for (const std::string& name : names) {
    std::vector<std::string> hello = SshServers::client();
    hello.insert(hello.end(), {name, "true"});
    while (hosts.run(name, {"sh", "-c", fmt::format("{} 2>/dev/null", fmt::join(hello, " "))}) !=
           0) {
      if (std::chrono::steady_clock::now() > end) {
        std::ifstream log(fmt::format("{}/sshd-{}.log", folder_, name));
        const std::string words{std::istreambuf_iterator<char>(log), {}};
        throw std::runtime_error(fmt::format("the sshd of {} does not answer: {}", name, words));
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
  }
}

SshServers::~SshServers() {
  std::error_code ignored;
  fs::remove_all(folder_, ignored);
}

std::vector<std::string> SshServers::client() const {
  return {"ssh", "-F", folder_ + "/client", "-T"};
}

}  // namespace fastball::test_kit
