#include "launch/gnuplot.h"

#include <fmt/format.h>

#include <cstdio>
#include <stdexcept>

namespace fastball::launch {
namespace {

/// Hands a script to gnuplot.
void gnuplot(const std::string& script) {
  std::FILE* pipe = popen("gnuplot", "w");
  const bool written = pipe && std::fwrite(script.data(), 1, script.size(), pipe) == script.size();
  if (!pipe || pclose(pipe) != 0 || !written)
    throw std::runtime_error("gnuplot could not draw the picture (Debian package gnuplot-nox)");
}

}  // namespace

std::string dataBlock(const std::string& name, const std::string& data) {
  return fmt::format("${} << EOD\n{}EOD\n", name, data);
}

std::string quoted(const std::string& text) {
  std::string result = "'";
  for (const char c : text) {
    result += c;
    if (c == '\'')
      result += c;
  }
  return result + "'";
}

void drawPicture(const std::string& path_stem,
                 int width,
                 int height,
                 const std::string& data,
                 const std::string& commands) {
  std::string script = data;
  for (const char* const terminal : {"pngcairo", "svg"}) {
    const std::string ending = terminal == std::string("svg") ? ".svg" : ".png";
    script += fmt::format(
        "set terminal {} size {},{} font 'sans,11' background rgb 'white'\nset output {}\n"
        "{}unset output\nreset\n",
        terminal, width, height, quoted(path_stem + ending), commands);
  }
  gnuplot(script);
}

}  // namespace fastball::launch
