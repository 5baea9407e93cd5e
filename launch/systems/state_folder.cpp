#include "launch/systems/state_folder.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <stdexcept>

namespace fastball::launch {
namespace {

namespace fs = std::filesystem;

std::string folderOfAll() {
  const char* runtime = std::getenv("XDG_RUNTIME_DIR");
  if (runtime != nullptr && *runtime != '\0' && fs::is_directory(runtime))
    return std::string(runtime) + "/fastball";
  return fmt::format("{}/fastball-{}", fs::temp_directory_path().string(), getuid());
}

int openLock(const std::string& folder) {
  return open((folder + "/lock").c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600);
}

}  // namespace

StateFolder::StateFolder(const std::string& system_path)
    : path_(fmt::format("{}/{}-{:016x}",
                        folderOfAll(),
                        fs::path(system_path).stem().string(),
                        std::hash<std::string>{}(system_path))) {
  fs::create_directories(path_);
  fs::permissions(folderOfAll(), fs::perms::owner_all);
}

StateFolder::~StateFolder() {
  if (lock_ >= 0)
    close(lock_);
}

bool StateFolder::lock() {
  lock_ = openLock(path_);
  if (lock_ < 0)
    throw std::runtime_error(fmt::format("cannot write in {}", path_));
  return flock(lock_, LOCK_EX | LOCK_NB) == 0;
}

bool StateFolder::isLocked() const {
  const int file = openLock(path_);
  if (file < 0)
    return false;
  const bool locked = flock(file, LOCK_EX | LOCK_NB) != 0;
  close(file);
  return locked;
}

void StateFolder::write(const nlohmann::json& state) const {
  // A reader sees the old state or the new one, never a half.
  const std::string temporary = path_ + "/state.new";
  std::ofstream(temporary) << state.dump(2) << '\n';
  fs::rename(temporary, path_ + "/state.json");
}

std::optional<nlohmann::json> StateFolder::read() const {
  std::ifstream file(path_ + "/state.json");
  const nlohmann::json state = nlohmann::json::parse(file, nullptr, false);
  if (!file || state.is_discarded())
    return std::nullopt;
  return state;
}

}  // namespace fastball::launch
