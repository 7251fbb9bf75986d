/// Checks issued commands against a timing table. It knows nothing of the
/// controller: it asks every constraint of every pair of commands.
#pragma once

#include "timing/dram/Controller.h"

#include <string>
#include <vector>

namespace vorion::isasim::dram {

/// The first command that the device would not survive, in words; empty if
/// there is none.
std::string firstViolation(const TimingTable &Table,
                           const std::vector<Issued> &All);

} // namespace vorion::isasim::dram
