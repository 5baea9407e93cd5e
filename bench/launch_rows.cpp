#include "bench/launch_rows.h"

#include <fmt/format.h>

#include <algorithm>
#include <boost/process/args.hpp>
#include <boost/process/child.hpp>
#include <boost/process/exe.hpp>
#include <boost/process/io.hpp>
#include <boost/process/pipe.hpp>
#include <boost/process/search_path.hpp>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>

namespace fastball::bench {
namespace {

namespace bp = boost::process;
namespace fs = std::filesystem;

/// What bench/three_hosts_main.cpp prints, in namespaces that need no root.
nlohmann::json measured() {
  const fs::path folder = fs::read_symlink("/proc/self/exe").parent_path();
  bp::ipstream output;
  bp::child child(bp::exe = bp::search_path("unshare"),
                  bp::args = {"-Urn", (folder / "fastball-three-hosts").string()},
                  bp::std_out > output);
  const nlohmann::json result = nlohmann::json::parse(output, nullptr, false);
  child.wait();
  if (child.exit_code() != 0 || result.is_discarded())
    throw std::runtime_error("no three hosts to be had on this machine");
  return result;
}

}  // namespace

std::vector<Benchmark> launchBenchmarks() {
  return {{"launch.ready_s", [] {
             const nlohmann::json result = measured();
             std::vector<double> seconds = result.at("seconds");
             std::sort(seconds.begin(), seconds.end());
             return Row{
                 "launch.ready_s",
                 seconds[seconds.size() / 2],
                 "s",
                 "none",
                 std::nullopt,
                 fmt::format("`fastball up`, six processes on three hosts (namespaces of this "
                             "machine) to the last HEARTBEAT and their clocks, over {}; middle "
                             "of {}, {:.2f} to {:.2f}; 1.1 s of it listens for others",
                             result.at("ssh").get<std::string>(), seconds.size(), seconds.front(),
                             seconds.back())};
           }}};
}

}  // namespace fastball::bench
