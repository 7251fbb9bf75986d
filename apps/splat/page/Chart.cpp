#include "page/Chart.h"

#include "vorion/support/Printable.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <fmt/format.h>

namespace vorion::splat {
namespace {

constexpr double Width = 760, Left = 80, Right = 744;
constexpr double PlotHeight = 290;
/// Of a line of text, and of a letter: no less than what fonts have.
constexpr double LineHeight = 18, Letter = 7.6;
constexpr std::size_t WidestLine = 88; ///< letters that fit into the width
constexpr int MostYSteps = 5;
constexpr double Slant = 40; ///< of labels that do not fit, degrees

/// Beside colours, for whoever cannot tell these apart.
constexpr std::array<const char *, 7> Dashes = {
    "none", "7 3", "2 3", "9 3 2 3", "1 2", "12 3", "4 4"};

std::string forXml(const std::string &Text) {
  std::string Out;
  for (const char C : vorion::escaped(Text))
    Out += C == '<'   ? "&lt;"
           : C == '>' ? "&gt;"
           : C == '&' ? "&amp;"
                      : std::string(1, C);
  return Out;
}

/// Letters of UTF-8.
std::size_t lettersOf(std::string_view Text) {
  return static_cast<std::size_t>(
      std::ranges::count_if(Text, [](char C) { return (C & 0xc0) != 0x80; }));
}

double widthOf(const std::string &Text) {
  return Letter * static_cast<double>(lettersOf(vorion::escaped(Text)));
}

/// \p Text in lines of at most \c WidestLine letters, broken at a space where
/// there is one.
std::vector<std::string> linesOf(const std::string &Text) {
  std::vector<std::string> Lines;
  std::string Rest = vorion::escaped(Text);
  while (lettersOf(Rest) > WidestLine) {
    std::size_t End = 0;
    for (std::size_t Seen = 0; Seen <= WidestLine; ++End)
      Seen += (Rest[End] & 0xc0) != 0x80;
    --End; // the first byte that does not fit begins a letter
    const std::size_t Space = Rest.rfind(' ', End);
    const bool Breaks = Space != std::string::npos && Space > 0;
    Lines.push_back(Rest.substr(0, Breaks ? Space : End));
    Rest.erase(0, Breaks ? Space + 1 : End);
  }
  Lines.push_back(Rest);
  return Lines;
}

/// The value of look.css's colour \p Name, light or dark: the sheet names the
/// light ones first.
std::string_view colour(std::string_view Name, bool Dark) {
  std::string_view Sheet = lookSheet();
  if (Dark)
    Sheet.remove_prefix(Sheet.find("prefers-color-scheme: dark"));
  const std::string Begin = fmt::format("--{}: ", Name);
  const std::size_t At = Sheet.find(Begin);
  assert(At != std::string_view::npos);
  Sheet.remove_prefix(At + Begin.size());
  return Sheet.substr(0, Sheet.find(';'));
}

/// Values of colours and no names: many programs that show SVG know no
/// variables of style sheets.
std::string rules(const Chart &C, bool Dark) {
  std::string Out = fmt::format(
      ".panel {{ fill: {}; stroke: {}; }}\n.grid {{ stroke: {}; }}\n"
      ".ink {{ fill: {}; }}\n.soft {{ fill: {}; }}\n",
      colour("panel", Dark), colour("line", Dark), colour("line", Dark),
      colour("ink", Dark), colour("soft", Dark));
  const std::string_view All = colour("series", Dark);
  std::size_t At = 0;
  for (std::size_t K = 0; K < C.Series.size(); ++K) {
    const std::size_t End = std::min(All.find(' ', At), All.size());
    const std::string_view Color = All.substr(At, End - At);
    Out += fmt::format(".line{0} {{ stroke: {1}; fill: none; }}\n"
                       ".bar{0} {{ fill: {1}; }}\n",
                       K, Color);
    At = End == All.size() ? 0 : End + 1;
  }
  return Out;
}

std::string styleOf(const Chart &C) {
  return fmt::format(
      "<style>\ntext {{ font: 13px system-ui, \"DejaVu Sans\", sans-serif; }}\n"
      ".title {{ font-size: 15px; font-weight: 600; }}\n"
      ".made {{ font-size: 11px; }}\n{}"
      "@media (prefers-color-scheme: dark) {{\n{}}}\n</style>\n",
      rules(C, false), rules(C, true));
}

/// The smallest 1, 2, 2.5 or 5 times a power of ten that, taken
/// \c MostYSteps times, reaches \p Largest.
double stepFor(double Largest) {
  if (!(Largest > 0))
    return 1;
  const double Power =
      std::pow(10, std::floor(std::log10(Largest / MostYSteps)));
  for (const double Factor : {1.0, 2.0, 2.5, 5.0})
    if (Factor * Power * MostYSteps >= Largest)
      return Factor * Power;
  return 10 * Power;
}

/// The same of whole numbers, between which there is nothing.
double wholeStepFor(double Largest) {
  const double Step = stepFor(Largest);
  return Step == 2.5 ? 5 : std::max(1.0, Step);
}

std::string text(double X, double Y, const char *Anchor, const char *Class,
                 const std::string &Content) {
  return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\" "
                     "class=\"{}\">{}</text>\n",
                     X, Y, Anchor, Class, forXml(Content));
}

/// Where values lie in the picture.
class Drawing {
public:
  explicit Drawing(const Chart &Content) : Content(Content) {
    double Largest = 0;
    for (const ChartSeries &S : Content.Series) {
      assert(S.Values.size() == places());
      for (const double V : S.Values)
        Largest = std::max(Largest, V);
    }
    Step = stepFor(Largest);
    YSteps = std::max(1, static_cast<int>(std::ceil(Largest / Step - 1e-9)));
    if (!Content.Numbers.empty()) {
      XEnd = Content.NumbersEnd;
      XStep = wholeStepFor(XEnd);
    }
    for (std::size_t I = 0; I < Content.Places.size(); I += Content.LabelEvery)
      WidestLabel = std::max(WidestLabel, widthOf(Content.Places[I]));
    IsSlanted = WidestLabel > place() * static_cast<double>(Content.LabelEvery);
    if (IsSlanted) // the first label ends below its place and begins left of it
      PlotLeft = std::max(Left, WidestLabel * std::cos(Slant * M_PI / 180));
  }

