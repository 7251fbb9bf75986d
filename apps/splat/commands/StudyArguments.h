/// What commands share that measure by many runs of this program.
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

/// Declares options that say how a study is done. \p What is what is measured:
/// "point"; \p Default names the folder without --out.
void addStudyOptions(CLI::App &App, StudyOptions &S, const std::string &What,
                     const std::string &Default);

/// The views to draw: all of the file, unless \p C names some. An Error of
/// usage, at \p File, where two of them would be kept as one file.
Expected<std::vector<Camera>>
studyViews(CameraArguments C, const SceneArguments &S, const std::string &File);

/// What every run is made from: programs, machine and scene.
Expected<Provenance> sceneProvenance(const SceneArguments &S,
                                     const DeviceOptions &Machine);

/// The options of \p App from the one numbered \p First on.
std::vector<CLI::Option *> optionsFrom(CLI::App &App, std::size_t First);

/// Writes what a study found: \p Report as the file \p Name of \p Folder, and
/// \p Page as its page.
Expected<Success> writeStudy(const std::string &Folder, const std::string &Name,
                             const nlohmann::ordered_json &Report,
                             const std::string &Page);

/// A line about a run that is done, unless progress is hidden.
void logStudy(std::string_view Line);

} // namespace vorion::splat
