/// What the Vorion device is opened with.
#pragma once

#include "vorion/support/ClockText.h"

#include <map>
#include <string>

namespace vorion::splat {

/// Texts by the names of the environment's variables that the platform reads
/// (docs/debugging.md). What the command line gives goes before the
/// environment.
class DeviceOptions {
public:
  /// \p Option is the option that says so; empty if none does.
  void set(const std::string &Variable, std::string Text,
           std::string Option = "") {
    CommandLine[Variable] = std::move(Text);
    Givers[Variable] = std::move(Option);
  }
  /// Of the command line.
  const std::map<std::string, std::string> &commandLine() const {
    return CommandLine;
  }
  /// Of the command line, else of the environment; empty for none.
  std::string text(const std::string &Variable) const;
  /// The option that gave \p Variable its text; empty if none did.
  std::string giver(const std::string &Variable) const;
  /// \p Problem, of which the platform says "VARIABLE: what is wrong", as one
  /// of the option that gave the variable its text.
  std::string inOurWords(const std::string &Problem) const;

  /// When the machine's clock runs; what is wrong with the text is told when
  /// the device is opened.
  ClockText::Runs clockRuns() const;

private:
  std::map<std::string, std::string> CommandLine;
  std::map<std::string, std::string> Givers; ///< options by variables
};

} // namespace vorion::splat
