#include "vorion/support/CommandLine.h"

#include "vorion/support/Definition.h"
#include "vorion/support/Diagnostics.h"
#include "vorion/support/HelpText.h"
#include "vorion/support/Letters.h"
#include "vorion/support/Suggest.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <limits>
#include <memory>
#include <sstream>
#include <utility>

namespace vorion {
namespace {

constexpr std::string_view SeeHelp = "(see --help)";

/// How the name of a check begins that is a mark, and what it says.
struct Mark {
  std::string_view Begin;
  OptionValue::Type What;
  bool IsWritten = false;
};
constexpr Mark OneOf{"one of", OptionValue::Type::OneOf},
    SomeOf{"some of", OptionValue::Type::SomeOf},
    View{"view", OptionValue::Type::View},
    FileIn{"file", OptionValue::Type::File},
    FolderIn{"folder", OptionValue::Type::Folder},
    FileOut{"output file", OptionValue::Type::File, true},
    FolderOut{"output folder", OptionValue::Type::Folder, true},
    FilesOut{"output files", OptionValue::Type::Prefix, true};
constexpr const Mark *Marks[] = {&OneOf,    &SomeOf,  &View,      &FileIn,
                                 &FolderIn, &FileOut, &FolderOut, &FilesOut};

/// Takes everything; \p M and \p Words are what it is for. CLI11 keeps
/// nothing of a check but its name.
CLI::Validator check(const Mark &M,
                     const std::vector<std::string> &Words = {}) {
  return {[](std::string &) { return std::string(); }, "",
          fmt::format("{}|{}", M.Begin, fmt::join(Words, "|"))};
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
  return fmt::format(
      "unknown {} {}{} {}", What, Word,
      Meant.empty() ? "" : fmt::format(", did you mean {}?", Meant), SeeHelp);
}

/// What must be given to \p App: "tool render scene --output FILE".
std::string shortestCall(const CLI::App &App) {
  std::string Call = App.get_name();
  for (const CLI::App *Outer = App.get_parent(); Outer;
       Outer = Outer->get_parent())
    Call.insert(0, Outer->get_name() + " ");
  for (const bool Positional : {true, false})
    for (const CLI::Option *O : App.get_options())
      if (O->get_required() && O->get_positional() == Positional)
        Call += Positional
                    ? " " + upperCase(O->get_name())
                    : fmt::format(" {} {}", O->get_name(), textOf(*O).Name);
  return Call;
}

/// What \p O takes, as help has it: "N (1..64)".
std::string kindOf(const CLI::Option &O) {
  const ValueText Text = textOf(O);
  return Text.Range.empty() ? Text.Name
                            : fmt::format("{} ({})", Text.Name, Text.Range);
}

/// --help on few screens: CLI11's usual page names exclusions and checks behind
/// every option, which no screen is wide enough for.
class HelpFormatter : public CLI::Formatter {
public:
  HelpFormatter() { column_width(32); }

