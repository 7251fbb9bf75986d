/// `splat render --numerics`: the numeric sanitizer of the Vorion device
/// (docs/debugging.md, "Numerics").
#pragma once

#include "device/DeviceOptions.h"
#include "vorion/support/TemporaryFolder.h"

#include <string>

namespace vorion::splat {

/// Of devices that are opened while it lives. The platform makes it, which
/// reports to a file.
class NumericsReport {
public:
  /// Adds it to \p Options, with \p Settings as VORION_NUMERICS has them.
  /// Errors: no temporary folder.
  static Expected<NumericsReport> begin(const std::string &Settings,
                                        DeviceOptions &Options);

  /// What has been found so far. Error: the device wrote nothing.
  Expected<std::string> text() const;

private:
  explicit NumericsReport(TemporaryFolder FolderIn)
      : Folder(std::move(FolderIn)) {}
  std::string file() const { return Folder.path() + "/report.txt"; }
  TemporaryFolder Folder;
};

} // namespace vorion::splat
