/// Children of this process: each run of a study is a process of its own, as a
/// user's is.
#pragma once

#include "device/DeviceOptions.h"
#include "vorion/support/Expected.h"

#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace vorion::splat {

/// What a child of this process did.
struct ProcessEnd {
  ExitCode Code = ExitCode::Ok;
  /// Of its processors, and of those of the children that it waited for.
  double ProcessorSeconds = 0;
};

/// The last line of \p File, a log; empty if it cannot be read.
std::string lastLine(const std::string &File);

/// Runs \p Words, of which the first is a program's path, with this process's
/// environment and \p Variables; what it prints goes to \p OutFile, what it
/// says of errors to \p LogFile, which may be the same. An Error if it cannot
/// be started or ends otherwise than by itself; \p GiveUp as below.
Expected<ProcessEnd>
runProgram(std::vector<std::string> Words,
           const std::map<std::string, std::string> &Variables,
           const std::string &OutFile, const std::string &LogFile,
           const std::function<bool()> &GiveUp = {});

/// Runs this program with \p Arguments; what it says goes to \p LogFile, whose
/// last line is in the error if it fails. \p GiveUp, if set, is asked every few
/// milliseconds whether to end it before its time, which is an error too.
Expected<ProcessEnd> runSplat(const std::vector<std::string> &Arguments,
                              const DeviceOptions &Machine,
                              const std::string &LogFile,
                              const std::function<bool()> &GiveUp = {});

/// What a run of this program reports.
struct RunReport {
  nlohmann::ordered_json Report;
  double ProcessorSeconds = 0;
};

/// The same with --json: the report of the run. Its files have names that begin
/// with \p Base; what the run prints is removed after it, unless it fails.
Expected<RunReport> runForReport(std::vector<std::string> Arguments,
                                 const DeviceOptions &Machine,
                                 const std::string &Base);

} // namespace vorion::splat
