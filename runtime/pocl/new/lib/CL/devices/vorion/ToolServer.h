/// The compiler and the linker as processes that stay: of the time for a small
/// kernel most is their start (docs/backend.md, "Cost").
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace vorion {

/// What a call gave.
struct ToolAnswer {
  int Code = 0;
  std::string Printed;
};

/// Calls \p Tool, a file, with \p Arguments in a process that serves calls: one
/// that is idle, or a new one. Nothing if that does not work, for whatever
/// reason; then the call is to be made in a process of its own.
std::optional<ToolAnswer>
askToolServer(const std::string &Tool,
              const std::vector<std::string> &Arguments);

} // namespace vorion
