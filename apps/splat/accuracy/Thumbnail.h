/// Small pictures for a page.
#pragma once

#include "io/Image.h"

#include <string>

namespace vorion::splat {

/// \p I, downsampled to \p Width pixels (at most its own width), as a data URI
/// of a PNG.
Expected<std::string> thumbnail(const ExactImage &I, unsigned Width);

/// The difference of \p A and \p B, which have the same size: the maximum of
/// each block of pixels, on a logarithmic scale from black (1e-5) to white (1),
/// red above 1/255.
Expected<std::string> differenceThumbnail(const ExactImage &A,
                                          const ExactImage &B, unsigned Width);

} // namespace vorion::splat
