#include "commands/Commands.h"

#include "commands/OutputFile.h"
#include "doctor/Host.h"
#include "doctor/Platform.h"
#include "doctor/Variables.h"
#include "io/ReportHead.h"
#include "vorion/support/CommandLine.h"
#include "vorion/support/Diagnostics.h"
#include "vorion/support/Environment.h"
#include "vorion/support/File.h"
#include "vorion/support/Json.h"
#include "vorion/support/KernelCacheFolder.h"
#include "vorion/support/Letters.h"
#include "vorion/support/Outputs.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <fmt/format.h>
#include <iterator>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <unistd.h>
#include <utility>
#include <vector>

namespace vorion::splat {

namespace {

using Json = nlohmann::ordered_json;

Diagnoses examineAll(const DeviceOptions &Options) {
  std::vector<std::string> Environment;
  for (char **Entry = environ; *Entry; ++Entry)
    Environment.emplace_back(*Entry);
  std::ranges::sort(Environment);
  // The doctor's own kernel must not write over what somebody has measured, nor
  // wait for a debugger.
  for (const KnownVariable &K : knownVariables())
    if (K.Watches)
      unsetenv(K.Name);

  Diagnoses All;
  const auto Add = [&All](Diagnoses Found) {
    std::ranges::move(Found, std::back_inserter(All));
  };
  const Vendors Loader = examineVendors(vendorsPlace());
  const char *Root = environmentVariable("VORION_ROOT");
  Add({Loader.Found, examineTools(Root ? Root : "", Loader.Libraries)});
  if (areKernelsCached()) {
    Add(examineCache(findKernelCacheFolder()));
    Add({examineSystemCache(systemKernelCacheFolder())});
  } else {
    Add({{DiagnosisState::Note, "kernel cache",
          "disabled by POCL_KERNEL_CACHE, so every program compiles its own "
          "kernels again",
          "unset POCL_KERNEL_CACHE"}});
  }
  // A library that ends programs would end this one.
  if (Diagnoses Broken = examineLibraries(Loader.Libraries); !Broken.empty())
    Add(std::move(Broken));
  else
    Add(examineDevice(Options));
  Add(examineVariables(Environment));
  Add({examineDisk("."), examineMemory(), examineVectors()});
  return All;
}

std::string textReport(const Diagnoses &All) {
  std::string Text;
  for (const Diagnosis &F : All) {
    Text += fmt::format("{:<6} {:<13} {}\n", name(F.State), F.Subject, F.Text);
    if (!F.Fix.empty())
      Text += fmt::format("{:<6} {:<13} fix: {}\n", "", "", F.Fix);
  }
  return Text;
}

std::string jsonReport(const Diagnoses &All, bool Well) {
  Json List = Json::array();
  for (const Diagnosis &F : All)
    List.push_back({{"state", name(F.State)},
                    {"subject", F.Subject},
                    {"text", F.Text},
                    {"mend", F.Fix}});
  Json Report = reportHead("splat-doctor");
  Report.update({{"well", Well}, {"findings", std::move(List)}});
  return jsonText(Report, 2) + "\n";
}

Expected<Success> run(const std::string &JsonFile,
                      const DeviceOptions &Options) {
  if (auto Checked = checkJsonName(JsonFile); !Checked)
    return Checked;
  if (auto Claimed = claimOutputs({{"--json", JsonFile}}); !Claimed)
    return Claimed;
  const Diagnoses All = examineAll(Options);
  const auto Faults = std::ranges::count_if(
      All, [](const Diagnosis &F) { return F.State == DiagnosisState::Fault; });
  if (!JsonFile.empty())
    if (auto Written =
            writeFileAtomically(JsonFile, jsonReport(All, Faults == 0));
        !Written)
      return Written;
  printOut("{}", textReport(All));
  // In a log, too, the count stands below what is counted.
  std::fflush(stdout);
  if (Faults != 0)
    return Error{"", fmt::format("{}, expected none", counted(Faults, "fault")),
                 ExitCode::GuestFailed};
  printOut("no problem found\n");
  return Success{};
}

} // namespace

Runner addDoctor(CLI::App &App) {
  auto JsonFile = std::make_shared<std::string>();
  writesFile(App.add_option("--json", *JsonFile, "Write the report as JSON"),
             {".json"});
  return [JsonFile](const DeviceOptions &Options) {
    return run(*JsonFile, Options);
  };
}

} // namespace vorion::splat
