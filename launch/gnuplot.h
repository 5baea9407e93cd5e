#pragma once

#include <string>

namespace fastball::launch {

/// A named block of data for gnuplot; `data` ends with a line feed.
std::string dataBlock(const std::string& name, const std::string& data);

/// `text` as a string of gnuplot that means just these characters, quotes included, on one line. No text can end the string.
std::string quoted(const std::string& text);

/// Draws `commands` twice: as path_stem.png and path_stem.svg, of width x height pixels, letters equally
/// large in both. Threads may do so at the same time.
/// @param data what the commands draw: data blocks.
/// @throw std::runtime_error if gnuplot cannot be run or fails.
void drawPicture(const std::string& path_stem,
                 int width,
                 int height,
                 const std::string& data,
                 const std::string& commands);

}  // namespace fastball::launch
