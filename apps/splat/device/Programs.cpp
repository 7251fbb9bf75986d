#include "device/Programs.h"

#include "vorion/support/Environment.h"
#include "vorion/support/File.h"
#include "vorion/support/Hash.h"

#include <filesystem>
#include <fmt/format.h>
#include <map>
#include <system_error>

namespace vorion::splat {

namespace fs = std::filesystem;

static fs::path thisProgram() {
  std::error_code Failed;
  return fs::read_symlink("/proc/self/exe", Failed);
}

/// Where scripts/env.sh, or who installed the tree, says that it is; otherwise
/// where this program is.
static fs::path root() {
  const char *Given = environmentVariable("VORION_ROOT");
  return Given ? fs::path(Given) : thisProgram().parent_path().parent_path();
}

Expected<std::string> hashPrograms(const std::string &Splat) {
  // By name in the tree, so that a tree that is moved has the same programs.
  std::map<std::string, fs::path> Files{
      {"splat", Splat.empty() ? thisProgram() : fs::path(Splat)}};
  const fs::path Root = root();
  for (const char *Name : {"bin/vorion-compiler", "bin/vorion-clang.cfg",
                           "lib/libvorion-runtime.so", "lib/vorion",
                           "include/vorion", "pocl/lib", "pocl/share/pocl"}) {
    const fs::path Place = Root / Name;
    std::error_code Failed;
    if (fs::is_regular_file(Place, Failed))
      Files.emplace(Name, Place);
    for (fs::recursive_directory_iterator It(Place, Failed), End;
         !Failed && It != End; It.increment(Failed))
      if (It->is_regular_file(Failed))
        Files.emplace(It->path().lexically_relative(Root).string(), It->path());
  }
  std::string Hashes;
  for (const auto &[Name, File] : Files) {
    const auto Hash = xxh3OfFile(File.string());
    if (!Hash)
      return Hash.error();
    Hashes += fmt::format("{:016x} {}\n", *Hash, Name);
  }
  return fnv1a64(Hashes);
}

} // namespace vorion::splat
