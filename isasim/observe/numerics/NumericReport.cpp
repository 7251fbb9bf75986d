#include "observe/numerics/NumericReport.h"

#include "core/SoftFloat.h"
#include "observe/numerics/RasterReport.h"
#include "vorion/support/Json.h"

#include <bit>
#include <cmath>
#include <fmt/format.h>

namespace vorion::isasim {

namespace {

using Json = nlohmann::ordered_json;

/// Links of a chain that are shown.
constexpr unsigned DeepestChain = 8;

std::string numberText(double V) { return fmt::format("{:.9g}", V); }

std::string floatText(uint32_t Word) {
  return numberText(std::bit_cast<float>(Word));
}

/// "1.5, 0.25 (0.2499) -> 6": operands with their shadows where those differ.
std::string sampleText(const NumericSample &S) {
  const auto Value = [](uint32_t Word, double Shadow) {
    const double Is = std::bit_cast<float>(Word);
    return Is == Shadow || (std::isnan(Is) && std::isnan(Shadow))
               ? floatText(Word)
               : fmt::format("{} (shadow {})", floatText(Word),
                             numberText(Shadow));
  };
  std::string Text;
  if (S.IsInteger)
    Text = fmt::format("{}", static_cast<int32_t>(S.Words[0]));
  for (unsigned N = 0; N != S.Operands && !S.IsInteger; ++N)
    Text += (N ? ", " : "") + Value(S.Words[N], S.Shadows[N]);
  return fmt::format("{} -> {}", Text, Value(S.Result, S.Shadow));
}

std::string whereText(const NumericSample &S) {
  return fmt::format("core {}, warp {}, lane {}", S.Core, S.Warp, S.Lane);
}

NumericCounts sum(const std::vector<NumericSites::Line> &Lines) {
  NumericCounts All;
  for (const NumericSites::Line &L : Lines)
    All += L.Counts;
  return All;
}

std::string heading() {
  std::string Text =
      fmt::format("{:>10} {:>8} {:>8}", "results", "mean", "max");
#define VORION_NUMERIC_COUNT(MEMBER, NAME, DOC)                                \
  if (&NumericCounts::MEMBER != &NumericCounts::Results)                       \
    Text += fmt::format(" {:>8}", NAME);
#include "observe/numerics/NumericCounts.def"
  return Text + "\n";
}

std::string row(const NumericCounts &C) {
  const auto Number = [](uint64_t N) {
    return N ? fmt::format("{}", N) : std::string("-");
  };
  std::string Text = fmt::format("{:>10} {:>8.1e} {:>8.1e}", Number(C.Results),
                                 C.errorMean(), C.ErrorMax);
#define VORION_NUMERIC_COUNT(MEMBER, NAME, DOC)                                \
  if (&NumericCounts::MEMBER != &NumericCounts::Results)                       \
    Text += fmt::format(" {:>8}", Number(C.MEMBER));
#include "observe/numerics/NumericCounts.def"
  return Text;
}

/// The first Inf or NaN, or nullptr.
const NumericEvent *firstEvent(const NumericFindings &F, bool Nan) {
  for (const NumericEvent &E : F.Sites.events())
    if (isNan(E.What.Result) == Nan)
      return &E;
  return nullptr;
}

/// Where operand \p N of \p S comes from, a site.
std::string fromText(const NumericFindings &F, const NumericSample &S,
                     unsigned N) {
  return fmt::format("{} from {}: {}\n", floatText(S.Words[N]),
                     F.Sites.place(S.From[N].number()),
                     F.Sites.text(S.From[N].number()));
}

/// The chain that ends at \p E, a link a line.
void addChain(const NumericFindings &F, const NumericEvent &E, unsigned Depth,
              std::string &Text) {
  Text +=
      fmt::format("{:{}}{}: {}: {}\n", "", 2 * Depth + 2, F.Sites.place(E.Site),
                  F.Sites.text(E.Site), sampleText(E.What));
  if (Depth == DeepestChain)
    return;
  for (unsigned N = 0; N != E.What.Operands; ++N) {
    const Origin From = E.What.From[N];
    if (From.isEvent())
      addChain(F, F.Sites.events()[From.number()], Depth + 1, Text);
    else if (From.isKnown())
      Text += fmt::format("{:{}}{}", "", 2 * Depth + 4, fromText(F, E.What, N));
  }
}

Json countsJson(const NumericCounts &C) {
  Json J;
#define VORION_NUMERIC_COUNT(MEMBER, NAME, DOC) J[NAME] = C.MEMBER;
#include "observe/numerics/NumericCounts.def"
  J["mean"] = C.errorMean();
  J["max"] = C.ErrorMax;
  return J;
}

Json chainJson(const NumericFindings &F, const NumericEvent &E,
               unsigned Depth) {
  Json Operands = Json::array();
  for (unsigned N = 0; N != E.What.Operands; ++N) {
    Json O{{"value", floatText(E.What.Words[N])},
           {"shadow", numberText(E.What.Shadows[N])}};
    const Origin From = E.What.From[N];
    if (From.isEvent() && Depth != DeepestChain)
      O["chain"] = chainJson(F, F.Sites.events()[From.number()], Depth + 1);
    else if (From.isKnown() && !From.isEvent())
      O["from"] = F.Sites.place(From.number());
    Operands.push_back(std::move(O));
  }
  return {{"place", F.Sites.place(E.Site)},
          {"instruction", F.Sites.text(E.Site)},
          {"core", E.What.Core},
          {"warp", E.What.Warp},
          {"lane", E.What.Lane},
          {"result", floatText(E.What.Result)},
          {"shadow", numberText(E.What.Shadow)},
          {"operands", Operands}};
}

} // namespace

std::string numericText(const NumericFindings &F) {
  const auto Lines = F.Sites.lines();
  std::string Text = fmt::format(
      "# vorion-numerics 1\n"
      "# {} run{}; every fp32 value compared with its shadow in double; "
      "limits: relative error {:g}, cancellation of {} bits\n",
      F.Runs, F.Runs == 1 ? "" : "s", F.Limits.Relative, F.Limits.CancelBits);
#define VORION_NUMERIC_COUNT(MEMBER, NAME, DOC)                                \
  Text += fmt::format("# {}: {}\n", NAME, DOC);
#include "observe/numerics/NumericCounts.def"
  Text += fmt::format("\n{}{}  total\n", heading(), row(sum(Lines)));

  unsigned Shown = 0, Quiet = 0, Left = 0, Unused = 0;
  double QuietMax = 0;
  for (const NumericSites::Line &L : Lines) {
    if (!L.Counts.matters()) {
      if (L.Counts.isReportable()) {
        ++Unused;
        continue;
      }
      ++Quiet;
      if (!L.Counts.Inherited)
        QuietMax = std::max(QuietMax, L.Counts.ErrorMax);
      continue;
    }
    if (Shown == F.Top) {
      ++Left;
      continue;
    }
    ++Shown;
    Text += fmt::format("{}  {}\n", row(L.Counts), L.Name);
    if (L.WorstBorn >= 0) {
      const NumericSample &S = F.Sites.site(L.WorstSite).Worst;
      Text +=
          fmt::format("{:>29}worst: {}: {}, {}\n", "",
                      F.Sites.text(L.WorstSite), sampleText(S), whereText(S));
      for (unsigned N = 0; N != S.Operands; ++N)
        if (S.From[N].isKnown() && !S.From[N].isEvent())
          Text += fmt::format("{:>31}{}", "", fromText(F, S, N));
    }
  }
  if (Left)
    Text += fmt::format("{} more lines\n", Left);
  if (Unused)
    Text += fmt::format("{} lines whose errors do not propagate: terms of "
                        "compensated sums, and unused values\n",
                        Unused);
  Text += fmt::format("{} lines without findings, largest error of those "
                      "without bad operands: {:.1e}\n",
                      Quiet, QuietMax);
  const auto Tell = [&](const char *What, const NumericEvent *E) {
    if (!E)
      return;
    Text += fmt::format("\nfirst {}: {}\n", What, whereText(E->What));
    addChain(F, *E, 0, Text);
  };
  Tell("Inf", firstEvent(F, false));
  Tell("NaN", firstEvent(F, true));
  return Text + rasterText(F.Units, F.Top);
}

std::string numericJson(const NumericFindings &F) {
  const auto Lines = F.Sites.lines();
  Json J{{"format", "vorion-numerics 1"},   {"runs", F.Runs},
         {"rel", F.Limits.Relative},        {"cancel", F.Limits.CancelBits},
         {"total", countsJson(sum(Lines))}, {"lines", Json::array()}};
  for (const NumericSites::Line &L : Lines) {
    Json Line;
    if (L.Place) {
      Line["file"] = L.Place->File;
      Line["line"] = L.Place->Line;
      Line["function"] = L.Place->Function;
    } else {
      Line["function"] = L.Name;
    }
    Line.update(countsJson(L.Counts));
    if (L.WorstBorn >= 0) {
      const NumericSample &S = F.Sites.site(L.WorstSite).Worst;
      Line["worst"] = {{"instruction", F.Sites.text(L.WorstSite)},
                       {"what", sampleText(S)},
                       {"where", whereText(S)}};
    }
    J["lines"].push_back(std::move(Line));
  }
  if (const NumericEvent *E = firstEvent(F, false))
    J["first_inf"] = chainJson(F, *E, 0);
  if (const NumericEvent *E = firstEvent(F, true))
    J["first_nan"] = chainJson(F, *E, 0);
  J["rasterizers"] = rasterJson(F.Units);
  return jsonText(J, 1) + "\n";
}

} // namespace vorion::isasim
