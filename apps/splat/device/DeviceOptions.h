/// What the Vorion device is opened with.
#pragma once

#include <map>
#include <string>

namespace vorion::splat {

/// Texts by the names of the environment's variables that the platform reads
/// (docs/debugging.md). What the command line gives goes before the
/// environment.
class DeviceOptions {
public:
  void set(std::string Variable, std::string Text) {
    CommandLine[std::move(Variable)] = std::move(Text);
  }
  /// Of the command line.
  const std::map<std::string, std::string> &commandLine() const {
    return CommandLine;
  }
  /// Of the command line, else of the environment; empty for none.
  std::string text(const std::string &Variable) const;

private:
  std::map<std::string, std::string> CommandLine;
};

} // namespace vorion::splat
