/// The subcommands of `splat`: each declares its options and gives what runs
/// it once they are parsed.
#pragma once

#include "device/DeviceOptions.h"
#include "vorion/support/Expected.h"

#include <CLI/CLI.hpp>
#include <functional>

namespace vorion::splat {

/// Takes what the command line says of the device for all subcommands.
using Runner = std::function<Expected<Success>(const DeviceOptions &)>;

Runner addRender(CLI::App &App);
Runner addGradients(CLI::App &App);
Runner addAnalyze(CLI::App &App);
Runner addInfo(CLI::App &App);
Runner addConvert(CLI::App &App);
Runner addDemoScene(CLI::App &App);
Runner addAccuracy(CLI::App &App);
Runner addExplore(CLI::App &App);
Runner addEffects(CLI::App &App);
Runner addTrain(CLI::App &App);
Runner addEval(CLI::App &App);
Runner addCompare(CLI::App &App);
Runner addView(CLI::App &App);
/// Runs again what made a report, and says whether it is the same.
Runner addReplay(CLI::App &App);
/// Looks at what programs need to run here; a fault is an Error (GuestFailed),
/// given after all is said.
Runner addDoctor(CLI::App &App);

} // namespace vorion::splat
