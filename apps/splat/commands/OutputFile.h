/// Checks of output file names. claimOutputs() (vorion/support/Outputs.h)
/// checks whether a file can be written.
#pragma once

#include "page/Figures.h"
#include "vorion/support/Expected.h"

#include <CLI/CLI.hpp>

#include <string>
#include <string_view>
#include <vector>

namespace vorion::splat {

/// Checks that \p File, the value of \p Option, has one of the extensions \p
/// Endings, such as ".ply"; otherwise a usage error, which lists them. An empty
/// name, standard output, and existing files that are not regular are accepted.
Expected<Success> checkEnding(std::string_view Option, const std::string &File,
                              const std::vector<std::string_view> &Endings);

/// Sets \p File, the value of \p Option, if the user did not: to the name of \p
/// Input, a file or a folder, in the current folder and with the extension \p
/// Ending. Reports list it as if the user had set it.
void nameOutput(const char *Option, std::string &File, const std::string &Input,
                std::string_view Ending);

/// Checks that the extension of \p File, the value of --json, is not that of
/// another format.
Expected<Success> checkJsonName(const std::string &File);

/// Checks that \p Prefix, the prefix of several file names, is not itself the
/// name of a file.
Expected<Success> checkPrefix(std::string_view Option,
                              const std::string &Prefix);

/// Declares --html, with \p Help, and --figures; gives both.
std::vector<CLI::Option *> addPageOptions(CLI::App &App, PageFiles &P,
                                          const std::string &Help);

/// Declares --figures, for the page at \p Of.
CLI::Option *addFiguresOption(CLI::App &App, std::string &Folder,
                              const std::string &Of = "the page");

/// Checks the extension of --html, and that --figures can be a folder.
Expected<Success> checkPage(const PageFiles &P);

} // namespace vorion::splat
