/// The options of the Vorion device.
#pragma once

#include "vorion/support/ClockText.h"

#include <map>
#include <string>

namespace vorion::splat {

/// Values of environment variables that the platform reads (docs/debugging.md).
/// The command line overrides the environment.
class DeviceOptions {
public:
  /// \p Option is the command-line option; empty if there is none.
  void set(const std::string &Variable, std::string Text,
           std::string Option = "") {
    CommandLine[Variable] = std::move(Text);
    Givers[Variable] = std::move(Option);
  }
  /// The values from the command line.
  const std::map<std::string, std::string> &commandLine() const {
    return CommandLine;
  }
  /// The value from the command line or the environment; empty if there is
  /// none.
  std::string text(const std::string &Variable) const;
  /// The option that set \p Variable; empty if none did.
  std::string giver(const std::string &Variable) const;
  /// The platform's message \p Problem, "VARIABLE: what is wrong", with the
  /// name of the option that set the variable instead.
  std::string inOurWords(const std::string &Problem) const;

  /// The runs with the clock on. An invalid value is reported when the device
  /// is opened.
  ClockText::Runs clockRuns() const;

private:
  std::map<std::string, std::string> CommandLine;
  std::map<std::string, std::string> Givers; ///< option of each variable
};

} // namespace vorion::splat
