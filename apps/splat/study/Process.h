/// Child processes: each run of a study is a separate process, as if started by
/// a user.
#pragma once

#include "device/DeviceOptions.h"
#include "vorion/support/Expected.h"

#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace vorion::splat {

/// The result of a child process.
struct ProcessEnd {
  ExitCode Code = ExitCode::Ok;
  /// Processor seconds of the child and of its children that it waited for.
  double ProcessorSeconds = 0;
};

/// The last line of \p File, a log; empty if it cannot be read.
std::string lastLine(const std::string &File);

/// The path of the program \p Name that PATH has, which is Debian's package of
/// the same name. \p What it is for is in the error if there is none.
Expected<std::string> findProgram(const std::string &Name,
                                  std::string_view What);

/// Runs the command \p Words, whose first element is the path of a program,
/// with this process's environment and \p Variables. Standard output goes to \p
/// OutFile, standard error to \p LogFile, which may be the same. A signal that
/// ends this process ends it and what it started, too (runTool()). An Error if
/// it cannot be started or is terminated by a signal; \p GiveUp as below.
Expected<ProcessEnd>
runProgram(std::vector<std::string> Words,
           const std::map<std::string, std::string> &Variables,
           const std::string &OutFile, const std::string &LogFile,
           const std::function<bool()> &GiveUp = {});

/// Runs this program with \p Arguments. Its output goes to \p LogFile, whose
/// last line is in the error if it fails. \p GiveUp, if set, is polled every
/// few milliseconds; if it returns true, the child is terminated, which is an
/// error, too.
Expected<ProcessEnd> runSplat(const std::vector<std::string> &Arguments,
                              const DeviceOptions &Machine,
                              const std::string &LogFile,
                              const std::function<bool()> &GiveUp = {});

/// The report of a run of this program.
struct RunReport {
  nlohmann::ordered_json Report;
  double ProcessorSeconds = 0;
};

/// The same with --json; returns the report of the run. \p Base is the prefix
/// of its files. The output is deleted unless the run fails.
Expected<RunReport> runForReport(std::vector<std::string> Arguments,
                                 const DeviceOptions &Machine,
                                 const std::string &Base);

} // namespace vorion::splat
