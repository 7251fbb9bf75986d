#include "commands/DeviceArguments.h"
#include "vorion/support/CommandLine.h"
#include "vorion/support/Diagnostics.h"

#include <fmt/format.h>

namespace vorion::splat {

void addDeviceOption(CLI::App &App, std::string &Name) {
  const HelpGroup Group(App, "Device and kernels");
  App.add_option("--device", Name,
                 "Substring of the OpenCL device's name (default Vorion, else "
                 "the first device)");
}

void addKernelsOption(CLI::App &App, std::string &Folder) {
  const HelpGroup Group(App, "Device and kernels");
  takesFolder(App.add_option("--kernels", Folder,
                             "Read the kernel sources from this folder"));
}

Expected<Success> checkBlends(const Device &D, Path Blending) {
  if (Blending == Path::Raster && !D.isVorion())
    return Error{"",
                 fmt::format("{} has no rasterizer, expected a Vorion device "
                             "{} or --path simt",
                             D.name(), SeeDoctor),
                 ExitCode::Usage};
  return Success{};
}

Expected<Device> openDevice(const std::string &Name, Path Blending,
                            const DeviceOptions &Options) {
  auto D = Device::open(Name, Options);
  if (D)
    if (auto Checked = checkBlends(*D, Blending); !Checked)
      return Checked.error();
  return D;
}

void turnClockOn(DeviceOptions &Options, std::optional<unsigned> Mhz,
                 const std::string &By) {
  if (Mhz)
    Options.set("VORION_TIME", ClockText::ofMhz(*Mhz), "--clock");
  else if (Options.text("VORION_TIME").empty() ||
           Options.clockRuns() == ClockText::Runs::Never ||
           Options.clockRuns() == ClockText::Runs::Profiled)
    Options.set("VORION_TIME", "on", By);
}

void showBuildLog(const Launcher &L) {
  if (!L.buildLog().empty())
    printNote(L.buildLog() + "\n");
}

} // namespace vorion::splat
