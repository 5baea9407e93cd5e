#pragma once

#include <map>
#include <string>

namespace fastball::view {

/// The files of the page, read once, so that no request can lead out of their folder.
class PageFiles {
 public:
  struct File {
    std::string type;  ///< MIME
    std::string bytes;
  };
  /// @throw std::runtime_error if there is no page in the folder, and says how to build one.
  explicit PageFiles(const std::string& folder);
  /// The file that a path such as "/assets/a.js" names, or null. "/" is the page itself.
  const File* find(const std::string& path) const;

 private:
  std::map<std::string, File> files_;
};

/// Where the page lies: beside the program as it was built, or as it was installed.
std::string pageFolder();

}  // namespace fastball::view
