#include "launch/view/page_files.h"

#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>

#include "launch/processes.h"

namespace fastball::view {
namespace {

namespace fs = std::filesystem;

std::string typeOf(const fs::path& path) {
  static const std::map<std::string, std::string> kTypes{
      {".html", "text/html; charset=utf-8"}, {".js", "text/javascript; charset=utf-8"},
      {".css", "text/css; charset=utf-8"},   {".svg", "image/svg+xml"},
      {".json", "application/json"},         {".txt", "text/plain; charset=utf-8"}};
  const auto type = kTypes.find(path.extension().string());
  return type == kTypes.end() ? "application/octet-stream" : type->second;
}

}  // namespace

PageFiles::PageFiles(const std::string& folder) {
  std::error_code error;
  for (fs::recursive_directory_iterator i(folder, error), end; i != end; ++i) {
    if (!i->is_regular_file())
      continue;
    std::ifstream file(i->path(), std::ios::binary);
    files_["/" + fs::relative(i->path(), folder).generic_string()] = {
        typeOf(i->path()), std::string(std::istreambuf_iterator<char>(file), {})};
  }
  if (files_.count("/index.html") == 0)
    throw std::runtime_error(fmt::format(
        "there is no page in {}: it is built where Node is; `./fastball view` in the source folder "
        "installs that (apt-get install nodejs npm), builds the page and starts",
        folder));
}

const PageFiles::File* PageFiles::find(const std::string& path) const {
  const auto file = files_.find(path == "/" ? "/index.html" : path);
  return file == files_.end() ? nullptr : &file->second;
}

std::string pageFolder() {
  const fs::path programs = launch::programFolder();
  const fs::path built = programs / "view-page";
  return (fs::exists(built) ? built : programs / "../share/fastball/view-page").string();
}

}  // namespace fastball::view
