/// Small pictures for a page.
#pragma once

#include "io/Image.h"

#include <string>

namespace vorion::splat {

/// \p I averaged down to \p Width pixels (or its own width if that is less), as
/// a data URI of a PNG.
Expected<std::string> thumbnail(const ExactImage &I, unsigned Width);

/// How far \p A and \p B, of one size, are apart: the largest difference of
/// each block of pixels, from black at 1e-5 to white at 1 in steps of equal
/// ratio, red from 1/255 on.
Expected<std::string> differenceThumbnail(const ExactImage &A,
                                          const ExactImage &B, unsigned Width);

} // namespace vorion::splat
