/// Writing of PNG.
#pragma once

#include "vorion/support/Expected.h"

#include <string>

namespace vorion::splat {

/// \p Rgb has three bytes per pixel, rows from the top. Strips of rows are
/// compressed in parallel, by the pixels alone: the file is the same for any
/// number of processors.
Expected<std::string> encodePng(const unsigned char *Rgb, int Width,
                                int Height);

} // namespace vorion::splat
