#include "device/BuildRecord.h"

#include "vorion/support/File.h"

#include <cstdlib>
#include <filesystem>
#include <system_error>
#include <utility>

namespace vorion::splat {

namespace {

std::string variable(const char *Name) {
  const char *Value = std::getenv(Name);
  return Value ? Value : "";
}

} // namespace

std::string kernelCacheFolder() {
  if (variable("POCL_KERNEL_CACHE") == "0")
    return {};
  if (std::string Set = variable("POCL_CACHE_DIR"); !Set.empty())
    return Set;
  if (const std::string Xdg = variable("XDG_CACHE_HOME"); !Xdg.empty())
    return Xdg + "/pocl/kcache";
  const std::string Home = variable("HOME");
  return Home.empty() ? "" : Home + "/.cache/pocl/kcache";
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
