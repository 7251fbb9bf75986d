/// What every subcommand that works on a device takes.
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

/// Whether \p D can blend by \p Blending; an error is one of usage.
Expected<Success> checkBlends(const Device &D, Path Blending);

/// Opens the device that \p Name asks for; an error where it cannot blend by
/// \p Blending.
Expected<Device> openDevice(const std::string &Name, Path Blending,
                            const DeviceOptions &Options);

/// Turns the machine's clock on, at \p Mhz if they are given: else it stays
/// what VORION_TIME says, or the machine's. \p By: the option that asks for it
/// without a clock.
void turnClockOn(DeviceOptions &Options, std::optional<unsigned> Mhz,
                 const std::string &By);

/// Shows what the compiler said of a program that failed to build.
void showBuildLog(const Launcher &L);

} // namespace vorion::splat
