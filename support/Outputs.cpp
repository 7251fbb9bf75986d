#include "vorion/support/Outputs.h"

#include "vorion/support/Diagnostics.h"
#include "vorion/support/File.h"

#include <filesystem>
#include <fmt/format.h>
#include <sys/stat.h>
#include <utility>
#include <vector>

namespace vorion {
namespace {

namespace fs = std::filesystem;

/// What two names have in common if they are one file: its place on a disk, or
/// that of the folder that it would be made in.
struct Identity {
  dev_t Device = 0;
  ino_t Number = 0;
  /// Of a file that is not there yet.
  std::string Name;
  /// Writing to it twice loses something.
  bool IsExclusive = false;

  bool isSame(const Identity &Other) const {
    return IsExclusive && Other.IsExclusive && Device == Other.Device &&
           Number == Other.Number && Name == Other.Name;
  }
};

Identity identityOf(const std::string &Path) {
  if (Path == StandardOutput)
    return {0, 0, Path, true};
  struct stat Info{};
  if (::stat(Path.c_str(), &Info) == 0)
    return {Info.st_dev, Info.st_ino, "", S_ISREG(Info.st_mode)};
  const fs::path Target = targetOf(Path);
  const std::string Folder =
      Target.has_parent_path() ? Target.parent_path().string() : ".";
  if (::stat(Folder.c_str(), &Info) != 0)
    return {};
  return {Info.st_dev, Info.st_ino, Target.filename().string(), true};
}

} // namespace

Expected<Success> claimOutputs(const std::vector<NamedFile> &Outputs,
                               const std::vector<NamedFile> &Inputs) {
  std::vector<std::pair<const NamedFile *, Identity>> Taken;
  for (const NamedFile &Input : Inputs)
    if (!Input.Path.empty())
      Taken.emplace_back(&Input, identityOf(Input.Path));
  for (const NamedFile &Output : Outputs) {
    if (Output.Path.empty())
      continue;
    const Identity Own = identityOf(Output.Path);
    for (const auto &[By, Other] : Taken)
      if (Own.isSame(Other))
        return Error{
            Output.Path,
            fmt::format("is the file of both {} and {}, expected two files",
                        By->Name, Output.Name),
            ExitCode::Usage};
    Taken.emplace_back(&Output, Own);
    if (auto Writable = checkWritable(Output.Path); !Writable)
      return Writable;
    if (Output.Path == StandardOutput)
      printToStandardError();
  }
  return Success{};
}

} // namespace vorion
