/// Options and helpers of the commands that run a study.
#pragma once

#include "commands/CameraArguments.h"
#include "commands/SceneArguments.h"
#include "device/DeviceOptions.h"
#include "study/Study.h"

#include <CLI/CLI.hpp>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace vorion::splat {

/// Declares the options of a study. \p What names the measured thing in the
/// help, as in "point"; \p Default is the default of --output.
void addStudyOptions(CLI::App &App, StudyOptions &S, const std::string &What,
                     const std::string &Default);

/// The views to draw: all views of the file, unless \p C names some. Two views
/// that would be stored in the same file are a usage error at \p File.
Expected<std::vector<Camera>>
studyViews(CameraArguments C, const SceneArguments &S, const std::string &File);

/// The provenance that all runs share: programs, machine and scene.
Expected<Provenance> sceneProvenance(const SceneArguments &S,
                                     const DeviceOptions &Machine);

/// The options of \p App from the one numbered \p First on.
std::vector<CLI::Option *> optionsFrom(CLI::App &App, std::size_t First);

/// Writes the results of a study into \p Folder: \p Report as the file \p Name,
/// and \p Page as its page.
Expected<Success> writeStudy(const std::string &Folder, const std::string &Name,
                             const nlohmann::ordered_json &Report,
                             const std::string &Page);

/// Writes the figures of the page that a run of a study with the options \p O
/// has left, if they are requested.
Expected<Success> writeStudyFigures(const StudyOptions &O);

/// Prints a progress line, unless progress is disabled.
void logStudy(std::string_view Line);

} // namespace vorion::splat
