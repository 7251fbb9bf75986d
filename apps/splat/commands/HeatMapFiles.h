/// `splat render --heat-map`: pictures of where the rasterizers' work is.
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

/// Of devices that are opened while it lives.
class HeatMapFiles {
public:
  /// What begins with \p Prefix: PREFIX.list.png and so on, PREFIX.json.
  static std::vector<NamedFile> outputs(const std::string &Prefix);

  /// Asks for it in \p Options, which turns the machine's clock on. Errors: no
  /// temporary folder. No files are written where \p Prefix is empty.
  static Expected<HeatMapFiles> begin(std::string Prefix,
                                      DeviceOptions &Options);

  /// What the device drew. An error where it told of no tiles.
  Expected<DrawnTiles> tiles() const;
  /// Writes what the device drew of \p View; \p Report says what made it.
  Expected<Success> write(const Camera &View,
                          nlohmann::ordered_json Report) const;

private:
  HeatMapFiles(std::string PrefixIn, std::optional<TemporaryFolder> FolderIn,
               std::string FileIn, std::string RegionIn)
      : Prefix(std::move(PrefixIn)), Folder(std::move(FolderIn)),
        File(std::move(FileIn)), Region(std::move(RegionIn)) {}

  std::string Prefix;
  std::optional<TemporaryFolder> Folder; ///< none if the user named the file
  std::string File;                      ///< what the device writes
  std::string Region;                    ///< of VORION_REGION, empty for none
};

} // namespace vorion::splat
