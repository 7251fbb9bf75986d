/// A profile for programs: what each instruction cost (docs/debugging.md,
/// "Profile").
#pragma once

#include "observe/SourceCosts.h"

#include "vorion/support/Json.h"

#include <nlohmann/json.hpp>
#include <string>
#include <utility>

namespace vorion::isasim {

/// The text of \p Head, with the programs of \p Places behind it: their files,
/// and of each instruction that cost something, address, code and what
/// \p Fields makes of its cost. The code tells a reader whether it has the
/// program that ran.
template <typename Cost, typename Function>
std::string profileJson(nlohmann::ordered_json Head,
                        const SourceCosts<Cost> &Places, Function Fields) {
  using Json = nlohmann::ordered_json;
  Json Programs = Json::array();
  const void *Last = nullptr;
  Places.forEach([&](const typename SourceCosts<Cost>::Program &P, uint32_t Pc,
                     const Cost &C) {
    if (std::exchange(Last, &P) != &P)
      Programs.push_back(
          {{"file", P.Code->name()}, {"instructions", Json::array()}});
    Json Entry = {{"pc", Pc}, {"code", instructionWord(*P.Code, Pc)}};
    Entry.update(Fields(C));
    Programs.back()["instructions"].push_back(std::move(Entry));
  });
  Head["programs"] = std::move(Programs);
  return jsonText(Head) + "\n";
}

/// Whether a profile's file is to be one for programs: its name ends in .json.
inline bool isProfileJson(const std::string &File) {
  return File.ends_with(".json");
}

} // namespace vorion::isasim
