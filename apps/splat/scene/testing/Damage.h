/// Small scenes of every format and damaged copies of them, for the tests, the
/// command-line tests and as the fuzzers' seeds.
#pragma once

#include "scene/testing/SceneWriters.h"

#include <string>
#include <vector>

namespace vorion::splat::testing {

/// A whole file; \c Name has the ending that the format usually has.
struct SampleFile {
  std::string Name, Content;
};
std::vector<SampleFile> sampleFiles();

/// A file with one thing wrong, and a part of the message that must say so.
struct DamagedFile {
  std::string Name, Content, Message;
};
std::vector<DamagedFile> damagedFiles();

/// A folder with one thing wrong.
struct DamagedFolder {
  std::string Name;
  Folder Files;
  std::string Message;
};
std::vector<DamagedFolder> damagedFolders();

/// A streamed scene of two levels: two chunks of the finest (\p Fine, cut in
/// the middle), one of the coarse (\p Coarse), and an environment.
Folder streamedSogOf(const Scene &Fine, const Scene &Coarse,
                     const Scene &Environment);

} // namespace vorion::splat::testing
