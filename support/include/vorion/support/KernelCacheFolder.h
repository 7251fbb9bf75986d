/// Where compiled kernels are kept. PoCL's library and `splat` must agree.
#pragma once

#include <string>
#include <vector>

namespace vorion {

/// Whether compiled kernels are kept from run to run, as POCL_KERNEL_CACHE
/// says.
bool areKernelsCached();

/// The folder that keeps a user's compiled kernels.
struct KernelCacheFolder {
  /// Absolute and without links; made for this user alone, or trusted
  /// (Trust.h). Empty if there is none.
  std::string Path;
  /// Why there is none, of the folder that POCL_CACHE_DIR names. Empty if the
  /// variable is unset: without a folder, each process then keeps its kernels
  /// for itself.
  std::string Problem;
  /// Why folders that come before \c Path are of no use.
  std::vector<std::string> PassedOver;
};

/// POCL_CACHE_DIR; else the first that is good of XDG_CACHE_HOME/pocl/\p Name,
/// HOME/.cache/pocl/\p Name and the same in the user's home by the database of
/// users. Of these, relative folders do not count. Makes the folder.
KernelCacheFolder findKernelCacheFolder(const std::string &Name = "kcache");

/// The folder of kernels that root has compiled for all users. It need not be
/// there.
std::string systemKernelCacheFolder();

} // namespace vorion
