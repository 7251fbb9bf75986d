#include "CacheFolders.h"

#include "vorion/support/KernelCacheFolder.h"
#include "vorion/support/TemporaryFolder.h"
#include "vorion/support/Trust.h"

extern "C" {
#include "pocl_cache_folders.h"
#include "pocl_checked_file.h"
#include "pocl_file_util.h"
#include "pocl_util.h"
}

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <mutex>
#include <optional>
#include <string>
#include <system_error>

namespace fs = std::filesystem;
using namespace vorion;

namespace {

/// With the reason why it is needed.
struct PrivateFolder {
  TemporaryFolder Folder;
  std::string Why;
};

std::optional<PrivateFolder> Private;

std::string Used;

int fail(const std::string &Text) {
  pocl_note_cache_problem(Text.c_str());
  return -1;
}

/// \p Folder into \p Path.
int give(const std::string &Folder, char *Path) {
  if (Folder.size() >= POCL_MAX_PATHNAME_LENGTH)
    return fail("the folder's name is too long");
  Folder.copy(Path, Folder.size());
  Path[Folder.size()] = 0;
  return 0;
}

} // namespace

std::string vorion::usedCacheFolder() { return Used; }

int pocl_find_cache_folder(int IsCached, char *Path) {
  const KernelCacheFolder Found =
      findKernelCacheFolder(IsCached ? "kcache" : "uncached");
  if (!Found.Problem.empty())
    return fail(Found.Problem);
  if (!Found.Path.empty()) {
    Used = Found.Path;
    return give(Found.Path, Path);
  }
  if (!Private) {
    auto Made = TemporaryFolder::make("vorion-kernels");
    if (!Made)
      return fail(Made.error().What);
    Private.emplace(std::move(*Made), Found.PassedOver.empty()
                                          ? "this user has no home"
                                          : Found.PassedOver.front());
  }
  Used = Private->Folder.path();
  return give(Used, Path);
}

void pocl_tell_of_private_cache() {
  static std::once_flag Told;
  if (Private)
    std::call_once(Told, [] {
      fprintf(
          stderr,
          "vorion: warning: kernel cache: %s; kernels are compiled again in "
          "each run, unless POCL_CACHE_DIR names a folder that you alone "
          "can write\n",
          Private->Why.c_str());
    });
}

int pocl_copy_from_system_cache(const char *Folder, const char *Place,
                                const char *Path) {
  const fs::path File = systemKernelCacheFolder() + "/" + Folder + Place;
  std::error_code Failed;
  if (!fs::is_regular_file(File, Failed) || !whyUntrusted(File, 0).empty())
    return -1;
  char *Bytes = nullptr;
  uint64_t Size = 0;
  if (pocl_read_file(File.c_str(), &Bytes, &Size) != 0)
    return -1;
  const int Status = pocl_mkdir_p(fs::path(Path).parent_path().c_str()) == 0
                         ? pocl_write_file(Path, Bytes, Size, 0)
                         : -1;
  free(Bytes);
  return Status;
}
