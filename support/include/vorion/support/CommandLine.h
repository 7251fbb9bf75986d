/// Command-line parsing for the tools that use CLI11.
#pragma once

#include "vorion/support/Expected.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

namespace vorion {

/// Parses \p Arguments, without the program's name, with \p App, which has the
/// name of the tool. Returns an exit code after help and after errors, which
/// are printed in the project's format with a suggestion. Without arguments, a
/// tool that has subcommands prints its help. The hidden option
/// --print-definition prints definitionOf(). Empty values (--json "$UNSET") are
/// rejected, and so are numbers that are NaN, or are 0 or infinite in single
/// precision. "help" and "help COMMAND" are synonyms of --help if \p App has
/// subcommands.
std::optional<int> parseCommandLine(CLI::App &App,
                                    std::vector<std::string> Arguments);

/// The same for options that are not from a command line: prints nothing. \p
/// App has no help.
Expected<Success> parseOptions(CLI::App &App,
                               std::vector<std::string> Arguments);

/// A validator that accepts one of \p Names; its error has a suggestion.
CLI::Validator isOneOf(std::vector<std::string> Names);

/// A validator that accepts numbers from \p Low to \p High, inclusive. Used in
/// place of CLI::Range, whose messages differ between versions of CLI11.
template <typename Number> CLI::Validator isBetween(Number Low, Number High) {
  CLI::Validator Check = CLI::Range(Low, High);
  // A bound that nobody comes to says nothing.
  Check.description(
      static_cast<double>(High) > 1e12 ? "" : fmt::format("{}..{}", Low, High));
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

/// Maximum seed of random numbers. Larger values are rejected because a
/// negative number would be parsed as one.
inline constexpr uint64_t MostSeed = 1'000'000'000'000'000'000;

/// Declares that the value of \p O is the name of a file, with one of the
/// extensions \p Endings if there are any, or of a folder: for --help and shell
/// completion. It is read and exists, or is written by the tool.
CLI::Option *takesFile(CLI::Option *O,
                       const std::vector<std::string> &Endings = {});
/// The same for a value that may also be one of \p Names; extensions begin with
/// a dot, names do not.
CLI::Option *takesNameOrFile(CLI::Option *O, std::vector<std::string> Names,
                             const std::vector<std::string> &Endings);
CLI::Option *takesFolder(CLI::Option *O);
CLI::Option *writesFile(CLI::Option *O,
                        const std::vector<std::string> &Endings = {});
CLI::Option *writesFolder(CLI::Option *O);
/// The same for a value that is a prefix of several file names.
CLI::Option *writesFiles(CLI::Option *O);

/// Declares that the value of \p O is a comma-separated list of \p Names, or
/// another value that the option's help explains.
CLI::Option *takesSomeOf(CLI::Option *O, const std::vector<std::string> &Names);

/// Declares that the value of \p O is the name of a view in a camera file, or a
/// comma-separated list if the option has a delimiter; or one of \p Others.
CLI::Option *takesView(CLI::Option *O,
                       const std::vector<std::string> &Others = {});

/// The declaration of an option's value by the functions above.
struct OptionValue {
  enum class Type { Any, OneOf, SomeOf, View, File, Folder, Prefix };
  Type What = Type::Any;
  std::vector<std::string> Words; ///< names, or endings of files
  std::vector<std::string> Names; ///< that may stand in place of a file
  bool IsWritten = false;         ///< a file, a folder or files
};
OptionValue valueOf(const CLI::Option &O);

/// The value of \p O in --help and in definitions: what it is called, and the
/// range that isBetween() checks, as "1..64"; empty for none.
struct ValueText {
  std::string Name, Range;
};
ValueText textOf(const CLI::Option &O);

/// Headings of --help: options that are declared while this object lives are
/// under its heading, but for those that have one already.
class HelpGroup {
public:
  HelpGroup(CLI::App &App, std::string Title);
  ~HelpGroup();
  HelpGroup(const HelpGroup &) = delete;
  HelpGroup &operator=(const HelpGroup &) = delete;
  /// Those that follow are under \p Title.
  void next(std::string Title);

private:
  CLI::App &App;
  std::string Title;
  std::size_t First; ///< option, by number
};

/// The options of \p App that write files, with all their names.
std::vector<std::string> writingOptions(const CLI::App &App);

/// The subcommand of \p App in \p Arguments, which exclude the program's name;
/// null if there is none.
const CLI::App *calledCommand(const CLI::App &App,
                              const std::vector<std::string> &Arguments);

} // namespace vorion
