/// Options of all subcommands that use a device.
#pragma once

#include "device/Launcher.h"
#include "picture/Options.h"

#include <CLI/CLI.hpp>
#include <optional>
#include <string>

namespace vorion::splat {

/// Declares --device; \p Name must outlive the parsing.
void addDeviceOption(CLI::App &App, std::string &Name);

/// Declares --kernels; \p Folder must outlive the parsing.
void addKernelsOption(CLI::App &App, std::string &Folder);

/// Checks that \p D supports the path \p Blending; otherwise a usage error.
Expected<Success> checkBlends(const Device &D, Path Blending);

/// Opens the device \p Name; an error if it does not support the path \p
/// Blending.
Expected<Device> openDevice(const std::string &Name, Path Blending,
                            const DeviceOptions &Options);

/// Enables the clock, at \p Mhz if given, otherwise at the frequency of
/// VORION_TIME or of the machine. \p By is the option that needs the clock.
void turnClockOn(DeviceOptions &Options, std::optional<unsigned> Mhz,
                 const std::string &By);

/// Prints the build log of a program that failed to compile.
void showBuildLog(const Launcher &L);

} // namespace vorion::splat
