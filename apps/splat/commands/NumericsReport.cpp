#include "NumericsReport.h"

#include "vorion/support/File.h"

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <utility>

namespace vorion::splat {

Expected<NumericsReport> NumericsReport::begin(const std::string &Settings) {
  std::error_code Failed;
  std::string Folder = std::filesystem::temp_directory_path(Failed).string() +
                       "/splat-numerics-XXXXXX";
  if (Failed || !mkdtemp(Folder.data()))
    return Error{Folder, std::string("cannot make a folder: ") +
                             std::strerror(errno) +
                             ", expected TMPDIR to be one that can be written"};
  NumericsReport R(Folder);
  setenv(
      "VORION_NUMERICS",
      ((Settings == "on" ? "" : Settings + ",") + "text=" + R.file()).c_str(),
      1);
  return R;
}

NumericsReport::NumericsReport(NumericsReport &&From) noexcept
    : Folder(std::exchange(From.Folder, {})) {}

NumericsReport::~NumericsReport() {
  std::error_code Ignored;
  if (!Folder.empty())
    std::filesystem::remove_all(Folder, Ignored);
}

Expected<std::string> NumericsReport::text() const {
  const auto Bytes = readFile(file());
  if (!Bytes)
    return Error{"",
                 "the device reports nothing about its numbers, expected a "
                 "Vorion device with --numerics",
                 ExitCode::Usage};
  return std::string(reinterpret_cast<const char *>(Bytes->data()),
                     Bytes->size());
}

} // namespace vorion::splat