  std::string document() {
    std::string Body;
    double Y = 8;
    for (const std::string &Line : linesOf(Content.Title))
      Body += text(16, Y += LineHeight, "start", "title ink", Line);
    Top = Y + 20;
    Bottom = Top + PlotHeight;
    Body += axes();
    for (std::size_t K = 0; K < Content.Series.size(); ++K)
      Body += series(K);
    Y = Bottom + 6 +
        (IsSlanted ? WidestLabel * std::sin(Slant * M_PI / 180) + 12
                   : LineHeight);
    Body += text((PlotLeft + Right) / 2, Y += LineHeight, "middle", "ink",
                 Content.XLabel);
    Body += legend(Y);
    Y += 4;
    for (const std::string &Made : Content.Made)
      for (const std::string &Line : linesOf(Made))
        Body += text(16, Y += LineHeight, "start", "made soft", Line);
    const double Height = Y + 14;
    return fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 "
        "{0} {1:.0f}\" width=\"{0}\" height=\"{1:.0f}\">\n{2}"
        "<rect x=\"0.5\" y=\"0.5\" width=\"{3}\" "
        "height=\"{4:.0f}\" rx=\"6\" class=\"panel\"/>\n{5}</svg>\n",
        Width, Height, styleOf(Content), Width - 1, Height - 1, Body);
  }

private:
  std::size_t places() const {
    return Content.Numbers.empty() ? Content.Places.size()
                                   : Content.Numbers.size();
  }
  double place() const {
    return (Right - PlotLeft) / static_cast<double>(places());
  }
  double xOfNumber(double Number) const {
    return PlotLeft + Number / XEnd * (Right - PlotLeft);
  }
  /// The middle of place \p I, or its number.
  double x(std::size_t I) const {
    return Content.Numbers.empty()
               ? PlotLeft + (static_cast<double>(I) + 0.5) * place()
               : xOfNumber(Content.Numbers[I]);
  }
  double y(double Value) const {
    return Bottom - Value / (Step * YSteps) * (Bottom - Top);
  }

