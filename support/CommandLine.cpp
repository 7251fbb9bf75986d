#include "vorion/support/CommandLine.h"

#include "vorion/support/Diagnostics.h"
#include "vorion/support/Suggest.h"

#include <algorithm>
#include <fmt/format.h>

namespace vorion {
namespace {

constexpr std::string_view SeeHelp = "expected: see --help";

/// The names of \p App's options and of those that it falls through to.
std::vector<std::string> optionsOf(const CLI::App *App) {
  std::vector<std::string> Names;
  for (; App; App = App->get_parent())
    for (const CLI::Option *O : App->get_options())
      for (const std::string &Name : O->get_lnames())
        Names.push_back("--" + Name);
  return Names;
}

std::vector<std::string> subcommandsOf(const CLI::App &App) {
  std::vector<std::string> Names;
  for (const CLI::App *Command : App.get_subcommands({}))
    Names.push_back(Command->get_name());
  return Names;
}

std::string unknown(std::string_view What, std::string_view Word,
                    const std::vector<std::string> &Known) {
  const std::string_view Meant = closestTo(Word, Known);
  return fmt::format("unknown {} {}, {}", What, Word,
                     Meant.empty()
                         ? std::string(SeeHelp)
                         : fmt::format("did you mean {}? (see --help)", Meant));
}

/// What is wrong, of \p App that refused its arguments with \p Said: a word
/// that nobody knows is told rather than what is missing without it.
std::string problemOf(const CLI::App &App, const std::string &Said) {
  const CLI::App *Inner = &App;
  while (!Inner->get_subcommands().empty())
    Inner = Inner->get_subcommands().front();
  const std::vector<std::string> Left = App.remaining(/*recurse=*/true);
  const std::vector<std::string> Commands = subcommandsOf(*Inner);
  if (!Left.empty() && !Left.front().starts_with('-') && !Commands.empty())
    return unknown("subcommand", Left.front(), Commands);
  const auto Option = std::ranges::find_if(Left, [](const std::string &Word) {
    return Word.size() > 1 && Word.starts_with('-');
  });
  if (Option != Left.end())
    return unknown("option", Option->substr(0, Option->find('=')),
                   optionsOf(Inner));
  return fmt::format("{}, {}", Said, SeeHelp);
}

} // namespace

std::optional<int> parseCommandLine(CLI::App &App,
                                    std::vector<std::string> Arguments) {
  std::ranges::reverse(Arguments); // CLI11 takes them from the end
  try {
    App.parse(std::move(Arguments));
  } catch (const CLI::Success &E) {
    return App.exit(E); // --help
  } catch (const CLI::ParseError &E) {
    return reportError(App.get_name(),
                       {"", problemOf(App, E.what()), ExitCode::Usage});
  }
  return std::nullopt;
}

Expected<Success> parseOptions(CLI::App &App,
                               std::vector<std::string> Arguments) {
  std::ranges::reverse(Arguments);
  try {
    App.parse(std::move(Arguments));
  } catch (const CLI::ParseError &E) {
    return Error{"", problemOf(App, E.what()), ExitCode::Usage};
  }
  return Success{};
}

} // namespace vorion
