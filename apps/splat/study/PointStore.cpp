#include "study/PointStore.h"

#include "io/Inside.h"
#include "vorion/support/File.h"
#include "vorion/support/Json.h"

#include <filesystem>
#include <fmt/format.h>
#include <system_error>
#include <utility>

namespace vorion::splat {

using Json = nlohmann::ordered_json;

Expected<Json> readOwnJson(const std::string &Path) {
  return readRegularJson<Json>(Path, "a file written by splat");
}

Expected<Success> makeFolders(const std::string &Folder) {
  for (const char *Name : {"points", "work", "references"}) {
    std::error_code Problem;
    std::filesystem::create_directories(Folder + "/" + Name, Problem);
    if (Problem)
      return Error{Folder, fmt::format("cannot create the folder: {}, expected "
                                       "a writable folder",
                                       Problem.message())};
  }
  return Success{};
}

PointStore::PointStore(std::string Where,
                       std::function<bool(const Json &)> IsOne,
                       std::function<void(std::string_view)> Log)
    : Folder(std::move(Where)), IsMeasurement(std::move(IsOne)),
      Log(std::move(Log)) {}

std::string PointStore::fileOf(const std::string &Name) const {
  return fmt::format("{}/points/{}.json", Folder, asFileName(Name));
}

std::string PointStore::problem(const std::string &Name,
                                const Expected<Json> &Read,
                                const Provenance &From) const {
  if (!Read)
    return Read.error().What;
  if (!Read->is_object() || Read->value("point", Json()) != Name)
    return "another point, expected the point of that name";
  if (const auto Other = difference(Read->value("made_from", Json()), From);
      !Other.empty())
    return fmt::format("stale, differs in {}", Other);
  return IsMeasurement(*Read) ? "" : "damaged, expected a measurement";
}

const Json *PointStore::find(const std::string &Name, const Provenance &From) {
  const auto [At, IsNew] = Known.try_emplace(Name);
  std::error_code Ignored;
  if (IsNew && std::filesystem::exists(fileOf(Name), Ignored)) {
    auto Read = readOwnJson(fileOf(Name));
    if (const std::string Why = problem(Name, Read, From); !Why.empty())
      Log(fmt::format("{}: {}: not used", fileOf(Name), Why));
    else
      At->second = std::move(*Read);
  }
  return At->second.is_null() ? nullptr : &At->second;
}

Expected<Json> PointStore::get(const std::string &Name,
                               const Provenance &From) {
  if (const Json *Found = find(Name, From))
    return *Found;
  return Error{
      Folder,
      fmt::format("point {} is missing, expected its measurement", Name)};
}

Expected<Success> PointStore::keep(const std::string &Name,
                                   const Provenance &From,
                                   const Json &Measured) {
  Json Point{{"point", Name}, {"made_from", From}};
  Point.update(Measured);
  if (!IsMeasurement(Point))
    return Error{Name, "values are missing or not finite, expected a "
                       "measurement"};
  if (auto Written =
          writeFileAtomically(fileOf(Name), jsonText(Point, 1) + "\n");
      !Written)
    return Written;
  Known[Name] = std::move(Point);
  return Success{};
}

} // namespace vorion::splat
