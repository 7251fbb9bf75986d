#include "Program.h"

#include "StackDepth.h"
#include "vorion/support/Diagnostics.h"

#include <filesystem>
#include <fmt/format.h>
#include <vorion_abi.h>

namespace fs = std::filesystem;

namespace vorion::link {

namespace {

/// The folder with start.o, vorion.ld and libdevice.a.
Expected<fs::path> deviceFolder() {
  std::error_code Failed;
  const fs::path Self = fs::read_symlink("/proc/self/exe", Failed);
  const fs::path Folder = Self.parent_path().parent_path() / "lib" / "vorion";
  for (const char *Name : {"start.o", "vorion.ld", "libdevice.a"})
    if (!fs::exists(Folder / Name, Failed))
      return Error{(Folder / Name).string(),
                   "missing, expected beside the installed tools"};
  return Folder;
}

} // namespace

Expected<std::vector<std::string>>
programArguments(const std::vector<std::string> &Given) {
  const auto Folder = deviceFolder();
  if (!Folder)
    return Folder.error();
  std::vector<std::string> Arguments = {LinkerName,
                                        "-T",
                                        (*Folder / "vorion.ld").string(),
                                        "--gc-sections",
                                        "--fatal-warnings",
                                        "--no-dynamic-linker",
                                        "-static",
                                        (*Folder / "start.o").string()};
  Arguments.insert(Arguments.end(), Given.begin(), Given.end());
  Arguments.push_back((*Folder / "libdevice.a").string());
  return Arguments;
}

Expected<Success> completeProgram(std::span<std::byte> Program,
                                  std::string_view Tool,
                                  const std::string &File) {
  const auto Needs = writeStackNeeds(Program, File);
  if (!Needs)
    return Needs.error();
  for (const StackNeed &Need : *Needs)
    if (Need.Bytes > VX_MAX_STACK_ROOM)
      printDiagnostic(Tool, "warning", File,
                      fmt::format("{} needs a stack of {} bytes per work-item, "
                                  "expected at most {}, the limit of a machine",
                                  Need.Name, Need.Bytes, VX_MAX_STACK_ROOM));
  return Success{};
}

} // namespace vorion::link
