#include "page/Figures.h"

#include "vorion/support/File.h"
#include "vorion/support/TemporaryFolder.h"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

namespace vorion::splat {

Expected<Success> writeFigures(const std::string &Page,
                               const std::string &Folder) {
  std::string File = Page, To = Folder;
  std::error_code Ignored;
  std::string Program =
      (std::filesystem::read_symlink("/proc/self/exe", Ignored).parent_path() /
       "splat-figures")
          .string();
  char *const Words[] = {Program.data(), File.data(), To.data(), nullptr};
  pid_t Child = 0;
  if (const int Failed = posix_spawn(&Child, Program.c_str(), nullptr, nullptr,
                                     Words, environ))
    return Error{Program, std::string("cannot start: ") +
                              std::strerror(Failed) +
                              ", expected the program that is installed with "
                              "splat"};
  int Status = 0;
  while (waitpid(Child, &Status, 0) < 0 && errno == EINTR) {
  }
  if (WIFEXITED(Status) && WEXITSTATUS(Status) == 0)
    return Success{};
  return Error{Folder, "the figures are not written, see the message above",
               WIFEXITED(Status) ? static_cast<ExitCode>(WEXITSTATUS(Status))
                                 : ExitCode::Internal};
}

Expected<Success> writePage(const PageFiles &To, const std::string &Page) {
  if (!To.Html.empty())
    if (auto Written = writeFileAtomically(To.Html, Page); !Written)
      return Written;
  if (To.Figures.empty())
    return Success{};
  const auto Place = TemporaryFolder::make("splat-figures");
  if (!Place)
    return Place.error();
  const std::string File = Place->path() + "/page.html";
  if (auto Written = writeFileAtomically(File, Page); !Written)
    return Written;
  return writeFigures(File, To.Figures);
}

} // namespace vorion::splat