  /// What it takes alone.
  std::string make_option_opts(const CLI::Option *O) const override {
    const std::string Kind = kindOf(*O);
    const std::string Required = O->get_required() && !O->get_positional()
                                     ? " " + get_label("REQUIRED")
                                     : "";
    return (Kind.empty() || Kind.starts_with('[') ? Kind : " " + Kind) +
           Required;
  }
  /// One empty line between groups, not two.
  std::string make_group(std::string Group, bool IsPositional,
                         std::vector<const CLI::Option *> Of) const override {
    return CLI::Formatter::make_group(std::move(Group), IsPositional,
                                      std::move(Of))
        .substr(IsPositional ? 0 : 1);
  }
  /// Without the value that stands for none, {-}.
  std::string make_option_name(const CLI::Option *O,
                               bool IsPositional) const override {
    const std::string Name =
        O->get_name(/*positional=*/IsPositional, /*all_options=*/!IsPositional);
    return Name.substr(0, Name.find('{'));
  }
};

void format(CLI::App &App, const std::shared_ptr<HelpFormatter> &By) {
  App.formatter(By);
  for (CLI::App *Command : App.get_subcommands({}))
    format(*Command, By);
}

std::string emptyValueOf(const CLI::Option &O) {
  return fmt::format("{}: an empty value, expected {} {}",
                     O.get_positional() ? upperCase(O.get_name())
                                        : O.get_name(),
                     kindOf(O), SeeHelp);
}

using ValueCheck = std::optional<std::string>(const CLI::Option &,
                                              const std::string &Word);

/// "$UNSET" on a command line is an empty value, which CLI11 takes for none or
/// for 0.
std::optional<std::string> ifEmpty(const CLI::Option &O,
                                   const std::string &Word) {
  if (!Word.empty())
    return std::nullopt;
  return emptyValueOf(O);
}

std::optional<std::string> ifNaN(const CLI::Option &O,
                                 const std::string &Word) {
  double Value = 0;
  if (!O.get_type_name().starts_with(CLI::detail::type_name<double>()) ||
      !CLI::detail::lexical_cast(Word, Value) || !std::isnan(Value))
    return std::nullopt;
  return fmt::format("{}: {}, expected a number {}", O.get_name(), Word,
                     SeeHelp);
}

/// Numbers are computed with in single precision: one that is 0 or infinite
/// there would be another than was asked for.
std::optional<std::string> ifNoFloat(const CLI::Option &O,
                                     const std::string &Word) {
  long double Value = 0;
  if (!O.get_type_name().starts_with(CLI::detail::type_name<float>()) ||
      !CLI::detail::lexical_cast(Word, Value))
    return std::nullopt;
  const bool SaysInfinite = Word.find_first_of("nN") != std::string::npos;
  const bool IsInfinite =
      !SaysInfinite && std::isinf(static_cast<float>(Value));
  // Of a number that is 0 in any precision, no digit before the exponent is
  // another.
  const bool IsZero =
      !SaysInfinite && static_cast<float>(Value) == 0 &&
      Word.substr(0, Word.find_first_of("eEpP")).find_first_of("123456789") !=
          std::string::npos;
  if (!IsInfinite && !IsZero)
    return std::nullopt;
  return fmt::format("{}: {} is {} in single precision, expected {}a size "
                     "from {:.2g} to {:.2g} {}",
                     O.get_name(), Word, IsZero ? "0" : "infinite",
                     IsZero ? "0 or " : "",
                     std::numeric_limits<float>::denorm_min(),
                     std::numeric_limits<float>::max(), SeeHelp);
}

/// What \p Check says of the first value that it refuses, of those that \p App
/// and its called commands got.
std::optional<std::string> firstWrong(const CLI::App &App, ValueCheck *Check) {
  for (const CLI::Option *O : App.get_options())
    if (O->get_items_expected_min() > 0) // no flag, whose value may be left out
      for (const std::string &Word : O->results())
        if (auto Wrong = Check(*O, Word))
          return Wrong;
  for (const CLI::App *Command : App.get_subcommands())
    if (auto Wrong = firstWrong(*Command, Check))
      return Wrong;
  return std::nullopt;
}

/// What is wrong if \p Arguments have an option as "--json=", whose value CLI11
/// takes to be the next argument.
std::optional<std::string>
wrongEnding(const CLI::App &App, const std::vector<std::string> &Arguments) {
  const CLI::App *Called = calledCommand(App, Arguments);
  for (const std::string &Word : Arguments) {
    if (Word == "--")
      break;
    if (!Word.starts_with("--") || Word.find('=') != Word.size() - 1)
      continue;
    const std::string Name = Word.substr(0, Word.size() - 1);
    const CLI::Option *O = Called ? Called->get_option_no_throw(Name) : nullptr;
    if (!O)
      O = App.get_option_no_throw(Name);
    if (O && O->get_items_expected_min() > 0)
      return emptyValueOf(*O);
  }
  return std::nullopt;
}

/// The option among \p App's and its parents' that took another one for its
/// value, as --json does in "--json -o x.png"; null if none did.
const CLI::Option *tookAnOption(const CLI::App *App) {
  const CLI::App *const Inner = App;
  for (; App; App = App->get_parent())
    for (const CLI::Option *O : App->get_options())
      for (const std::string &Value : O->results())
        if (Value.size() > 1 && Value.starts_with('-') &&
            Inner->get_option_no_throw(Value))
          return O;
  return nullptr;
}

/// The option with \p Name of \p App or of those around it; null if none is.
const CLI::Option *optionNamed(const CLI::App *App, const std::string &Name) {
  for (; App; App = App->get_parent())
    if (const CLI::Option *O = App->get_option_no_throw(Name))
      return O;
  return nullptr;
}

/// What \p E says of an option of \p App, with what was expected. Decided by
/// the kind of the error and by the options' values; of the text, which differs
/// between versions of CLI11, only the option's name is used.
std::string describe(const CLI::App &App, const CLI::ParseError &E) {
  std::string Said = E.what();
  switch (static_cast<CLI::ExitCodes>(E.get_exit_code())) {
  case CLI::ExitCodes::ExcludesError:
    return Said + ", expected one of them";
  case CLI::ExitCodes::RequiresError:
    return Said + ", expected both";
  case CLI::ExitCodes::ArgumentMismatch:
    if (const CLI::Option *O =
            optionNamed(&App, Said.substr(0, Said.find(':')))) {
      const auto Most =
          static_cast<std::size_t>(std::max(O->get_items_expected_max(), 1));
      return O->results().size() > Most
                 ? fmt::format("{}: {} values, expected at most {}",
                               O->get_name(), O->results().size(), Most)
                 : fmt::format("{}: a value is missing, expected {}",
                               O->get_name(), kindOf(*O));
    }
    return Said;
  case CLI::ExitCodes::ConversionError:
    for (const CLI::App *A = &App; A; A = A->get_parent())
      for (const CLI::Option *O : A->get_options()) {
        const std::string Values = CLI::detail::join(O->results());
        if (!Values.empty() && Said.ends_with(O->get_name() + " = " + Values))
          return fmt::format("{}: {} is not a valid number", O->get_name(),
                             Values);
      }
    return Said;
  default:
    return Said;
  }
}

/// What is wrong, of \p App that refused its arguments with \p E: a word
/// that nobody knows is told rather than what is missing without it. \p First
/// is the first argument.
std::string problemOf(const CLI::App &App, const CLI::ParseError &E,
                      const std::string &First) {
  const std::string Said = E.what();
  const std::vector<std::string> Outermost = subcommandsOf(App);
  if (!Outermost.empty() && !First.empty() && !First.starts_with('-') &&
      std::ranges::find(Outermost, First) == Outermost.end())
    return unknown("subcommand", First, Outermost);
  const CLI::App *Inner = &App;
  while (!Inner->get_subcommands().empty())
    Inner = Inner->get_subcommands().front();
  const std::vector<std::string> Left = App.remaining(/*recurse=*/true);
  const std::vector<std::string> Commands = subcommandsOf(*Inner);
  if (!Left.empty() && !Left.front().starts_with('-') && !Commands.empty())
    return unknown("subcommand", Left.front(), Commands);
  const auto Option = std::ranges::find_if(Left, [](const std::string &Word) {
    return Word.size() > 1 && Word.starts_with('-') && Word != "--";
  });
  if (Option != Left.end())
    return unknown("option", Option->substr(0, Option->find('=')),
                   optionsOf(Inner));
  if (Said == CLI::RequiredError::Subcommand(1).what())
    return fmt::format("no subcommand, expected one of {} {}",
                       fmt::join(Commands, ", "), SeeHelp);
  if (constexpr std::string_view Ending = " is required";
      Said.ends_with(Ending)) {
    const std::string Name = Said.substr(0, Said.size() - Ending.size());
    return fmt::format("{} is missing, expected: {} {}",
                       Name.starts_with('-') ? Name : upperCase(Name),
                       shortestCall(*Inner), SeeHelp);
  }
  const auto Surplus = std::ranges::find_if(
      Left, [](const std::string &Word) { return Word != "--"; });
  if (const CLI::Option *O = tookAnOption(Inner); O && Surplus != Left.end())
    return fmt::format("{}: a value is missing, expected {} {}", O->get_name(),
                       kindOf(*O), SeeHelp);
  if (Surplus != Left.end())
    return fmt::format("unexpected argument {} {}", *Surplus, SeeHelp);
  // A check of ours says itself what it expects.
  return Said.find("expected") == std::string::npos
             ? fmt::format("{} {}", describe(*Inner, E), SeeHelp)
             : Said;
}

} // namespace

CLI::Validator isOneOf(std::vector<std::string> Names) {
  CLI::Validator Check = check(OneOf, Names);
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
  return O->type_name("FILE")->check(check(FileIn, Endings));
}

CLI::Option *takesNameOrFile(CLI::Option *O, std::vector<std::string> Names,
                             const std::vector<std::string> &Endings) {
  std::ranges::copy(Endings, std::back_inserter(Names));
  return O->type_name("NAME|FILE")->check(check(FileIn, Names));
}

CLI::Option *takesFolder(CLI::Option *O) {
  return O->type_name("FOLDER")->check(check(FolderIn));
}

CLI::Option *writesFile(CLI::Option *O,
                        const std::vector<std::string> &Endings) {
  return O->type_name("FILE")->check(check(FileOut, Endings));
}

CLI::Option *writesFolder(CLI::Option *O) {
  return O->type_name("FOLDER")->check(check(FolderOut));
}

CLI::Option *writesFiles(CLI::Option *O) {
  return O->type_name("PREFIX")->check(check(FilesOut));
}

CLI::Option *takesSomeOf(CLI::Option *O,
                         const std::vector<std::string> &Names) {
  return O->check(check(SomeOf, Names));
}

CLI::Option *takesView(CLI::Option *O, const std::vector<std::string> &Others) {
  return O->type_name("VIEW")->check(check(View, Others));
}

OptionValue valueOf(const CLI::Option &O) {
  // There is no way to ask how many checks an option has, and none to ask a
  // constant one.
  constexpr int MostChecks = 4;
  auto &Asked = const_cast<CLI::Option &>(O);
  for (int I = 0; I < MostChecks; ++I) {
    std::string Name;
    try {
      Name = Asked.get_validator(I)->get_name();
    } catch (const CLI::OptionNotFound &) {
      break;
    }
    std::vector<std::string> Parts = CLI::detail::split(Name, '|');
    const auto *Found = std::ranges::find_if(Marks, [&Parts](const Mark *M) {
      return !Parts.empty() && M->Begin == Parts.front();
    });
    if (Found == std::end(Marks))
      continue;
    OptionValue V{(*Found)->What, {}, {}, (*Found)->IsWritten};
    const bool IsFile = V.What == OptionValue::Type::File;
    for (std::size_t At = 1; At < Parts.size(); ++At)
      if (!Parts[At].empty()) {
        const bool IsName = IsFile && !Parts[At].starts_with('.');
        (IsName ? V.Names : V.Words).push_back(std::move(Parts[At]));
      }
    return V;
  }
  return {};
}

ValueText textOf(const CLI::Option &O) {
  // CLI11 has the type, and behind a colon what checks call themselves.
  std::string Type = O.get_type_name(), Range;
  if (const std::size_t Colon = Type.find(':'); Colon != std::string::npos) {
    Range = Type.substr(Colon + 1);
    Type.resize(Colon);
  }
  if (!O.get_option_text().empty())
    return {O.get_option_text(), Range};
  if (const OptionValue Of = valueOf(O);
      Of.What == OptionValue::Type::OneOf &&
      Type == CLI::detail::type_name<std::string>())
    return {fmt::format("{}", fmt::join(Of.Words, "|")), Range};
  if (Type == CLI::detail::type_name<int>() ||
      Type == CLI::detail::type_name<unsigned>())
    return {"N", Range};
  return {Type == CLI::detail::type_name<float>() ? "X" : Type, Range};
}

HelpGroup::HelpGroup(CLI::App &App, std::string Title)
    : App(App), Title(std::move(Title)), First(App.get_options().size()) {}

HelpGroup::~HelpGroup() { next(""); }

void HelpGroup::next(std::string Following) {
  const auto All = App.get_options();
  for (; First < All.size(); ++First)
    if (All[First]->nonpositional() && All[First]->get_group() == "Options")
      All[First]->group(Title);
  Title = std::move(Following);
}

std::vector<std::string> writingOptions(const CLI::App &App) {
  std::vector<std::string> Names;
  for (const CLI::Option *O : App.get_options())
    if (valueOf(*O).IsWritten) {
      for (const std::string &Name : O->get_snames())
        Names.push_back("-" + Name);
      for (const std::string &Name : O->get_lnames())
        Names.push_back("--" + Name);
    }
  return Names;
}

const CLI::App *calledCommand(const CLI::App &App,
                              const std::vector<std::string> &Arguments) {
  for (std::size_t I = 0; I < Arguments.size(); ++I) {
    const std::string &Word = Arguments[I];
    if (Word.starts_with('-')) {
      const CLI::Option *O = App.get_option_no_throw(Word);
      if (O && O->get_items_expected_min() > 0)
        ++I; // its value
    } else {
      const auto Called = App.get_subcommands(
          [&Word](const CLI::App *C) { return C->get_name() == Word; });
      if (!Called.empty())
        return Called.front();
    }
  }
  return nullptr;
}

/// Parses \p Arguments by \p App; what is wrong with them. Throws what CLI11
/// does where a call asked for help.
static std::optional<std::string> parse(CLI::App &App,
                                        std::vector<std::string> Arguments) {
  if (auto Wrong = wrongEnding(App, Arguments))
    return Wrong;
  const std::string First = Arguments.empty() ? "" : Arguments.front();
  std::ranges::reverse(Arguments); // CLI11 takes them from the end
  try {
    App.parse(std::move(Arguments));
  } catch (const CLI::Success &) {
    throw;
  } catch (const CLI::ParseError &E) {
    const auto Wrong = firstWrong(App, ifEmpty);
    return Wrong ? Wrong : problemOf(App, E, First);
  }
  for (ValueCheck *Check : {ifEmpty, ifNaN, ifNoFloat})
    if (auto Wrong = firstWrong(App, Check))
      return Wrong;
  return std::nullopt;
}

/// Makes "help" and "help COMMAND" in \p Arguments what --help asks for, if
/// \p App has subcommands; what is wrong with them.
static std::optional<std::string>
takeHelpCommand(const CLI::App &App, std::vector<std::string> &Arguments) {
  const std::vector<std::string> Commands = subcommandsOf(App);
  if (Commands.empty() || Arguments.empty() || Arguments.front() != "help")
    return std::nullopt;
  Arguments.erase(Arguments.begin());
  if (!Arguments.empty() && !Arguments.front().starts_with('-') &&
      std::ranges::find(Commands, Arguments.front()) == Commands.end())
    return unknown("subcommand", Arguments.front(), Commands);
  Arguments.emplace_back("--help");
  return std::nullopt;
}

std::optional<int> parseCommandLine(CLI::App &App,
                                    std::vector<std::string> Arguments) {
  if (Arguments == std::vector<std::string>{"--print-definition"}) {
    printOut("{}\n", definitionOf(App));
    return static_cast<int>(ExitCode::Ok);
  }
  format(App, std::make_shared<HelpFormatter>());
  if (Arguments.empty() && App.get_require_subcommand_min() > 0)
    Arguments = {"--help"};
  if (auto Wrong = takeHelpCommand(App, Arguments))
    return reportError(App.get_name(),
                       {"", std::move(*Wrong), ExitCode::Usage});
  try {
    if (auto Wrong = parse(App, std::move(Arguments)))
      return reportError(App.get_name(),
                         {"", std::move(*Wrong), ExitCode::Usage});
  } catch (const CLI::Success &E) {
    std::ostringstream Help;
    const int Code = App.exit(E, Help, Help);
    printHelp(Help.str());
    return Code;
  }
  return std::nullopt;
}

Expected<Success> parseOptions(CLI::App &App,
                               std::vector<std::string> Arguments) {
  if (auto Wrong = parse(App, std::move(Arguments)))
    return Error{"", std::move(*Wrong), ExitCode::Usage};
  return Success{};
}

} // namespace vorion
