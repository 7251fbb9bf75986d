/// What a run was of, for reports: two times are only compared if they are of
/// the same work.
#pragma once

#include "vorion/isasim/Session.h"

#include <cstdint>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace vorion::isasim {

class Image;
class Machine;

class LaunchRecord {
public:
  /// Of the next run alone.
  void setGiven(std::vector<GivenMemory> GivenIn) {
    Given = std::move(GivenIn);
  }

  /// {"program_fnv1a64": of the loaded image's file, and, with a launch block
  /// at \p LaunchBlock, "global", "local", "arguments": [{"name", and "value"
  /// or "kind", "bytes", "contents" (a hash) as far as they are known}]}.
  nlohmann::ordered_json take(const Machine &M, const std::string &Kernel,
                              uint32_t LaunchBlock);

private:
  const std::string &hashOf(const std::shared_ptr<const Image> &Program);

  std::vector<GivenMemory> Given;
  std::shared_ptr<const Image> Hashed; ///< whose hash is known
  std::string Hash;
};

} // namespace vorion::isasim
