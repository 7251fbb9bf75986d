/// `splat render --heat-map`: pictures of the rasterizers' work for each tile.
#pragma once

#include "device/DeviceOptions.h"
#include "device/TileWork.h"
#include "io/Cameras.h"
#include "vorion/support/Outputs.h"
#include "vorion/support/TemporaryFolder.h"

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

namespace vorion::splat {

/// Records the work of devices that are opened during the lifetime of the
/// object.
class HeatMapFiles {
public:
  /// The output files with the prefix \p Prefix: PREFIX.list.png and so on,
  /// PREFIX.json.
  static std::vector<NamedFile> outputs(const std::string &Prefix);

  /// Requests it in \p Options, which enables the clock. Error: a temporary
  /// folder cannot be created. If \p Prefix is empty, no files are written.
  static Expected<HeatMapFiles> begin(std::string Prefix,
                                      DeviceOptions &Options);

  /// The tiles that the device drew. An error if it reported none.
  Expected<DrawnTiles> tiles() const;
  /// Writes the files for \p View; \p Report has the provenance.
  Expected<Success> write(const Camera &View,
                          nlohmann::ordered_json Report) const;

private:
  HeatMapFiles(std::string PrefixIn, std::optional<TemporaryFolder> FolderIn,
               std::string FileIn, std::string RegionIn)
      : Prefix(std::move(PrefixIn)), Folder(std::move(FolderIn)),
        File(std::move(FileIn)), Region(std::move(RegionIn)) {}

  std::string Prefix;
  std::optional<TemporaryFolder> Folder; ///< none if the user named the file
  std::string File;                      ///< written by the device
  std::string Region;                    ///< of VORION_REGION, empty for none
};

} // namespace vorion::splat
