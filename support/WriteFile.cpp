#include "vorion/support/File.h"

#include "Descriptor.h"
#include "vorion/support/RemovedAtEnd.h"

#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <fmt/format.h>
#include <optional>
#include <string_view>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>
#include <utility>

namespace vorion {
namespace {

namespace fs = std::filesystem;

constexpr const char *WritableFolder = "a folder that can be written";

Error cannotWrite(const std::string &Path, int Cause,
                  std::string_view Wanted = WritableFolder) {
  if (Wanted == WritableFolder && (Cause == ENOSPC || Cause == EDQUOT))
    Wanted = "free space there";
  if (Cause == EFBIG)
    Wanted = "a higher limit on file sizes (ulimit -f)";
  return {Path, fmt::format("cannot write: {}, expected {}",
                            std::strerror(Cause), Wanted)};
}

/// What \p Path names, through links; nothing for what is not there.
std::optional<struct stat> statusOf(const std::string &Path) {
  struct stat Info{};
  if (::stat(Path.c_str(), &Info) != 0)
    return std::nullopt;
  return Info;
}

bool isSame(const struct stat &A, const struct stat &B) {
  return A.st_dev == B.st_dev && A.st_ino == B.st_ino;
}

/// The folder of \p Path, as open() takes it.
fs::path folderOf(const fs::path &Path) {
  return Path.has_parent_path() ? Path.parent_path() : fs::path(".");
}

/// A new file in the folder of the one that it will become, its target. It goes
/// with this unless it was renamed.
class TemporaryFile {
public:
  /// With \p Mode, less the process's umask.
  /// \p Path is what the user calls \p Target.
  static Expected<TemporaryFile> make(const std::string &Path,
                                      const std::string &Target, mode_t Mode) {
    // A short name of its own: the target's may already be as long as names
    // get, and two threads may write at a time.
    static std::atomic<unsigned> Count = 0;
    for (;;) {
      std::string Name =
          (folderOf(Target) / fmt::format(".vorion-{}-{}", ::getpid(), Count++))
              .string();
      const int Number =
          ::open(Name.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, Mode);
      if (Number >= 0)
        return TemporaryFile(std::move(Name), Target, Number);
      if (errno != EEXIST)
        return cannotWrite(Path, errno);
    }
  }
  TemporaryFile(TemporaryFile &&From) noexcept
      : Name(std::exchange(From.Name, {})), Target(std::move(From.Target)),
        AtEnd(std::move(From.AtEnd)), File(std::move(From.File)) {}
  TemporaryFile &operator=(TemporaryFile &&) = delete;
  ~TemporaryFile() {
    if (!Name.empty())
      ::unlink(Name.c_str());
  }

