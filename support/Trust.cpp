#include "vorion/support/Trust.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <grp.h>
#include <optional>
#include <pwd.h>
#include <string_view>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>
#include <vector>

namespace vorion {
namespace {

namespace fs = std::filesystem;

/// Room for an entry of the databases of users and groups. A group with more
/// members than fit is nobody's own.
constexpr std::size_t EntryBytes = 65536;

/// Whether \p Group has no member but \p Owner: where each user has a group of
/// the same name and number, files are writable for the group by default.
bool isOwnGroup(gid_t Group, uid_t Owner) {
  // Root's group is the system's.
  if (Group != Owner || Owner == 0)
    return false;
  std::vector<char> UserText(EntryBytes), GroupText(EntryBytes);
  passwd User{}, *FoundUser = nullptr;
  group Members{}, *FoundGroup = nullptr;
  if (getpwuid_r(Owner, &User, UserText.data(), UserText.size(), &FoundUser) ||
      getgrgid_r(Group, &Members, GroupText.data(), GroupText.size(),
                 &FoundGroup) ||
      !FoundUser || !FoundGroup || User.pw_gid != Group)
    return false;
  const std::string_view Name = User.pw_name;
  for (char **Each = Members.gr_mem; *Each; ++Each)
    if (*Each != Name)
      return false;
  return Name == Members.gr_name;
}

/// Why \p Path itself is not trusted. \p OnTheWay: as a folder above what is
/// meant.
std::string whyUntrustedItself(const fs::path &Path, uid_t Owner,
                               bool OnTheWay) {
  struct stat Is{}, Root{};
  if (::lstat(Path.c_str(), &Is) != 0)
    return Path.string() + ": " + std::strerror(errno);
  if (Is.st_uid != Owner) {
    // In a namespace of its own, a process sees files of the system's root as
    // another user's; the root folder is among them.
    const bool IsSystems = Is.st_uid == 0 || (::lstat("/", &Root) == 0 &&
                                              Is.st_uid == Root.st_uid);
    if (!OnTheWay || !IsSystems)
      return Path.string() + " belongs to user " + std::to_string(Is.st_uid);
  }
  if (OnTheWay && (Is.st_mode & S_ISVTX))
    return {};
  if ((Is.st_mode & S_IWOTH) ||
      ((Is.st_mode & S_IWGRP) && !isOwnGroup(Is.st_gid, Owner)))
    return Path.string() + " can be written by other users";
  return {};
}

/// The same for each folder from the root to \p Path, which has no links.
std::string whyWayIsUntrusted(const fs::path &Path, uid_t Owner) {
  fs::path Folder;
  for (const fs::path &Name : Path) {
    Folder /= Name;
    if (std::string Why = whyUntrustedItself(Folder, Owner, true); !Why.empty())
      return Why;
  }
  return {};
}

std::string cannotBe(const fs::path &Path, std::string_view What, int Cause) {
  return Path.string() + ": cannot be " + std::string(What) + ": " +
         std::strerror(Cause);
}

} // namespace

std::string whyUntrusted(const fs::path &Path, uid_t Owner) {
  std::error_code Failed;
  const fs::path Real = fs::canonical(Path, Failed);
  if (Failed)
    return Path.string() + ": " + Failed.message();
  if (std::string Why = whyWayIsUntrusted(Real.parent_path(), Owner);
      !Why.empty())
    return Why;
  return whyUntrustedItself(Real, Owner, false);
}

std::string makeOwnFolder(const fs::path &Path) {
  const uid_t Us = ::geteuid();
  std::error_code Failed;
  fs::path There = Path;
  while (!fs::exists(There, Failed) && There.has_relative_path())
    There = There.parent_path();
  if (There != Path)
    if (std::string Why = whyWayIsUntrusted(fs::canonical(There, Failed), Us);
        !Why.empty())
      return Why;

  fs::path Folder;
  for (const fs::path &Name : Path) {
    Folder /= Name;
    if (!fs::is_directory(Folder, Failed) &&
        ::mkdir(Folder.c_str(), S_IRWXU) != 0) {
      const int Cause = errno == EEXIST ? ENOTDIR : errno;
      // Another process may have made it at the same time.
      if (!fs::is_directory(Folder, Failed))
        return cannotBe(Folder, "made", Cause);
    }
  }
  if (std::string Why = whyUntrusted(Path, Us); !Why.empty())
    return Why;
  if (::faccessat(AT_FDCWD, Path.c_str(), W_OK | X_OK, AT_EACCESS) != 0)
    return cannotBe(Path, "written", errno);
  return {};
}

} // namespace vorion
