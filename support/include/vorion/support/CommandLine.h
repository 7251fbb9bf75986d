/// The command lines of the tools that use CLI11.
#pragma once

#include "vorion/support/Expected.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

namespace vorion {

/// Parses \p Arguments, without the program's name, by \p App, whose name is
/// the tool's. The exit code if that was all, for help and for what the parser
/// refuses: that is said in the house form, with what was probably meant. The
/// one argument --print-definition, which no help lists, prints definitionOf().
/// Values that are empty are refused, as of --json "$UNSET", and numbers that
/// are NaN, or that single precision takes for 0 or infinite. "help" and "help
/// COMMAND" are --help, of an \p App that has subcommands.
std::optional<int> parseCommandLine(CLI::App &App,
                                    std::vector<std::string> Arguments);

/// The same for options that come from elsewhere than a command line: prints
/// nothing. \p App has no help.
Expected<Success> parseOptions(CLI::App &App,
                               std::vector<std::string> Arguments);

/// A check that takes one of \p Names; of another value it says which was
/// probably meant.
CLI::Validator isOneOf(std::vector<std::string> Names);

/// A check that takes numbers from \p Low to \p High, both included. Help shows
/// what CLI::Range shows, whose messages differ between versions of CLI11.
template <typename Number> CLI::Validator isBetween(Number Low, Number High) {
  CLI::Validator Check = CLI::Range(Low, High);
  Check.operation([Low, High](const std::string &Word) {
    Number Value{};
    return CLI::detail::lexical_cast(Word, Value) && Value >= Low &&
                   Value <= High
               ? std::string()
               : fmt::format("{}, expected a {}number from {} to {}", Word,
                             std::is_integral_v<Number> ? "whole " : "", Low,
                             High);
  });
  return Check;
}

/// Seeds of random numbers are 0 to this: text that begins with a minus would
/// be taken for a large one.
inline constexpr uint64_t MostSeed = 1'000'000'000'000'000'000;

/// Says that the value of \p O names a file, with one of \p Endings if there
/// are some, or a folder: for --help, and for shells that complete names. Each
/// is there and is read, or is written by the tool.
CLI::Option *takesFile(CLI::Option *O,
                       const std::vector<std::string> &Endings = {});
/// The same of a value that may also be one of \p Names; endings begin with a
/// dot, names do not.
CLI::Option *takesNameOrFile(CLI::Option *O, std::vector<std::string> Names,
                             const std::vector<std::string> &Endings);
CLI::Option *takesFolder(CLI::Option *O);
CLI::Option *writesFile(CLI::Option *O,
                        const std::vector<std::string> &Endings = {});
CLI::Option *writesFolder(CLI::Option *O);
/// The same of a value with which the names of several files begin.
CLI::Option *writesFiles(CLI::Option *O);

/// Says that the value of \p O is one of \p Names or several with commas
/// between them, or something else that the option's help explains.
CLI::Option *takesSomeOf(CLI::Option *O, const std::vector<std::string> &Names);

/// Says that the value of \p O is the name of a view in a file of cameras, or
/// several with commas between them if the option has a delimiter; or one of
/// \p Others.
CLI::Option *takesView(CLI::Option *O,
                       const std::vector<std::string> &Others = {});

/// What was said of an option's value by the above.
struct OptionValue {
  enum class Type { Any, OneOf, SomeOf, View, File, Folder, Prefix };
  Type What = Type::Any;
  std::vector<std::string> Words; ///< names, or endings of files
  std::vector<std::string> Names; ///< that may stand in place of a file
  bool IsWritten = false;         ///< a file, a folder or files
};
OptionValue valueOf(const CLI::Option &O);

/// The options of \p App that write files, each by all its names as they are
/// written on a command line.
std::vector<std::string> writingOptions(const CLI::App &App);

/// The subcommand of \p App that \p Arguments, without the program's name,
/// call; null if they call none.
const CLI::App *calledCommand(const CLI::App &App,
                              const std::vector<std::string> &Arguments);

} // namespace vorion