  Descriptor &file() { return File; }
  /// Removes what has its target's name. False leaves errno.
  bool makeRoom() const {
    return ::unlink(Target.c_str()) == 0 || errno == ENOENT;
  }
  /// False leaves errno.
  bool rename() {
    if (::rename(Name.c_str(), Target.c_str()) != 0)
      return false;
    Name.clear();
    return true;
  }

private:
  TemporaryFile(std::string NameIn, std::string TargetIn, int Number)
      : Name(std::move(NameIn)), Target(std::move(TargetIn)), AtEnd(Name),
        File(Number) {}
  std::string Name, Target;
  RemovedAtEnd AtEnd;
  Descriptor File;
};

/// Gives \p New, whose owner is us, what \p Old had, as far as we may.
bool keepRights(int New, const struct stat &Old) {
  // Only root gives files away, and groups are those that we are in.
  if (::fchown(New, Old.st_uid, Old.st_gid) != 0 &&
      ::fchown(New, static_cast<uid_t>(-1), Old.st_gid) != 0)
    errno = 0;
  // Without set-user-ID: what we wrote is not what was trusted.
  return ::fchmod(New, Old.st_mode & 0777) == 0;
}

/// Whether all that was written will outlast the machine; some file systems
/// know nothing of that.
bool synchronize(int File) {
  return ::fsync(File) == 0 || errno == EINVAL || errno == ENOSYS ||
         errno == EROFS;
}

/// What \p Target, which the user calls \p Path, is to become once it is
/// renamed.
Expected<TemporaryFile> writeAside(const std::string &Path,
                                   const std::string &Target,
                                   const std::optional<struct stat> &Old,
                                   const void *Data, std::size_t Size) {
  if (Old && ::access(Target.c_str(), W_OK) != 0)
    return cannotWrite(Path, errno, "a file that can be written");
  // What only its owner could read is never open to others.
  auto New = TemporaryFile::make(Path, Target, Old ? 0600 : 0666);
  if (!New)
    return New.error();
  Descriptor &File = New->file();
  if (writeAll(File.number(), Data, Size) &&
      (!Old || keepRights(File.number(), *Old)) && synchronize(File.number()) &&
      File.close())
    return New;
  return cannotWrite(Path, errno);
}

Expected<Success> writeThrough(const std::string &Path, const void *Data,
                               std::size_t Size) {
  Descriptor File(
      ::open(Path.c_str(), O_WRONLY | O_TRUNC | O_CLOEXEC | O_NOCTTY));
  if (File.number() >= 0 && writeAll(File.number(), Data, Size) && File.close())
    return Success{};
  return cannotWrite(Path, errno, "a device or a pipe that accepts it");
}

Expected<Success> writeStandardOutput(const void *Data, std::size_t Size) {
  // What was printed before comes first.
  if (std::fflush(stdout) == 0 && writeAll(STDOUT_FILENO, Data, Size))
    return Success{};
  return cannotWrite("standard output", errno, "one that takes it");
}

bool isStandardOutput(const std::string &Path,
                      const std::optional<struct stat> &Info) {
  struct stat Own{};
  return Path == StandardOutput ||
         (Info && ::fstat(STDOUT_FILENO, &Own) == 0 && isSame(*Info, Own));
}

/// Whether a file beside \p Target may take its place.
bool isReplaced(const std::string &Target,
                const std::optional<struct stat> &Info) {
  if (!Info)
    return true;
  // A name in /proc may say nothing of where its file is.
  const auto There = statusOf(Target);
  return S_ISREG(Info->st_mode) && There && isSame(*There, *Info);
}

/// What has \p Path's name, or nothing. A folder is an error.
Expected<std::optional<struct stat>> replacedBy(const std::string &Path) {
  if (auto Named = checkName(Path); !Named)
    return Named.error();
  auto Info = statusOf(Path);
  if (!Info && errno != ENOENT)
    return cannotWrite(Path, errno);
  if (Info && S_ISDIR(Info->st_mode))
    return Error{Path, "cannot write: is a folder, expected a file"};
  return Info;
}

} // namespace

std::string targetOf(const std::string &Path) {
  constexpr int MostLinks = 40; // as many as Linux follows
  fs::path Target = Path;
  std::error_code Failed;
  for (int I = 0; I < MostLinks; ++I) {
    const fs::path Next = fs::read_symlink(Target, Failed);
    if (Failed)
      break;
    Target = folderOf(Target) / Next; // Next itself if it is absolute
  }
  return Target.string();
}

Expected<Success> checkWritable(const std::string &Path) {
  if (isStandardOutput(Path, statusOf(Path)))
    return Success{};
  const auto Info = replacedBy(Path);
  if (!Info)
    return Info.error();
  if (*Info && ::access(Path.c_str(), W_OK) != 0)
    return cannotWrite(Path, errno, "a file that can be written");
  const std::string Target = targetOf(Path);
  if (!isReplaced(Target, *Info))
    return Success{};
  // A trial, since permissions alone do not tell for root or in /proc.
  const auto Trial = TemporaryFile::make(Path, Target, 0600);
  return Trial ? Expected<Success>(Success{}) : Trial.error();
}

Expected<Success> writeFileAtomically(const std::string &Path, const void *Data,
                                      std::size_t Size) {
  if (isStandardOutput(Path, statusOf(Path)))
    return writeStandardOutput(Data, Size);
  const auto Info = replacedBy(Path);
  if (!Info)
    return Info.error();
  const std::string Target = targetOf(Path);
  if (!isReplaced(Target, *Info))
    return writeThrough(Path, Data, Size);
  auto New = writeAside(Path, Target, *Info, Data, Size);
  if (!New)
    return New.error();
  if (!New->rename())
    return cannotWrite(Path, errno);
  return Success{};
}

Expected<Success> writeFileAtomically(const std::string &Path,
                                      std::string_view Text) {
  return writeFileAtomically(Path, Text.data(), Text.size());
}

Expected<Success> writeFilesTogether(const std::vector<FileContent> &Files) {
  std::vector<TemporaryFile> New;
  for (const auto &[Path, Content] : Files) {
    const auto Info = replacedBy(Path);
    if (!Info)
      return Info.error();
    const std::string Target = targetOf(Path);
    if (!isReplaced(Target, *Info))
      return Error{Path,
                   "cannot write: is a device or a pipe, expected a file"};
    auto Aside =
        writeAside(Path, Target, *Info, Content.data(), Content.size());
    if (!Aside)
      return Aside.error();
    New.push_back(std::move(*Aside));
  }
  if (!New.back().makeRoom())
    return cannotWrite(Files.back().Path, errno);
  for (std::size_t I = 0; I < New.size(); ++I)
    if (!New[I].rename())
      return cannotWrite(Files[I].Path, errno);
  return Success{};
}

} // namespace vorion
