#include "vorion/support/KernelCacheFolder.h"

#include "vorion/support/Environment.h"
#include "vorion/support/Trust.h"

#include <filesystem>
#include <pwd.h>
#include <system_error>
#include <unistd.h>

namespace vorion {

namespace fs = std::filesystem;

/// By the database of users; empty if that does not say.
static fs::path homeOfUser() {
  std::vector<char> Text(65536);
  passwd User{}, *Found = nullptr;
  return getpwuid_r(::geteuid(), &User, Text.data(), Text.size(), &Found) ==
                     0 &&
                 Found
             ? User.pw_dir
             : "";
}

static fs::path folderIn(const char *Variable) {
  const char *Text = environmentVariable(Variable);
  return Text ? Text : "";
}

bool areKernelsCached() {
  const char *Wanted = environmentVariable("POCL_KERNEL_CACHE");
  return !Wanted || *Wanted == '1'; // as PoCL reads it
}

KernelCacheFolder findKernelCacheFolder(const std::string &Name) {
  KernelCacheFolder Found;
  std::error_code Failed;
  if (const fs::path Given = folderIn("POCL_CACHE_DIR"); !Given.empty()) {
    const fs::path Folder = fs::absolute(Given, Failed);
    Found.Problem = makeOwnFolder(Folder);
    if (Found.Problem.empty())
      Found.Path = fs::canonical(Folder, Failed);
    return Found;
  }
  const fs::path Below = fs::path("pocl") / Name;
  for (const fs::path &Cache :
       {folderIn("XDG_CACHE_HOME"), folderIn("HOME") / ".cache",
        homeOfUser() / ".cache"}) {
    if (!Cache.is_absolute())
      continue;
    std::string Why = makeOwnFolder(Cache / Below);
    if (Why.empty()) {
      Found.Path = fs::canonical(Cache / Below, Failed);
      break;
    }
    if (Found.PassedOver.empty() || Found.PassedOver.back() != Why)
      Found.PassedOver.push_back(std::move(Why));
  }
  return Found;
}

std::string systemKernelCacheFolder() {
  const char *Given = environmentVariable("VORION_SYSTEM_CACHE");
  return Given ? Given : "/var/cache/vorion/kernels";
}

} // namespace vorion
