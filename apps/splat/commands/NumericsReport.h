/// `splat render --numerics`: the numeric sanitizer of the Vorion device
/// (docs/numeric-sanitizer.md).
#pragma once

#include "device/DeviceOptions.h"
#include "vorion/support/TemporaryFolder.h"

#include <string>

namespace vorion::splat {

/// The report of devices that are opened during the lifetime of the object. The
/// platform writes it to a file.
class NumericsReport {
public:
  /// Requests it in \p Options, with \p Settings in the syntax of
  /// VORION_NUMERICS. Error: a temporary folder cannot be created.
  static Expected<NumericsReport> begin(const std::string &Settings,
                                        DeviceOptions &Options);

  /// The findings so far. An error if the device wrote no report.
  Expected<std::string> text() const;

private:
  explicit NumericsReport(TemporaryFolder FolderIn)
      : Folder(std::move(FolderIn)) {}
  std::string file() const { return Folder.path() + "/report.txt"; }
  TemporaryFolder Folder;
};

} // namespace vorion::splat
