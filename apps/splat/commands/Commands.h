/// The subcommands of `splat`. Each function declares the options of a
/// subcommand and returns the function that executes it after parsing.
#pragma once

#include "device/DeviceOptions.h"
#include "vorion/support/Expected.h"

#include <CLI/CLI.hpp>
#include <functional>

namespace vorion::splat {

/// Executes a subcommand with the device options that all subcommands share.
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
/// Makes a capture from photographs or a video.
Runner addCapture(CLI::App &App);
Runner addCompare(CLI::App &App);
Runner addView(CLI::App &App);
/// Repeats the command of a report, and compares the results.
Runner addReplay(CLI::App &App);
/// Checks the requirements of programs on this host. A fault is an Error
/// (GuestFailed), returned after all checks are printed.
Runner addDoctor(CLI::App &App);

} // namespace vorion::splat
