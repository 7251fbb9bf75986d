#include "vorion/support/Definition.h"

#include "vorion/support/CommandLine.h"
#include "vorion/support/Json.h"
#include "vorion/support/Version.h"

#include <nlohmann/json.hpp>
#include <set>
#include <string_view>
#include <vector>

namespace vorion {
namespace {

using Json = nlohmann::ordered_json;

std::string_view name(OptionValue::Type What) {
  switch (What) {
  case OptionValue::Type::Any:
    return "any";
  case OptionValue::Type::OneOf:
    return "one-of";
  case OptionValue::Type::SomeOf:
    return "some-of";
  case OptionValue::Type::View:
    return "view";
  case OptionValue::Type::File:
    return "file";
  case OptionValue::Type::Folder:
    return "folder";
  case OptionValue::Type::Prefix:
    return "prefix";
  }
  return {};
}

std::vector<std::string> namesOf(const CLI::Option &O) {
  std::vector<std::string> Names;
  for (const std::string &Name : O.get_snames())
    Names.push_back("-" + Name);
  for (const std::string &Name : O.get_lnames())
    Names.push_back("--" + Name);
  return Names;
}

std::vector<std::string> namesOf(const CLI::App &App,
                                 const std::set<CLI::Option *> &Options) {
  // In the order of definition: a set of pointers has another in each process.
  std::vector<std::string> Names;
  for (const CLI::Option *O : App.get_options())
    for (const CLI::Option *Wanted : Options)
      if (O == Wanted)
        Names.push_back(O->get_name());
  return Names;
}

Json toJson(const CLI::App &App, const CLI::Option &O) {
  const OptionValue Value = valueOf(O);
  const ValueText Text = textOf(O);
  // A flag that may have a value says so by how its help begins.
  const bool MayStandAlone = Text.Name.starts_with("[=");
  const bool HasValue = MayStandAlone || O.get_items_expected_max() > 0;
  Json J{{"names", namesOf(O)}, {"help", O.get_description()}};
  if (O.get_positional())
    J["position"] = O.get_name(/*positional=*/true);
  if (HasValue) {
    J["value"] = {{"name", Text.Name},
                  {"kind", name(Value.What)},
                  {"optional", MayStandAlone},
                  {"written", Value.IsWritten}};
    if (!Value.Words.empty())
      J["value"]["words"] = Value.Words;
    if (!Value.Names.empty())
      J["value"]["names"] = Value.Names;
    if (!Text.Range.empty())
      J["value"]["range"] = Text.Range;
    if (O.get_delimiter() != '\0')
      J["value"]["delimiter"] = std::string(1, O.get_delimiter());
  }
  J["required"] = O.get_required();
  J["repeats"] = O.get_items_expected_max() > 1 && !O.get_allow_extra_args();
  if (O.get_group() != "Options")
    J["group"] = O.get_group();
  if (const auto Names = namesOf(App, O.get_needs()); !Names.empty())
    J["needs"] = Names;
  if (const auto Names = namesOf(App, O.get_excludes()); !Names.empty())
    J["excludes"] = Names;
  return J;
}

Json toJson(const CLI::App &App) {
  Json J{{"name", App.get_name()},
         {"description", App.get_description()},
         {"footer", App.get_footer()},
         {"options", Json::array()}};
  for (const CLI::Option *O : App.get_options())
    J["options"].push_back(toJson(App, *O));
  if (const auto Commands = App.get_subcommands({}); !Commands.empty())
    for (const CLI::App *Command : Commands)
      J["commands"].push_back(toJson(*Command));
  return J;
}

} // namespace

std::string definitionOf(const CLI::App &App) {
  const Json J{{"schema", {{"name", "vorion-command-line"}, {"version", 1}}},
               {"version", projectVersion()},
               {"tool", toJson(App)}};
  return jsonText(J, 2);
}

} // namespace vorion
