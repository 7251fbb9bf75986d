/// What `splat info` says about a capture.
#pragma once

#include "capture/Capture.h"
#include "vorion/support/Expected.h"

#include <CLI/CLI.hpp>
#include <optional>
#include <string>

namespace vorion::splat {

/// Reads the capture at \p Path, prints what is in it and, unless \p JsonFile
/// is empty, writes the same for programs.
Expected<Success> describeCapture(const std::string &Path,
                                  const std::string &JsonFile,
                                  bool AllowOutside);

/// Declares --allow-outside, of every command that reads captures
/// (CaptureOptions); \p Allow must outlive the parsing.
void addOutsideOption(CLI::App &App, bool &Allow);

/// Declares --hold-out, of those that train and judge; \p Every must outlive
/// the parsing.
void addHoldOutOption(CLI::App &App, std::optional<unsigned> &Every);

/// Declares --masks, of those that compare with photographs; \p Masks must
/// outlive the parsing.
void addMasksOption(CLI::App &App, MaskSource &Masks);

} // namespace vorion::splat
