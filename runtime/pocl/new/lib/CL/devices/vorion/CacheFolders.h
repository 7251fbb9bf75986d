/// Where this process keeps its kernels.
#pragma once

#include <string>

namespace vorion {

/// The folder that pocl_find_cache_folder() found last; empty if it found none.
std::string usedCacheFolder();

} // namespace vorion
