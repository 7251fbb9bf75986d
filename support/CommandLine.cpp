#include "vorion/support/CommandLine.h"

#include "vorion/support/Diagnostics.h"
#include "vorion/support/Suggest.h"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <utility>

namespace vorion {
namespace {

constexpr std::string_view SeeHelp = "expected: see --help";

/// Names of the checks by which valueOf() knows them.
constexpr const char *OneOfName = "one of", *FileName = "file",
                     *FolderName = "folder";

/// Takes everything; \p Name and \p Words are what it is for. CLI11 keeps
/// nothing of a check but its name.
CLI::Validator mark(const char *Name, const std::vector<std::string> &Words) {
  return {[](std::string &) { return std::string(); }, "",
          fmt::format("{} {}", Name, fmt::join(Words, "|"))};
}

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
  // A check of ours says itself what it expects.
  return Said.find("expected") == std::string::npos
             ? fmt::format("{}, {}", Said, SeeHelp)
             : Said;
}

} // namespace

CLI::Validator isOneOf(std::vector<std::string> Names) {
  CLI::Validator Check = mark(OneOfName, Names);
  Check.operation([Names = std::move(Names)](const std::string &Word) {
    return std::ranges::find(Names, Word) != Names.end()
               ? std::string()
               : fmt::format("{} is not known, expected one of {}{}", Word,
                             fmt::join(Names, ", "), didYouMean(Word, Names));
  });
  return Check;
}

CLI::Option *takesFile(CLI::Option *O,
                       const std::vector<std::string> &Endings) {
  return O->type_name("FILE")->check(mark(FileName, Endings));
}

CLI::Option *takesFolder(CLI::Option *O) {
  return O->type_name("FOLDER")->check(mark(FolderName, {}));
}

OptionValue valueOf(CLI::Option &O) {
  using Type = OptionValue::Type;
  constexpr std::pair<const char *, Type> Kinds[] = {
      {OneOfName, Type::OneOf},
      {FileName, Type::File},
      {FolderName, Type::Folder}};
  // There is no way to ask how many checks an option has.
  constexpr int MostChecks = 4;
  for (int I = 0; I < MostChecks; ++I) {
    std::string Name;
    try {
      Name = O.get_validator(I)->get_name();
    } catch (const CLI::OptionNotFound &) {
      break;
    }
    for (const auto &[Begin, What] : Kinds)
      if (Name.starts_with(Begin)) {
        OptionValue V{What, {}};
        std::string_view Rest(Name);
        Rest.remove_prefix(std::string_view(Begin).size() + 1);
        for (std::size_t At = 0; !Rest.empty() && At != std::string_view::npos;
             Rest.remove_prefix(At == std::string_view::npos ? 0 : At + 1)) {
          At = Rest.find('|');
          V.Words.emplace_back(Rest.substr(0, At));
        }
        return V;
      }
  }
  return {};
}

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
