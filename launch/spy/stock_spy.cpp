#include "launch/spy/stock_spy.h"

#include <fmt/format.h>
#include <unistd.h>

#include <boost/process/search_path.hpp>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <stdexcept>
#include <vector>

namespace fastball::launch {
namespace {

namespace fs = std::filesystem;

std::string variable(const char* name) {
  const char* value = std::getenv(name);
  return value == nullptr ? "" : value;
}

/// The types' jar, in the build tree beside the program, or installed.
fs::path typesJar() {
  const fs::path folder = fs::read_symlink("/proc/self/exe").parent_path();
  const fs::path built = folder / "fastball-types.jar";
  return fs::exists(built) ? built : folder / "../share/fastball/fastball-types.jar";
}

void require(bool there, const std::string& what, const std::string& mend) {
  if (!there)
    throw std::runtime_error(fmt::format(
        "lcm-spy cannot start: {}; {}, or use `fastball spy` without --gui", what, mend));
}

}  // namespace

void runStockSpy(const std::string& lcm_url) {
  const std::string java = boost::process::search_path("java").string();
  const std::string packages = "install the packages default-jre, liblcm-java and libjchart2d-java";
  require(!java.empty(), "there is no java on the PATH", packages);
  require(fs::exists(FASTBALL_LCM_JAR), "there is no " FASTBALL_LCM_JAR, packages);
  require(fs::exists(FASTBALL_CHART_JAR), "there is no " FASTBALL_CHART_JAR, packages);
  require(fs::exists(typesJar()), fmt::format("there is no {}", typesJar().string()),
          "install default-jdk-headless and liblcm-java and build again");
  require(!variable("DISPLAY").empty(), "there is no display ($DISPLAY is empty)",
          "start it where there is one");
  std::string class_path =
      fmt::format("{}:{}:{}", FASTBALL_LCM_JAR, FASTBALL_CHART_JAR, typesJar().string());
  if (!variable("CLASSPATH").empty())
    class_path += ":" + variable("CLASSPATH");
  std::vector<std::string> words{java,          "-Djava.net.preferIPv4Stack=true",
                                 "-Xmx256m",    "-ea",
                                 "-cp",         class_path,
                                 "lcm.spy.Spy", "-l",
                                 lcm_url};
  std::vector<char*> arguments;
  for (std::string& word : words)
    arguments.push_back(word.data());
  arguments.push_back(nullptr);
  execv(java.c_str(), arguments.data());
  throw std::runtime_error(fmt::format("cannot start {}: {}", java, std::strerror(errno)));
}

}  // namespace fastball::launch
