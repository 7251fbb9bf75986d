#include "observe/numerics/Sites.h"

#include "core/Isa.h"

#include <algorithm>
#include <cstring>
#include <tuple>

namespace vorion::isasim {

NumericCounts &NumericCounts::operator+=(const NumericCounts &Other) {
#define VORION_NUMERIC_COUNT(MEMBER, NAME, DOC) MEMBER += Other.MEMBER;
#include "observe/numerics/NumericCounts.def"
  ErrorSum += Other.ErrorSum;
  ErrorMax = std::max(ErrorMax, Other.ErrorMax);
  return *this;
}

NumericSites::NumericSites() : All(1) {}

void NumericSites::useProgram(const std::shared_ptr<const Image> &Code) {
  auto Found = std::find_if(Programs.begin(), Programs.end(),
                            [&](const Program &P) { return P.Code == Code; });
  if (Found == Programs.end()) {
    Program P{{},
              Code,
              std::make_unique<SourceLines>(Code),
              UINT32_MAX,
              static_cast<uint32_t>(All.size()),
              0};
    uint32_t High = 0;
    for (const Image::Segment &S : Code->segments())
      if (S.Executable) {
        P.Low = std::min(P.Low, S.Address);
        High = std::max(High, S.Address + S.MemBytes);
      }
    P.Count = (High - P.Low) / 4;
    All.resize(All.size() + P.Count);
    Programs.push_back(std::move(P));
    Found = Programs.end() - 1;
  }
  First = Found->First;
  Low = Found->Low;
}

uint32_t NumericSites::unitNumber(std::string Name) {
  const auto Number = static_cast<uint32_t>(All.size());
  All.emplace_back();
  Programs.push_back({std::move(Name), nullptr, nullptr, 0, Number, 1});
  return Number;
}

uint32_t NumericSites::event(uint32_t Number, const NumericSample &What) {
  uint32_t &Known = All[Number].FirstEvent;
  if (Known == 0) {
    Events.push_back({Number, What});
    Known = static_cast<uint32_t>(Events.size());
  }
  return Known - 1;
}

const NumericSites::Program &NumericSites::programOf(uint32_t Number) const {
  return *std::find_if(Programs.begin(), Programs.end(), [&](const Program &P) {
    return Number - P.First < P.Count;
  });
}

uint32_t NumericSites::pcOf(uint32_t Number) const {
  const Program &P = programOf(Number);
  return P.Low + 4 * (Number - P.First);
}

std::string NumericSites::place(uint32_t Number) const {
  const Program &P = programOf(Number);
  return P.Code ? P.Source->describe(pcOf(Number)) : P.Unit;
}

std::string NumericSites::text(uint32_t Number) const {
  const Program &P = programOf(Number);
  if (!P.Code)
    return "a pixel";
  const uint32_t Pc = pcOf(Number);
  for (const Image::Segment &S : P.Code->segments())
    if (S.Executable && Pc - S.Address + 4 <= S.Bytes.size()) {
      uint32_t Word = 0;
      std::memcpy(&Word, S.Bytes.data() + (Pc - S.Address), 4);
      std::string Text = disassemble(Word, Pc);
      std::replace(Text.begin(), Text.end(), '\t', ' ');
      return Text;
    }
  return "?";
}

std::vector<NumericSites::Line> NumericSites::lines() const {
  std::map<std::string, Line> ByName;
  for (const Program &P : Programs)
    for (uint32_t N = P.First; N != P.First + P.Count; ++N) {
      const Site &S = All[N];
      if (!P.Code || (S.Counts.Results == 0 && !S.Counts.isReportable()))
        continue;
      const uint32_t Pc = pcOf(N);
      const std::optional<SourcePlace> Place = P.Source->find(Pc);
      std::string Name = Place ? Place->text() : P.Code->symbolize(Pc);
      if (!Place)
        Name.resize(std::min(Name.size(), Name.find('+')));
      Line &L = ByName[Name];
      if (L.Name.empty()) {
        L.Place = Place;
        L.Name = Place && !Place->Function.empty()
                     ? Name + " (" + Place->Function + ")"
                     : Name;
      }
      L.Counts += S.Counts;
      if (S.WorstBorn > L.WorstBorn) {
        L.WorstBorn = S.WorstBorn;
        L.WorstSite = N;
      }
    }
  std::vector<Line> Sorted;
  Sorted.reserve(ByName.size());
  for (auto &[Name, L] : ByName)
    Sorted.push_back(std::move(L));
  const auto Weight = [](const Line &L) {
    // A value that is not finite has no digit right.
    const double Worst = L.Counts.NotFinite ? 1 : std::max(L.WorstBorn, 0.0);
    return std::make_tuple(L.Counts.Reached + L.Counts.NotFinite != 0, Worst,
                           L.Counts.Born + L.Counts.NotFinite,
                           L.Counts.Branches + L.Counts.Decisions,
                           L.Counts.isReportable());
  };
  std::sort(Sorted.begin(), Sorted.end(), [&](const Line &A, const Line &B) {
    const auto WeightA = Weight(A), WeightB = Weight(B);
    return WeightA != WeightB ? WeightA > WeightB : A.Name < B.Name;
  });
  return Sorted;
}

} // namespace vorion::isasim