  std::string axes() const {
    std::string Out;
    for (int K = 0; K <= YSteps; ++K) {
      const double Value = K * Step;
      Out += fmt::format("<line x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" "
                         "y2=\"{:.1f}\" class=\"grid\"/>\n",
                         PlotLeft, y(Value), Right, y(Value));
      Out += text(PlotLeft - 8, y(Value) + 4, "end", "soft",
                  fmt::format("{:.6g}", Value));
    }
    for (std::size_t I = 0; I < Content.Places.size(); I += Content.LabelEvery)
      Out += IsSlanted
                 ? fmt::format("<text transform=\"translate({:.1f} {:.1f}) "
                               "rotate(-{})\" text-anchor=\"end\" "
                               "class=\"soft\">{}</text>\n",
                               x(I) + 4, Bottom + 16, Slant,
                               forXml(Content.Places[I]))
                 : text(x(I), Bottom + LineHeight, "middle", "soft",
                        Content.Places[I]);
    for (int K = 0; XEnd > 0 && K * XStep <= XEnd; ++K) {
      const double X = xOfNumber(K * XStep);
      Out += fmt::format("<line x1=\"{0:.1f}\" y1=\"{1:.1f}\" x2=\"{0:.1f}\" "
                         "y2=\"{2:.1f}\" class=\"grid\"/>\n",
                         X, Top, Bottom);
      Out += text(X, Bottom + LineHeight, "middle", "soft",
                  fmt::format("{}", static_cast<long>(K * XStep)));
    }
    Out += fmt::format("<text transform=\"translate(22 {:.1f}) rotate(-90)\" "
                       "text-anchor=\"middle\" class=\"ink\">{}</text>\n",
                       (Top + Bottom) / 2, forXml(Content.YLabel));
    return Out;
  }

  std::string series(std::size_t K) const {
    const ChartSeries &S = Content.Series[K];
    std::string Out;
    if (Content.Bars) {
      const double Share =
          0.8 * place() / static_cast<double>(Content.Series.size());
      for (std::size_t I = 0; I < S.Values.size(); ++I)
        Out +=
            fmt::format("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" "
                        "height=\"{:.1f}\" class=\"bar{}\"/>\n",
                        x(I) - 0.4 * place() + static_cast<double>(K) * Share,
                        y(S.Values[I]), Share, Bottom - y(S.Values[I]), K);
      return Out;
    }
    Out = "<polyline points=\"";
    for (std::size_t I = 0; I < S.Values.size(); ++I)
      Out += fmt::format("{:.1f},{:.1f} ", x(I), y(S.Values[I]));
    return Out + fmt::format("\" class=\"line{}\" stroke-width=\"2\" "
                             "stroke-dasharray=\"{}\"/>\n",
                             K, Dashes[K % Dashes.size()]);
  }

  /// Below \p Y, which becomes its end.
  std::string legend(double &Y) const {
    if (Content.Series.size() < 2)
      return "";
    std::string Out;
    double X = Left;
    Y += LineHeight + 4;
    for (std::size_t K = 0; K < Content.Series.size(); ++K) {
      const double Each = 34 + widthOf(Content.Series[K].Name) + 14;
      if (X > Left && X + Each > Right) {
        X = Left;
        Y += LineHeight;
      }
      Out += Content.Bars
                 ? fmt::format("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"14\" "
                               "height=\"12\" class=\"bar{}\"/>\n",
                               X + 12, Y - 11, K)
                 : fmt::format("<line x1=\"{0:.1f}\" y1=\"{1:.1f}\" "
                               "x2=\"{2:.1f}\" y2=\"{1:.1f}\" "
                               "class=\"line{3}\" stroke-width=\"2\" "
                               "stroke-dasharray=\"{4}\"/>\n",
                               X, Y - 5, X + 26, K, Dashes[K % Dashes.size()]);
      Out += text(X + 32, Y, "start", "soft", Content.Series[K].Name);
      X += Each;
    }
    return Out;
  }

  const Chart &Content;
  double PlotLeft = Left, Top = 0, Bottom = 0;
  double Step = 1, WidestLabel = 0;
  double XEnd = 0, XStep = 1; ///< of numbers along x, if there are any
  int YSteps = 1;
  bool IsSlanted = false;
};

} // namespace

std::string svgOf(const Chart &C) { return Drawing(C).document(); }

} // namespace vorion::splat
