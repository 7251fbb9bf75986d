/// `splat render --numerics`: the numeric sanitizer of the Vorion device
/// (docs/debugging.md, "Numerics").
#pragma once

#include "vorion/support/TemporaryFolder.h"

#include <string>

namespace vorion::splat {

/// Turned on for devices that are opened while it lives; it is the platform's,
/// which reads its settings from the environment and reports to a file.
class NumericsReport {
public:
  /// \p Settings as VORION_NUMERICS has them. Errors: no temporary folder.
  static Expected<NumericsReport> begin(const std::string &Settings);

  /// What has been found so far. Error: the device wrote nothing.
  Expected<std::string> text() const;

private:
  explicit NumericsReport(TemporaryFolder FolderIn)
      : Folder(std::move(FolderIn)) {}
  std::string file() const { return Folder.path() + "/report.txt"; }
  TemporaryFolder Folder;
};

} // namespace vorion::splat
