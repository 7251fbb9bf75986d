/// Measurements that are kept as files, so that a study goes on where it
/// stopped.
#pragma once

#include "study/Provenance.h"
#include "vorion/support/Expected.h"

#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace vorion::splat {

/// A JSON file that splat wrote.
Expected<nlohmann::ordered_json> readOwnJson(const std::string &Path);

/// Makes the folders of a study below \p Folder.
Expected<Success> makeFolders(const std::string &Folder);

/// The measurements of a study: each has a name, a file, and what it was made
/// from.
class PointStore {
public:
  using Json = nlohmann::ordered_json;

  /// Those of \p Folder. \p IsMeasurement says of any object whose "point" is
  /// the point's name whether the rest is a measurement of it; \p Log gets a
  /// line for each file that is not used.
  PointStore(std::string Folder,
             std::function<bool(const Json &)> IsMeasurement,
             std::function<void(std::string_view)> Log);

  /// The measurement called \p Name if it was made from \p From. Each file is
  /// read once.
  const Json *find(const std::string &Name, const Provenance &From);
  /// The same; an Error if there is none.
  Expected<Json> get(const std::string &Name, const Provenance &From);
  /// Writes \p Measured and has it from now on.
  Expected<Success> keep(const std::string &Name, const Provenance &From,
                         const Json &Measured);

private:
  std::string fileOf(const std::string &Name) const;
  /// Why the file called \p Name does not serve, or nothing.
  std::string problem(const std::string &Name, const Expected<Json> &Read,
                      const Provenance &From) const;

  std::string Folder;
  std::function<bool(const Json &)> IsMeasurement;
  std::function<void(std::string_view)> Log;
  /// By name; null where no file serves.
  std::map<std::string, Json> Known;
};

} // namespace vorion::splat
