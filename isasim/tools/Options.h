/// The command line of vorion-sim.
#pragma once

#include "vorion/isasim/Session.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace vorion::isasim {

/// Values as they were given. An option that was not given is empty.
struct Options {
  std::string Program, ConfigText, ArgsFile;
  SessionOptions Watch;
  std::string Kernel, Global, Local, SignatureFile;
  unsigned SignatureGranularity = 4;
  std::vector<std::string> Args, Set;
  std::optional<unsigned> ClockMhz;
  bool PrintDefaultConfig = false, PrintSchema = false, ListKernels = false,
       Time = false, PrintTiming = false, PrintEnergy = false,
       PrintTechnology = false;
  bool Energy = false;
  std::string TechnologyFile;
  std::optional<double> Volts;
  bool OneHart = false;
};

/// Declares all options of \p App, and its program, which go to \p O.
void declareOptions(CLI::App &App, Options &O);

/// Arguments that begin with a plus are options too, as test frameworks write
/// them: +signature=FILE is --signature=FILE.
std::vector<std::string> argumentsOf(int Argc, char **Argv);

} // namespace vorion::isasim
