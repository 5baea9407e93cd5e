#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>

namespace fastball::launch {

/// Where the launcher of a system leaves what `down` and `ps` need, of this user on this machine:
/// one folder for each system file, with the processes' output, in $XDG_RUNTIME_DIR/fastball or
/// else in fastball-UID in the folder for temporary files. What cannot be written there throws
/// std::runtime_error.
class StateFolder {
 public:
  /// Makes the folder. @param system_path absolute path of the system file
  explicit StateFolder(const std::string& system_path);
  ~StateFolder();
  StateFolder(const StateFolder&) = delete;
  StateFolder& operator=(const StateFolder&) = delete;

  const std::string& path() const { return path_; }
  std::string outputPath(const std::string& process) const {
    return path_ + "/" + process + ".log";
  }

  /// Becomes the launcher of the system. The lock ends with this object or this process.
  /// @return false if another process is.
  bool lock();
  /// True while a launcher has the lock.
  bool isLocked() const;

  void write(const nlohmann::json& state) const;
  /// What the launcher wrote last, or nothing.
  std::optional<nlohmann::json> read() const;

 private:
  std::string path_;
  int lock_ = -1;
};

}  // namespace fastball::launch
