#include "study/Study.h"

#include "vorion/support/Diagnostics.h"
#include "vorion/support/Printable.h"
#include "vorion/support/Suggest.h"
#include "vorion/support/Terminal.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <fmt/format.h>
#include <mutex>
#include <optional>
#include <ranges>
#include <thread>
#include <utility>

namespace vorion::splat {

std::vector<StudyPoint> missing(PointStore &Kept, std::vector<StudyPoint> Of) {
  std::erase_if(Of, [&Kept](const StudyPoint &P) {
    return Kept.find(P.Name, P.From) != nullptr;
  });
  return Of;
}

Expected<Success> measureAll(PointStore &Kept, std::vector<StudyPoint> Wanted,
                             unsigned Jobs,
                             const std::function<void(std::string_view)> &Log) {
  for (const StudyPoint &P : Wanted)
    if (auto Prepared = P.Prepare(); !Prepared)
      return Prepared;
  for (StudyPoint &P : Wanted)
    P.Prepare = nullptr;
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

Expected<std::vector<StudyPoint>>
pointsNamed(const std::vector<StudyPoint> &Known,
            const std::vector<std::string> &Only, std::string_view What,
            std::string_view Wanted) {
  std::vector<StudyPoint> Found;
  for (const std::string &Name : Only) {
    const auto At = std::ranges::find(Known, Name, &StudyPoint::Name);
    if (At == Known.end())
      return Error{"",
                   fmt::format("--only {}: unknown {}, expected {}{}", Name,
                               What, Wanted,
                               didYouMean(Name, std::views::transform(
                                                    Known, &StudyPoint::Name))),
                   ExitCode::Usage};
    Found.push_back(*At);
  }
  return Found;
}

Expected<Success> runStudy(const StudyOptions &O, PointStore &Kept,
                           const StudySteps &Steps,
                           const std::function<void(std::string_view)> &Log) {
  if (O.List) {
    auto Round = Steps.Round();
    if (!Round)
      return Round.error();
    for (const StudyPoint &P : missing(Kept, std::move(*Round)))
      printOut("{}\n", escaped(P.Name));
    return Success{};
  }
  if (auto Made = makeFolders(O.Folder); !Made)
    return Made;
  if (auto Begun = Steps.Begin(); !Begun)
    return Begun;
  while (true) {
    auto Points = O.Only.empty() ? Steps.Round() : Steps.Named(O.Only);
    if (!Points)
      return Points.error();
    auto Left = missing(Kept, std::move(*Points));
    if (Left.empty() && O.Only.empty())
      return Steps.End();
    if (auto Done = measureAll(Kept, std::move(Left), O.Jobs, Log); !Done)
      return Done;
    if (!O.Only.empty())
      return Success{};
  }
}

} // namespace vorion::splat
