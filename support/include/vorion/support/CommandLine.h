/// The command lines of the tools that use CLI11.
#pragma once

#include "vorion/support/Expected.h"

#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <vector>

namespace vorion {

/// Parses \p Arguments, without the program's name, by \p App, whose name is
/// the tool's. The exit code if that was all, for help and for what the parser
/// refuses: that is said in the house form, with what was probably meant.
std::optional<int> parseCommandLine(CLI::App &App,
                                    std::vector<std::string> Arguments);

/// The same for options that come from elsewhere than a command line: prints
/// nothing. \p App has no help.
Expected<Success> parseOptions(CLI::App &App,
                               std::vector<std::string> Arguments);

/// A check that takes one of \p Names; of another value it says which was
/// probably meant.
CLI::Validator isOneOf(std::vector<std::string> Names);

/// Says that the value of \p O names a file, with one of \p Endings if there
/// are some, or a folder: for --help and for shells that complete names.
CLI::Option *takesFile(CLI::Option *O,
                       const std::vector<std::string> &Endings = {});
CLI::Option *takesFolder(CLI::Option *O);

/// What was said of an option's value by the above.
struct OptionValue {
  enum class Type { Any, OneOf, File, Folder };
  Type What = Type::Any;
  std::vector<std::string> Words; ///< names, or endings of files
};
OptionValue valueOf(CLI::Option &O);

} // namespace vorion
