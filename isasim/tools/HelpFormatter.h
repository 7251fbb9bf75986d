/// vorion-sim --help on one screen: CLI11's usual page names exclusions and
/// checks behind every option, which no screen is wide enough for.
#pragma once

#include <CLI/CLI.hpp>

#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace vorion::isasim {

class HelpFormatter : public CLI::Formatter {
public:
  HelpFormatter() { column_width(32); }

  /// The value's name alone.
  std::string make_option_opts(const CLI::Option *Opt) const override {
    const std::string Type = Opt->get_type_name();
    return Type.empty() || Type.starts_with('[') ? Type : " " + Type;
  }
  /// One empty line between groups, not two.
  std::string make_group(std::string Group, bool IsPositional,
                         std::vector<const CLI::Option *> Opts) const override {
    return CLI::Formatter::make_group(std::move(Group), IsPositional,
                                      std::move(Opts))
        .substr(1);
  }
  /// Without the value that stands for none, {-}.
  std::string make_option_name(const CLI::Option *Opt,
                               bool IsPositional) const override {
    const std::string Name = Opt->get_name(IsPositional, true);
    return Name.substr(0, Name.find('{'));
  }
};

} // namespace vorion::isasim
