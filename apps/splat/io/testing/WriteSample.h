/// Writes what the programs that make sample files are asked for.
#pragma once

#include "vorion/support/File.h"

#include <filesystem>
#include <fmt/format.h>
#include <string>

namespace vorion::splat::testing {

/// Writes \p File and the folders it lies in.
inline Expected<Success> writeSample(const std::filesystem::path &File,
                                     const std::string &Content) {
  std::error_code Failed;
  std::filesystem::create_directories(File.parent_path(), Failed);
  if (Failed)
    return Error{File.parent_path().string(),
                 fmt::format("cannot make the folder: {}, expected a folder "
                             "that can be written",
                             Failed.message())};
  return writeFileAtomically(File.string(), Content);
}

} // namespace vorion::splat::testing
