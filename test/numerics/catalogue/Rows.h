/// Results of checks as lines of JSON in a file: a broken run goes on where it
/// stopped.
#pragma once

#include "vorion/support/Expected.h"

#include <map>
#include <nlohmann/json.hpp>
#include <string>

namespace vorion::test {

class Rows {
public:
  /// Reads what \p Path holds already; no file for an empty path.
  static Expected<Rows> open(const std::string &Path);

  /// The row of an earlier run; null if there is none.
  const nlohmann::json *find(const std::string &Key) const;
  /// Keeps \p Row under its "key".
  Expected<Success> add(const nlohmann::json &Row);
  const std::map<std::string, nlohmann::json> &all() const { return Known; }

private:
  std::string File;
  std::map<std::string, nlohmann::json> Known;
};

} // namespace vorion::test
