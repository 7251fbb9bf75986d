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
  void give(std::string Variable, std::string Text) {
    Given[std::move(Variable)] = std::move(Text);
  }
  /// Of the command line.
  const std::map<std::string, std::string> &given() const { return Given; }
  /// Of the command line, else of the environment; empty for none.
  std::string text(const std::string &Variable) const;

private:
  std::map<std::string, std::string> Given;
};

} // namespace vorion::splat
