#include "launch/gnuplot.h"

#include <fmt/format.h>

#include <cstdio>
#include <stdexcept>

#include "launch/clean_text.h"

namespace fastball::launch {
namespace {

/// Its pngcairo terminal takes a fresh surface as large as the picture for each filled shape. glibc would give each of
/// them back to the system and fault it in anew (mallopt(3)), a third of the time of a picture with many shapes.
constexpr const char* kCommand =
    "MALLOC_MMAP_THRESHOLD_=1000000000 MALLOC_TRIM_THRESHOLD_=1000000000 exec gnuplot";

/// Hands a script to gnuplot. Threads may do so at the same time.
void gnuplot(const std::string& script) {
  std::FILE* pipe = popen(kCommand, "we");
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
  for (const char c : cleanText(text)) {
    // A line feed would end the string, and what follows would be a command.
    result += c == '\n' || c == '\t' ? ' ' : c;
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
    // A point is 4/3 pixels in the one, and one in the other.
    const char* scale = terminal == std::string("svg") ? "fontscale 1.333" : "";
    script += fmt::format(
        "set terminal {} size {},{} font 'sans,11' {} background rgb 'white'\nset output {}\n"
        "{}unset output\nreset\n",
        terminal, width, height, scale, quoted(path_stem + ending), commands);
  }
  gnuplot(script);
}

}  // namespace fastball::launch
