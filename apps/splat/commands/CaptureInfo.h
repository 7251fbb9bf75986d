/// `splat info` for captures, and options of all commands that read captures.
#pragma once

#include "capture/Capture.h"
#include "vorion/support/Expected.h"

#include <CLI/CLI.hpp>
#include <optional>
#include <string>

namespace vorion::splat {

/// Reads the capture at \p Path, prints a summary of it and, unless \p JsonFile
/// is empty, writes it as JSON.
Expected<Success> describeCapture(const std::string &Path,
                                  const std::string &JsonFile,
                                  bool AllowOutside);

/// Declares --allow-outside (CaptureOptions), for all commands that read
/// captures; \p Allow must outlive the parsing.
void addOutsideOption(CLI::App &App, bool &Allow);

/// Declares --hold-out, for training and evaluation; \p Every must outlive the
/// parsing.
void addHoldOutOption(CLI::App &App, std::optional<unsigned> &Every);

/// Declares --masks, for comparisons with photographs; \p Masks must outlive
/// the parsing.
void addMasksOption(CLI::App &App, MaskSource &Masks);

} // namespace vorion::splat
