/// The cache folder for compiled kernels, used by PoCL's library and by
/// `splat`.
#pragma once

#include <string>
#include <vector>

namespace vorion {

/// Whether compiled kernels are cached between runs (POCL_KERNEL_CACHE).
bool areKernelsCached();

/// The cache folder of a user.
struct KernelCacheFolder {
  /// Absolute path without symbolic links; accessible only to this user, or
  /// trusted (Trust.h). Empty if there is none.
  std::string Path;
  /// Reason for which the folder of POCL_CACHE_DIR cannot be used. Empty if the
  /// variable is unset: without a folder, each process then has its own
  /// kernels.
  std::string Problem;
  /// Reasons for which the candidates before \c Path cannot be used.
  std::vector<std::string> PassedOver;
};

/// POCL_CACHE_DIR; else the first usable one of XDG_CACHE_HOME/pocl/\p Name,
/// HOME/.cache/pocl/\p Name and the same in the home folder of the user
/// database. Relative folders are ignored. Creates the folder.
KernelCacheFolder findKernelCacheFolder(const std::string &Name = "kcache");

/// The folder of kernels that root compiled for all users. It need not exist.
std::string systemKernelCacheFolder();

} // namespace vorion
