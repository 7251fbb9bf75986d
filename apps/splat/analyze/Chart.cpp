#include "analyze/Chart.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <fmt/format.h>

namespace vorion::splat {
namespace {

constexpr double Width = 640, Height = 420;
constexpr double Left = 86, Right = 622, Top = 44, Bottom = 352;
constexpr int MostYSteps = 5;

/// Okabe and Ito's colours, which the colour-blind can tell apart.
constexpr std::array<const char *, 5> Colors = {"#0072b2", "#d55e00", "#009e73",
                                                "#cc79a7", "#000000"};
constexpr std::array<const char *, 5> Dashes = {"none", "7 3", "2 3", "9 3 2 3",
                                                "1 2"};

std::string escaped(const std::string &Text) {
  std::string Out;
  for (const char C : Text)
    Out += C == '<'   ? "&lt;"
           : C == '>' ? "&gt;"
           : C == '&' ? "&amp;"
                      : std::string(1, C);
  return Out;
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

std::string text(double X, double Y, const char *Anchor,
                 const std::string &Content, const char *More = "") {
  return fmt::format(
      "<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\"{}>{}</text>\n", X, Y,
      Anchor, More, escaped(Content));
}

std::string line(double X0, double Y0, double X1, double Y1,
                 const char *Color) {
  return fmt::format("<line x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" "
                     "y2=\"{:.1f}\" stroke=\"{}\"/>\n",
                     X0, Y0, X1, Y1, Color);
}

/// Where values lie on the page.
class Page {
public:
  explicit Page(const Chart &Content) : Content(Content) {
    double Largest = 0;
    for (const ChartSeries &S : Content.Series) {
      assert(S.Values.size() == Content.Places.size());
      for (const double V : S.Values)
        Largest = std::max(Largest, V);
    }
    Step = stepFor(Largest);
    YSteps = std::max(1, static_cast<int>(std::ceil(Largest / Step)));
  }

  double place() const {
    return (Right - Left) / static_cast<double>(Content.Places.size());
  }
  /// The middle of place \p I.
  double x(std::size_t I) const {
    return Left + (static_cast<double>(I) + 0.5) * place();
  }
  double y(double Value) const {
    return Bottom - Value / (Step * YSteps) * (Bottom - Top);
  }

  std::string axes() const {
    std::string Out;
    for (int K = 0; K <= YSteps; ++K) {
      const double Value = K * Step;
      Out += line(Left, y(Value), Right, y(Value), K ? "#d0d0d0" : "#000000");
      Out += text(Left - 6, y(Value) + 4, "end", fmt::format("{:.6g}", Value));
    }
    for (std::size_t I = 0; I < Content.Places.size(); I += Content.LabelEvery)
      Out += text(x(I), Bottom + 18, "middle", Content.Places[I]);
    Out += text((Left + Right) / 2, Bottom + 40, "middle", Content.XLabel);
    Out += text(Width / 2, 22, "middle", Content.Title, " font-size=\"15\"");
    Out += fmt::format("<text transform=\"translate(18 {:.1f}) rotate(-90)\" "
                       "text-anchor=\"middle\">{}</text>\n",
                       (Top + Bottom) / 2, escaped(Content.YLabel));
    return Out;
  }

  std::string series(std::size_t K) const {
    const ChartSeries &S = Content.Series[K];
    const char *Color = Colors[K % Colors.size()];
    std::string Out;
    if (Content.Bars) {
      const double Share =
          0.8 * place() / static_cast<double>(Content.Series.size());
      for (std::size_t I = 0; I < S.Values.size(); ++I)
        Out +=
            fmt::format("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" "
                        "height=\"{:.1f}\" fill=\"{}\"/>\n",
                        x(I) - 0.4 * place() + static_cast<double>(K) * Share,
                        y(S.Values[I]), Share, Bottom - y(S.Values[I]), Color);
      return Out;
    }
    Out = "<polyline points=\"";
    for (std::size_t I = 0; I < S.Values.size(); ++I)
      Out += fmt::format("{:.1f},{:.1f} ", x(I), y(S.Values[I]));
    return Out + fmt::format("\" fill=\"none\" stroke=\"{}\" "
                             "stroke-width=\"2\" stroke-dasharray=\"{}\"/>\n",
                             Color, Dashes[K % Dashes.size()]);
  }

  std::string legend() const {
    if (Content.Series.size() < 2)
      return "";
    std::string Out;
    const double Each =
        (Right - Left) / static_cast<double>(Content.Series.size());
    for (std::size_t K = 0; K < Content.Series.size(); ++K) {
      const double X = Left + static_cast<double>(K) * Each;
      Out += fmt::format("<line x1=\"{0:.1f}\" y1=\"{1:.1f}\" x2=\"{2:.1f}\" "
                         "y2=\"{1:.1f}\" stroke=\"{3}\" stroke-width=\"{4}\" "
                         "stroke-dasharray=\"{5}\"/>\n",
                         X, Height - 12, X + 26, Colors[K % Colors.size()],
                         Content.Bars ? 10 : 2,
                         Content.Bars ? "none" : Dashes[K % Dashes.size()]);
      Out += text(X + 32, Height - 8, "start", Content.Series[K].Name);
    }
    return Out;
  }

private:
  const Chart &Content;
  double Step = 1;
  int YSteps = 1;
};

} // namespace

std::string svgOf(const Chart &C) {
  const Page P(C);
  std::string Out = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0} {1}\" "
      "width=\"{0}\" height=\"{1}\" font-family=\"serif\" font-size=\"13\">\n"
      "<rect width=\"{0}\" height=\"{1}\" fill=\"#ffffff\"/>\n",
      Width, Height);
  Out += P.axes();
  for (std::size_t K = 0; K < C.Series.size(); ++K)
    Out += P.series(K);
  return Out + P.legend() + "</svg>\n";
}

} // namespace vorion::splat
