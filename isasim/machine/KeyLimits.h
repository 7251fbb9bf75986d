/// Which keys keep a change of another from being seen.
#pragma once

#include "machine/ConfigKeys.h"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace vorion::isasim {

struct KeyLimit {
  const Key *By;
  /// Of what no cycle changes; empty for everything.
  std::string_view Of;
};

/// What keeps a change of \p K, which made \p After of \p Before, from being
/// seen.
std::vector<KeyLimit> limitsOf(const Key &K, const Config &Before,
                               const Config &After);

} // namespace vorion::isasim
