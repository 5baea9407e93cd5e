#pragma once

#include <optional>

#include "launch/view/page_files.h"
#include "lcmtypes/fastball_types.h"

namespace fastball::view {

/// An image as a file that a browser can show: a JPEG as it is, grey values as PNG. Nothing if it
/// is neither, or has fewer bytes than its rows.
std::optional<PageFiles::File> pictureFile(const image_t& image);

}  // namespace fastball::view
