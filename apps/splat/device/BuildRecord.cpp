#include "device/BuildRecord.h"

#include "vorion/support/File.h"
#include "vorion/support/KernelCacheFolder.h"

#include <filesystem>
#include <system_error>
#include <utility>

namespace vorion::splat {

std::string kernelCacheFolder() {
  return areKernelsCached() ? findKernelCacheFolder().Path : std::string();
}

BuildRecord::BuildRecord() : BuildRecord(kernelCacheFolder()) {}

BuildRecord::BuildRecord(std::string CacheFolder)
    : Folder(std::move(CacheFolder)) {
  if (!Folder.empty())
    Folder += "/splat-programs";
}

bool BuildRecord::has(const std::string &Key) const {
  std::error_code Ignored;
  return !Folder.empty() &&
         std::filesystem::exists(Folder + "/" + Key, Ignored);
}

void BuildRecord::add(const std::string &Key) const {
  if (Folder.empty() || has(Key))
    return;
  std::error_code Failed;
  std::filesystem::create_directories(Folder, Failed);
  if (!Failed)
    static_cast<void>(writeFileAtomically(Folder + "/" + Key, std::string()));
}

} // namespace vorion::splat
