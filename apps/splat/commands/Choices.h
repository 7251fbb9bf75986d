/// Options whose value is the name of an enumerator.
#pragma once

#include "vorion/support/CommandLine.h"

#include <CLI/CLI.hpp>
#include <array>
#include <cstddef>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace vorion::splat {

/// An option whose value is one of \p Choices by name; \p Value must outlive
/// the parsing.
template <typename Enum>
void addChoice(CLI::App &App, const std::string &Flag, Enum &Value,
               std::vector<Enum> Choices, const std::string &Help) {
  std::vector<std::string> Names;
  std::string Listed;
  for (const Enum E : Choices) {
    Names.emplace_back(name(E));
    Listed += (Listed.empty() ? "" : "|") + Names.back();
  }
  App.add_option_function<std::string>(
         Flag,
         [&Value, Choices = std::move(Choices)](const std::string &Chosen) {
           for (const Enum E : Choices)
             if (name(E) == Chosen)
               Value = E;
         },
         fmt::format("{} (default {})", Help, name(Value)))
      ->option_text(Listed)
      ->check(isOneOf(std::move(Names)));
}

/// The same for all enumerators.
template <typename Enum, std::size_t Count>
void addChoice(CLI::App &App, const std::string &Flag, Enum &Value,
               const std::array<Enum, Count> &All, const std::string &Help) {
  addChoice(App, Flag, Value, std::vector<Enum>(All.begin(), All.end()), Help);
}

/// An option whose value is one of the numbers \p Choices; \p Value must
/// outlive the parsing. \p Default is for the help.
template <typename Number>
void addSize(CLI::App &App, const std::string &Flag, Number &Value,
             const std::vector<unsigned> &Choices, const std::string &Help,
             std::string_view Default) {
  std::vector<std::string> Names;
  Names.reserve(Choices.size());
  for (const unsigned Choice : Choices)
    Names.push_back(std::to_string(Choice));
  App.add_option(Flag, Value, fmt::format("{} (default {})", Help, Default))
      ->option_text(fmt::format("{}", fmt::join(Names, "|")))
      ->check(isOneOf(std::move(Names)));
}

/// For options that are numbers of iterations.
inline CLI::Validator isIterations() { return isBetween(1U, 10000000U); }

} // namespace vorion::splat
