#include "observe/NameList.h"

#include "vorion/support/Suggest.h"

#include <algorithm>
#include <fmt/format.h>

namespace vorion::isasim {

Expected<uint32_t> parseNameList(std::string_view Kind, std::string_view Text,
                                 std::span<const std::string_view> Names,
                                 std::string_view Note) {
  uint32_t Listed = 0;
  while (true) {
    const size_t Comma = Text.find(',');
    const std::string_view Name = Text.substr(0, Comma);
    const auto Found = std::ranges::find(Names, Name);
    if (Name == "all")
      Listed = (1U << Names.size()) - 1;
    else if (Found != Names.end())
      Listed |= 1U << (Found - Names.begin());
    else
      return Error{"",
                   fmt::format("{} '{}', expected all or some of {}{}{}", Kind,
                               Name, fmt::join(Names, ","), Note,
                               didYouMean(Name, Names)),
                   ExitCode::Usage};
    if (Comma == std::string_view::npos)
      return Listed;
    Text.remove_prefix(Comma + 1);
  }
}

} // namespace vorion::isasim
