/// What the fuzzers of kept files call, and a test replays: whatever a sweep's
/// folder or a checkpoint holds, it is used whole, or not and with one line
/// that says why; otherwise the program aborts.
#pragma once

#include "io/Bytes.h"

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace vorion::splat::fuzz {

/// A checkpoint's file, and the same bytes behind a first line whose checksum
/// is right. Gives how many of the two were read.
std::size_t readCheckpoint(Bytes Input);

/// The files of a sweep's folder, as bundled() has them: points of a small
/// sweep, its reference, and what that was made from. Gives how many of its
/// points are used.
std::size_t readSweep(Bytes Input);
/// The same of a training sweep, points alone.
std::size_t readTrainSweep(Bytes Input);

/// Small whole inputs, by name.
using Seeds = std::vector<std::pair<std::string, std::string>>;
Seeds checkpointSeeds();
Seeds sweepSeeds();
Seeds trainSweepSeeds();

} // namespace vorion::splat::fuzz
