/// A region of a program's launches in a file, to be run again on machines with
/// other timing (docs/regions.md).
#pragma once

#include "region/MemoryChanges.h"
#include "vorion/isasim/Config.h"
#include "vorion/isasim/Image.h"
#include "vorion/support/Expected.h"
#include "vorion/support/GrowingFile.h"

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace vorion::isasim {

/// A launch, with all that the host did between the one before and it. The
/// first launch of a file has the state that the machine was in.
struct SavedLaunch {
  std::string Name; ///< the kernel's
  /// Which of the file's images; its data, if another was loaded before.
  uint32_t Image = 0;
  std::vector<std::byte> ImageData;
  bool IsFresh = false;   ///< whether ImageData is to be loaded with the image
  uint32_t Block = 0;     ///< address of the launch block
  bool IsCounted = false; ///< else it only warms up
  std::vector<MemoryChanges::Page> Pages;
  std::vector<std::byte> PageBytes; ///< of all pages, one behind the other
  uint64_t Changes = 0; ///< digest of what the launch itself changed
};

struct SavedRegion {
  Config Machine;
  std::vector<std::byte> RasterState;
  std::vector<std::shared_ptr<const Image>> Images;
  std::vector<SavedLaunch> Launches;
};

/// Whether \p File begins as regions do.
bool isRegion(std::span<const std::byte> File);
/// Errors: a file of another version, cut off, or damaged; one of no launches.
Expected<SavedRegion> parseRegion(std::span<const std::byte> File,
                                  const std::string &Where);

/// Whether \p C can run what \p R was saved on: only what the clock goes by,
/// the depth of rasterizers' queues, and what changes no result may differ.
Expected<Success> checkMachine(const SavedRegion &R, const Config &C,
                               const std::string &Where);

/// Writes a region launch by launch, before and after each. The file is
/// complete after each launch.
class RegionWriter {
public:
  /// Of what \p M, which has a rasterState(), does from now on. Errors: a file
  /// that cannot be written, and no room on the host.
  static Expected<RegionWriter> create(const std::string &Path,
                                       const Machine &M);

  /// \p M is about to run its image with the launch block at \p Block.
  void begin(const Machine &M, const std::string &Name, uint32_t Block,
             bool IsCounted);
  /// That launch is done.
  Expected<Success> end();

private:
  RegionWriter(GrowingFile FileIn, MemoryChanges MemoryIn)
      : File(std::move(FileIn)), Memory(std::move(MemoryIn)) {}
  void append(uint64_t Kind, std::span<const std::byte> Record);
  Expected<Success> complete();

  GrowingFile File;
  uint64_t Bytes = 0; ///< behind the file's head
  MemoryChanges Memory;
  std::vector<std::shared_ptr<const Image>> Images; ///< in the file
  std::shared_ptr<const Image> Current;
  std::optional<SavedLaunch> Launch;
};

} // namespace vorion::isasim
