/// Measurements that are stored as files, so that an interrupted study can be
/// resumed.
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

/// Creates the folders of a study below \p Folder.
Expected<Success> makeFolders(const std::string &Folder);

/// The measurements of a study. Each has a name, a file and its provenance.
class PointStore {
public:
  using Json = nlohmann::ordered_json;

  /// Opens the store in \p Folder. \p IsMeasurement returns whether a JSON
  /// object, whose "point" is the point's name, is a valid measurement. \p Log
  /// receives a line for each file that is rejected.
  PointStore(std::string Folder,
             std::function<bool(const Json &)> IsMeasurement,
             std::function<void(std::string_view)> Log);

  /// The measurement \p Name if its provenance is \p From, else null. Each file
  /// is read once.
  const Json *find(const std::string &Name, const Provenance &From);
  /// The same; an Error if there is none.
  Expected<Json> get(const std::string &Name, const Provenance &From);
  /// Stores \p Measured, and writes its file.
  Expected<Success> keep(const std::string &Name, const Provenance &From,
                         const Json &Measured);

private:
  std::string fileOf(const std::string &Name) const;
  /// Why the file of \p Name is rejected; empty if it is valid.
  std::string problem(const std::string &Name, const Expected<Json> &Read,
                      const Provenance &From) const;

  std::string Folder;
  std::function<bool(const Json &)> IsMeasurement;
  std::function<void(std::string_view)> Log;
  /// By name; null where there is no valid file.
  std::map<std::string, Json> Known;
};

} // namespace vorion::splat
