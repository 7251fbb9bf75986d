#include "commands/NumericsReport.h"

#include "vorion/support/File.h"

#include <utility>

namespace vorion::splat {

Expected<NumericsReport> NumericsReport::begin(const std::string &Settings,
                                               DeviceOptions &Options) {
  auto Folder = TemporaryFolder::make("splat-numerics");
  if (!Folder)
    return Folder.error();
  NumericsReport R(std::move(*Folder));
  Options.set("VORION_NUMERICS",
              (Settings == "on" ? "" : Settings + ",") + "text=" + R.file(),
              "--numerics");
  return R;
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
