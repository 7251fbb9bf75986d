/// Measurements that are kept as files, so that a sweep goes on where it
/// stopped.
#pragma once

#include "vorion/support/Expected.h"

#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace vorion::splat {

/// The name of a file: no folders in it.
std::string asFileName(std::string Name);

/// A JSON file that splat wrote.
Expected<nlohmann::ordered_json> readJson(const std::string &Path);

/// Makes the folders of a sweep below \p Folder.
Expected<Success> makeFolders(const std::string &Folder);

/// A measurement, made by \c Measure, of which a line is said.
struct Measuring {
  std::string Name, File;
  std::function<Expected<nlohmann::ordered_json>()> Measure;
  std::function<std::string(const nlohmann::ordered_json &)> Say;
};

/// Measures all of \p Wanted, \p Jobs at a time, and writes a file each;
/// \p Said gets a line for each one that is done. Ends with the first that
/// fails.
Expected<Success> measureAll(const std::vector<Measuring> &Wanted,
                             unsigned Jobs,
                             const std::function<void(std::string_view)> &Said);

} // namespace vorion::splat
