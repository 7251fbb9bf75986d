#include "sweep/Points.h"

#include "io/Inside.h"
#include "vorion/support/File.h"
#include "vorion/support/Json.h"
#include "vorion/support/Terminal.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <filesystem>
#include <fmt/format.h>
#include <mutex>
#include <optional>
#include <system_error>
#include <thread>
#include <utility>

namespace vorion::splat {

using Json = nlohmann::ordered_json;

Expected<Json> readJson(const std::string &Path) {
  return readRegularJson<Json>(Path, "what splat wrote there");
}

Expected<Success> makeFolders(const std::string &Folder) {
  for (const char *Name : {"points", "work", "references"}) {
    std::error_code Problem;
    std::filesystem::create_directories(Folder + "/" + Name, Problem);
    if (Problem)
      return Error{Folder, fmt::format("cannot make the folder: {}, expected "
                                       "one that can be written",
                                       Problem.message())};
  }
  return Success{};
}

KeptPoints::KeptPoints(std::string Where,
                       std::function<bool(const Json &)> IsOne,
                       std::function<void(std::string_view)> Log)
    : Folder(std::move(Where)), IsMeasurement(std::move(IsOne)),
      Log(std::move(Log)) {}

std::string KeptPoints::fileOf(const std::string &Name) const {
  return fmt::format("{}/points/{}.json", Folder, asFileName(Name));
}

std::string KeptPoints::problem(const std::string &Name,
                                const Expected<Json> &Read,
                                const Origin &From) const {
  if (!Read)
    return Read.error().What;
  if (!Read->is_object() || Read->value("point", Json()) != Name)
    return "another point, expected the one of that name";
  if (const auto Other = difference(Read->value("made_from", Json()), From);
      !Other.empty())
    return fmt::format("stale, differs in {}", Other);
  return IsMeasurement(*Read) ? "" : "damaged, expected what a sweep wrote";
}

const Json *KeptPoints::find(const std::string &Name, const Origin &From) {
  const auto [At, IsNew] = Known.try_emplace(Name);
  std::error_code Ignored;
  if (IsNew && std::filesystem::exists(fileOf(Name), Ignored)) {
    auto Read = readJson(fileOf(Name));
    if (const std::string Why = problem(Name, Read, From); !Why.empty())
      Log(fmt::format("{}: {}: not used", fileOf(Name), Why));
    else
      At->second = std::move(*Read);
  }
  return At->second.is_null() ? nullptr : &At->second;
}

Expected<Success> KeptPoints::keep(const std::string &Name, const Origin &From,
                                   const Json &Measured) {
  Json Point{{"point", Name}, {"made_from", From}};
  Point.update(Measured);
  if (!IsMeasurement(Point))
    return Error{Name, "figures are missing or are no finite numbers, expected "
                       "a measurement"};
  if (auto Written =
          writeFileAtomically(fileOf(Name), jsonText(Point, 1) + "\n");
      !Written)
    return Written;
  Known[Name] = std::move(Point);
  return Success{};
}

Expected<Success> measureAll(KeptPoints &Kept,
                             const std::vector<Measuring> &Wanted,
                             unsigned Jobs,
                             const std::function<void(std::string_view)> &Log) {
  std::atomic<std::size_t> Next = 0;
  std::mutex Lock;
  std::size_t Count = 0;
  std::optional<Error> Failure;
  const auto Begin = std::chrono::steady_clock::now();
  const auto Left = [&] {
    const std::chrono::duration<double> Spent =
        std::chrono::steady_clock::now() - Begin;
    return timeLeftText(Spent.count(), Count, Wanted.size());
  };
  const auto Work = [&] {
    for (std::size_t I = Next++; I < Wanted.size(); I = Next++) {
      auto Measured = Wanted[I].Measure();
      const std::lock_guard Guard(Lock);
      if (!Measured)
        Failure = Measured.error();
      else if (auto Done = Kept.keep(Wanted[I].Name, Wanted[I].From, *Measured);
               !Done)
        Failure = Done.error();
      if (Failure) {
        Next = Wanted.size();
        return;
      }
      ++Count;
      Log(fmt::format("[{}/{}] {}: {}{}", Count, Wanted.size(), Wanted[I].Name,
                      Wanted[I].Describe(*Measured), Left()));
    }
  };
  std::vector<std::thread> Others;
  for (unsigned I = 1; I < Jobs; ++I)
    Others.emplace_back(Work);
  Work();
  for (std::thread &Other : Others)
    Other.join();
  if (Failure)
    return *Failure;
  return Success{};
}

} // namespace vorion::splat
