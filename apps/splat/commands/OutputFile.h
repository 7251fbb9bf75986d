/// Whether results can be kept, asked before they are made.
#pragma once

#include "vorion/support/Expected.h"

#include <string>

namespace vorion::splat {

/// Whether \p File, if its name is not empty, could be written.
Expected<Success> checkWritable(const std::string &File);

} // namespace vorion::splat
