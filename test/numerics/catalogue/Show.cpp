#include "Show.h"

#include "TrainingCase.h"
#include "io/ReportHead.h"
#include "page/VerdictPage.h"
#include "vorion/support/Diagnostics.h"
#include "vorion/support/File.h"
#include "vorion/support/Json.h"
#include "vorion/support/Letters.h"
#include "vorion/support/Printable.h"
#include "vorion/support/StatusLine.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>
#include <vector>

namespace vorion::test {
namespace {

using Json = nlohmann::ordered_json;

/// A run with a broken kernel.
struct WithoutGuard {
  std::string Kernel, Way;
  std::string Noticed; ///< empty: the contract was kept all the same
  std::optional<splat::Image> Picture;
};

/// All that was found of a case.
struct Shown {
  std::string Name, Why;
  /// Of all ways to draw it or take it back, as it stands.
  double Error = 0, Bound = 0;
  unsigned Checks = 0;
  std::string Broken; ///< the first contract that was; empty: none
  std::optional<splat::Image> Picture;
  std::vector<WithoutGuard> Guards; ///< each once, in the first way

  bool isGood() const {
    return Broken.empty() && std::ranges::none_of(Guards, &std::string::empty,
                                                  &WithoutGuard::Noticed);
  }
};

std::vector<Shown> emptyCatalogue() {
  std::vector<Shown> All;
  const auto Add = [&All](std::string Name, std::string Why) {
    All.emplace_back();
    All.back().Name = std::move(Name);
    All.back().Why = std::move(Why);
  };
  for (HardCase &C : catalogue())
    Add(std::move(C.Name), std::move(C.Why));
  for (TrainingCase &C : trainingCases())
    Add(std::move(C.Name), std::move(C.Why));
  return All;
}

void take(Shown &To, const nlohmann::json &Row, const splat::Image *Picture) {
  ++To.Checks;
  const auto Copy = [&] {
    return Picture ? std::optional(*Picture) : std::nullopt;
  };
  if (Row.contains("kernel")) {
    const auto Kernel = Row["kernel"].get<std::string>();
    const auto Known =
        std::ranges::find(To.Guards, Kernel, &WithoutGuard::Kernel);
    if (Known == To.Guards.end())
      To.Guards.push_back({Kernel, Row["path"].get<std::string>(),
                           Row["noticed"].get<std::string>(), Copy()});
    else if (Row["noticed"].get<std::string>().empty())
      Known->Noticed.clear(); // in another way
    return;
  }
  if (To.Broken.empty())
    To.Broken = Row["broken"].get<std::string>();
  if (Row["settings"] != 0)
    return; // depths and normals
  To.Error = std::max(To.Error, Row["error"].get<double>());
  To.Bound = std::max(To.Bound, Row["bound"].get<double>());
  if (!To.Picture)
    To.Picture = Copy();
}

/// How far \p B is off \p A, so many times as large that the most is seen: the
/// picture, and how many times.
std::pair<splat::Image, double> differenceOf(const splat::Image &A,
                                             const splat::Image &B) {
  splat::Image D = A;
  float Most = 0;
  for (std::size_t I = 0; I < D.Render.size(); ++I) {
    const float Off = std::abs(A.Render[I] - B.Render[I]);
    // What is no number is as bright as can be.
    D.Render[I] = std::isfinite(Off) ? Off : std::numeric_limits<float>::max();
    if (std::isfinite(Off))
      Most = std::max(Most, Off);
  }
  const double Times =
      Most > 0
          ? std::pow(10.0, std::max(0.0, std::floor(-std::log10(double(Most)))))
          : 1.0;
  for (float &Value : D.Render)
    Value *= static_cast<float>(Times);
  return {std::move(D), Times};
}

/// The files of a folder, by what they are called there.
using Files = std::map<std::string, std::string>;

/// What the page shows of \p S; adds the pictures to \p To and their names to
/// \p Report.
Expected<splat::PagePictures> picturesOf(const Shown &S, Files &To,
                                         Json &Report) {
  splat::PagePictures Group{S.Name, S.Why, {}};
  const auto Add = [&](const std::string &File, std::string Caption,
                       const splat::Image &Of) -> Expected<Success> {
    auto Png = splat::encodePng(Of);
    if (!Png)
      return Png.error();
    To[File] = *Png;
    Group.Pictures.push_back({std::move(Caption), std::move(*Png)});
    return Success{};
  };
  const std::string File = S.Name + ".png";
  Report["picture"] = File;
  if (auto Added = Add(File,
                       fmt::format("as it is: error {:.2g} of at most {:.2g}",
                                   S.Error, S.Bound),
                       *S.Picture);
      !Added)
    return Added.error();
  for (std::size_t G = 0; G < S.Guards.size(); ++G) {
    const WithoutGuard &W = S.Guards[G];
    if (!W.Picture)
      continue;
    const std::string Without = fmt::format("{}.with-{}.png", S.Name, W.Kernel);
    Report["without_guard"][G]["picture"] = Without;
    const auto [Difference, Times] = differenceOf(*S.Picture, *W.Picture);
    for (const auto &Added :
         {Add(Without,
              fmt::format("{}: {}", W.Kernel,
                          W.Noticed.empty() ? "not noticed" : W.Noticed),
              *W.Picture),
          Add(fmt::format("{}.with-{}.difference.png", S.Name, W.Kernel),
              Times == 1
                  ? "their difference"
                  : fmt::format("their difference, {:g} times as large", Times),
              Difference)})
      if (!Added)
        return Added.error();
  }
  return Group;
}

Json jsonOf(const Shown &S) {
  Json Guards = Json::array();
  for (const WithoutGuard &W : S.Guards)
    Guards.push_back(
        {{"kernel", W.Kernel}, {"way", W.Way}, {"noticed", W.Noticed}});
  return {{"name", S.Name},
          {"why", S.Why},
          {"checks", S.Checks},
          {"error", S.Error},
          {"bound", S.Bound},
          {"broken", S.Broken},
          {"without_guard", std::move(Guards)}};
}

std::string verdictOf(const std::vector<Shown> &Cases) {
  std::size_t Kept = 0, Guards = 0, Noticed = 0;
  std::string First;
  for (const Shown &S : Cases) {
    Kept += S.Broken.empty();
    for (const WithoutGuard &W : S.Guards) {
      ++Guards;
      Noticed += !W.Noticed.empty();
    }
    if (First.empty() && !S.isGood())
      First = S.Name;
  }
  const std::string Of = counted(Cases.size(), "hard case");
  if (First.empty())
    return fmt::format(
        "{} {} contract; {}", Cases.size() == 1 ? Of : "all " + Of,
        Cases.size() == 1 ? "keeps its" : "keep their",
        Guards == 0 ? "no guard was removed"
        : Guards == 1
            ? "without its guard the contract is broken"
            : fmt::format("without a guard it is broken, for each of {} guards",
                          Guards));
  return fmt::format("{} of {} keep their contract, and {} of {} missing "
                     "guards are noticed; look at {} first",
                     Kept, Of, Noticed, Guards, First);
}

splat::AnswerTable tableOf(const std::vector<Shown> &Cases) {
  splat::AnswerTable T{
      "All cases",
      "Errors are the largest of all ways to compute a case, against fp64. "
      "Without a guard: what its contract says of the first way.",
      {"case", "error", "bound", "kernel without a guard", "is noticed by"},
      {}};
  for (const Shown &S : Cases) {
    std::vector<std::string> Row{S.Name, fmt::format("{:.1e}", S.Error),
                                 S.Broken.empty()
                                     ? fmt::format("{:.1e}", S.Bound)
                                     : "BROKEN: " + printable(S.Broken)};
    if (S.Guards.empty())
      T.Rows.push_back({Row[0], Row[1], Row[2], "", ""});
    for (const WithoutGuard &W : S.Guards) {
      T.Rows.push_back({Row[0], Row[1], Row[2], W.Kernel,
                        W.Noticed.empty() ? "NOTHING" : printable(W.Noticed)});
      Row = {"", "", ""};
    }
  }
  return T;
}

Expected<Success> write(const std::string &Folder, const Files &All) {
  std::error_code Failed;
  std::filesystem::create_directories(Folder, Failed);
  if (Failed)
    return Error{Folder, fmt::format("cannot make this folder: {}, expected "
                                     "one that can be made",
                                     Failed.message())};
  for (const auto &[Name, Bytes] : All)
    if (auto Written =
            writeFileAtomically(fmt::format("{}/{}", Folder, Name), Bytes);
        !Written)
      return Written;
  return Success{};
}

} // namespace

Expected<Success> show(CheckPlan P, const std::string &Folder) {
  std::vector<Shown> Cases = emptyCatalogue();
  P.Broken = true;
  P.Listener = [&](const nlohmann::json &Row, const splat::Image *Picture) {
    take(
        *std::ranges::find(Cases, Row["case"].get<std::string>(), &Shown::Name),
        Row, Picture);
  };
  const auto Counts = check(P, /*Verbose=*/false);
  clearStatus();
  if (!Counts)
    return Counts.error();
  std::erase_if(Cases, [](const Shown &S) { return S.Checks == 0; });

  Files All;
  Json Rows = Json::array();
  splat::VerdictPage Page{"Hard cases, with and without their guards",
                          verdictOf(Cases),
                          {},
                          {},
                          {tableOf(Cases)},
                          {splat::madeBy()}};
  for (const Shown &S : Cases) {
    Json Row = jsonOf(S);
    if (S.Picture) {
      auto Group = picturesOf(S, All, Row);
      if (!Group)
        return Group.error();
      Page.Pictures.push_back(std::move(*Group));
    }
    Rows.push_back(std::move(Row));
  }
  Json Report = splat::reportHead("splat-hard-cases");
  Report.update({{"verdict", Page.Verdict}, {"cases", std::move(Rows)}});
  All["hard-cases.json"] = jsonText(Report, 2) + "\n";
  All["index.html"] = splat::verdictPageOf(Page);
  printOut("{}\n\n{}", Page.Verdict, toString(Page.Tables.front()));
  if (auto Written = write(Folder, All); !Written)
    return Written;
  printOut("{}/index.html\n", escaped(Folder));
  if (Counts->Failed != 0)
    return Error{
        "",
        fmt::format("{} contracts are broken, expected none", Counts->Failed),
        ExitCode::GuestFailed};
  return Success{};
}

} // namespace vorion::test
