/// Targets of the fuzzers of stored files, also replayed by a test. Any content
/// of a sweep's folder or a checkpoint must be used completely, or rejected
/// with a message of one line; otherwise the program aborts.
#pragma once

#include "io/Bytes.h"

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace vorion::splat::fuzz {

/// Reads a checkpoint, and the same bytes after a first line with the correct
/// checksum. Returns how many of the two were accepted.
std::size_t readCheckpoint(Bytes Input);

/// Reads the files of a sweep's folder in the format of bundled(): points of a
/// small sweep, its reference, and the provenance of the reference. Returns the
/// number of accepted points.
std::size_t readSweep(Bytes Input);
/// The same for the points of a training sweep.
std::size_t readTrainSweep(Bytes Input);

/// Small valid inputs, by name.
using Seeds = std::vector<std::pair<std::string, std::string>>;
Seeds checkpointSeeds();
Seeds sweepSeeds();
Seeds trainSweepSeeds();

} // namespace vorion::splat::fuzz
