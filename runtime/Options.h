/// What a device is opened with (vx_option of vorion/runtime.h).
#pragma once

#include "Failure.h"
#include "vorion/isasim/Config.h"
#include "vorion/isasim/Session.h"

#include <string>
#include <string_view>

namespace vorion::runtime {

/// Texts as the environment's variables have them; empty for what nobody asked
/// for.
struct DeviceOptions {
  std::string Config; ///< JSON, the name of a machine, or a file
  std::string Set;    ///< "KEY=VALUE,...", changes what Config says
  std::string Time;   ///< as ClockText::parse() takes it
  isasim::SessionOptions Watch;

  static DeviceOptions fromEnvironment();

  /// The text of the variable \p Name; null for one that is not ours.
  std::string *find(std::string_view Name);

  /// The machine that Config, Set and Time ask for, with a clock where Watch
  /// needs one.
  Failure machine(isasim::Config &C) const;
  /// \p E, which says what is wrong with the machine as a whole, as an error of
  /// the variables that describe it.
  Error ofMachine(Error E) const;
  /// Whether the clock goes on in profiled runs only.
  bool onlyProfiled() const;

private:
  Failure readConfig(isasim::Config &C) const;
  Failure readTime(isasim::Config &C) const;
  /// Says what of Set changes nothing.
  void noteIdle(const isasim::Config &Before,
                const isasim::Config &After) const;
};

} // namespace vorion::runtime
