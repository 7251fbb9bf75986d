/// Runs a program of one warp under checkers.
#pragma once

#include "observe/check/Checkers.h"
#include "testing/WarpRunner.h"

namespace vorion::isasim::testing {

/// What the checkers \p Names say of \p Words, which all 16 lanes execute.
inline std::vector<std::string> reportsOf(std::string_view Names,
                                          const std::vector<uint32_t> &Words) {
  std::vector<std::string> Reports;
  const auto Checks = Checkers::create(
      Names, [&](std::string_view Text) { Reports.emplace_back(Text); });
  EXPECT_TRUE(Checks) << Checks.error().What;
  WarpRunner Runner(execTable(true), Words);
  Runner.Watcher.Observers = (*Checks)->observers();
  Runner.Watcher.tell([&](Observer &O) {
    O.runBegins({.Shape = Runner.Shape,
                 .Program = Runner.Program,
                 .LaunchBlock = 0,
                 .Launch = nullptr,
                 .Cores = {},
                 .Device = nullptr,
                 .StackBytes = Runner.Shape.StackBytes,
                 .Stacks = stackBytes(Runner.Shape)});
  });
  Runner.run();
  return Reports;
}

} // namespace vorion::isasim::testing
