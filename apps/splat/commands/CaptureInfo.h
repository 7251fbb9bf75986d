/// `splat info` for captures, and options of all commands that read captures.
#pragma once

#include "capture/Capture.h"
#include "vorion/support/Expected.h"

#include <CLI/CLI.hpp>
#include <cstddef>
#include <optional>
#include <span>
#include <string>

namespace vorion::splat {

/// Reads the capture at \p Path, prints a summary of it and, unless \p JsonFile
/// is empty, writes it as JSON.
Expected<Success> describeCapture(const std::string &Path,
                                  const std::string &JsonFile,
                                  CaptureOptions Options);

/// Lines about what was matched in a capture (Capture::Notes), and about views
/// that were skipped, for commands that read captures.
std::string readerLines(std::span<const std::string> Notes,
                        std::size_t WithoutPicture);

/// Declares --images and --allow-outside (CaptureOptions), for commands that
/// read captures; \p Options must outlive the parsing.
void addPlaceOptions(CLI::App &App, CaptureOptions &Options);

/// Declares --allow-outside alone; \p Allow must outlive the parsing.
void addOutsideOption(CLI::App &App, bool &Allow);

/// Declares --hold-out, for training and evaluation; \p Every must outlive the
/// parsing.
void addHoldOutOption(CLI::App &App, std::optional<unsigned> &Every);

/// Declares --masks, for comparisons with photographs; \p Masks must outlive
/// the parsing.
void addMasksOption(CLI::App &App, MaskSource &Masks);

} // namespace vorion::splat
