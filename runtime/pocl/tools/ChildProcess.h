/// Programs that vorion-clang runs, which end when it is ended.
#pragma once

#include <string>
#include <vector>

namespace vorion {

struct Ran {
  bool Succeeded = false;
  /// The signal that ended it, or 0.
  int Signal = 0;
  /// Standard output and standard error as they came.
  std::string Output;
};

/// Runs the program that \p Arguments begins with, and waits for its end.
/// Starts nothing once this process was asked to end.
Ran runChild(const std::vector<std::string> &Arguments);

/// From here on SIGHUP, SIGINT and SIGTERM end the running child instead of
/// this process, so that temporary folders go; endIfAsked does the rest. What
/// the caller ignores, as nohup does, stays ignored.
void passEndsToChildren();

/// Whether one of these signals came.
bool isEnding();

/// Ends this process by the signal that came, if one came.
void endIfAsked();

} // namespace vorion
