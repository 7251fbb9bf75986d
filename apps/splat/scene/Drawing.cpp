#include "scene/Drawing.h"

#include "io/Bytes.h"
#include "vorion/support/Letters.h"

#include <charconv>
#include <fmt/format.h>
#include <limits>

namespace vorion::splat {
namespace {

constexpr std::string_view ModeKey = "splatrendermode:";
constexpr std::string_view FlagKey = "antialiased ";
constexpr std::string_view DilationKey = "dilation:";
constexpr std::string_view RendererKey = "splatrenderer:";
constexpr std::string_view DegreeKey = "splatfalloffdegree:";
/// What Brush dilates by where it compensates, as Mip-Splatting does.
constexpr double BrushDilation = 0.1;

std::string lowered(std::string_view Text) {
  return lowerCase(std::string(trimmed(Text)));
}

/// The value after \p Key, if \p Text begins with it.
std::optional<std::string_view> after(std::string_view Key,
                                      std::string_view Text) {
  if (!Text.starts_with(Key))
    return std::nullopt;
  return trimmed(Text.substr(Key.size()));
}

Error unknown(const std::string &Where, std::string_view Source,
              std::string_view Expected) {
  return {Where,
          fmt::format("{} selects an unknown rendering mode, expected {}",
                      printable(Source), Expected)};
}

/// Takes one comment of those that say something into \p D.
std::optional<Error> take(const std::string &Where, std::string_view Comment,
                          Drawing &D) {
  const std::string Lower = lowered(Comment);
  const auto Source = [Comment] {
    return "comment " + printable(trimmed(Comment));
  };
  if (const auto Mode = after(ModeKey, Lower)) {
    if (*Mode != "default" && *Mode != "mip" && *Mode != "2dgs")
      return unknown(Where, Source(), "SplatRenderMode: default, mip or 2dgs");
    if (*Mode == "2dgs")
      D.Renderer = RendererKind::Surfel;
    D.Antialiased = *Mode == "mip";
    D.Source = Source();
  } else if (const auto Flag = after(FlagKey, Lower)) {
    // Another word makes it a sentence about something.
    if (*Flag != "0" && *Flag != "1")
      return std::nullopt;
    D.Antialiased = *Flag == "1";
    D.Source = Source();
  } else if (const auto Value = after(DilationKey, Lower)) {
    double Dilation = 0;
    const auto [End, Status] =
        std::from_chars(Value->begin(), Value->end(), Dilation);
    if (Status != std::errc() || End != Value->end() || !isDilation(Dilation))
      return unknown(Where, Source(), ExpectedDilation);
    D.Dilation = Dilation;
  } else if (const auto Renderer = after(RendererKey, Lower)) {
    const auto Found = trainedRenderer(*Renderer);
    if (!Found)
      return unknown(Where, Source(), "SplatRenderer: splat, ray or surfel");
    D.Renderer = *Found;
  } else if (const auto Degree = after(DegreeKey, Lower)) {
    if (*Degree != "2" && *Degree != "4")
      return unknown(Where, Source(), "SplatFalloffDegree: 2 or 4");
    D.FalloffDegree = *Degree == "4" ? 4 : 2;
  }
  return std::nullopt;
}

} // namespace

std::optional<RendererKind> trainedRenderer(std::string_view Name) {
  for (const RendererKind K : TrainedRenderers)
    if (name(K) == Name)
      return K;
  return std::nullopt;
}

bool isDilation(double Variance) {
  return Variance >= 0 && Variance <= std::numeric_limits<float>::max();
}

Expected<Drawing> drawingOfComments(const std::string &Where,
                                    std::span<const std::string> Comments) {
  Drawing D;
  bool FromBrush = false;
  for (const std::string &Comment : Comments) {
    FromBrush |= lowered(Comment) == "exported from brush";
    if (auto Wrong = take(Where, Comment, D))
      return *Wrong;
  }
  if (FromBrush && D.Antialiased && !D.Dilation)
    D.Dilation = BrushDilation;
  return D;
}

Expected<Drawing> drawingOfModel(const std::string &Where,
                                 std::string_view Model) {
  const std::string Source = fmt::format("model {}", printable(Model));
  if (Model != "default" && Model != "antialiased" && Model != "2dgs")
    return unknown(Where, Source, "model default, antialiased or 2dgs");
  return Drawing{Model == "antialiased", std::nullopt, Source,
                 Model == "2dgs" ? RendererKind::Surfel : RendererKind::Splat};
}

Drawing withRequest(Drawing D, const DrawingRequest &R) {
  if (R.Antialiased) {
    const bool Against = *R.Antialiased != D.Antialiased;
    std::string Source = *R.Antialiased ? "--antialiased" : "--no-antialiased";
    if (Against && !D.Source.empty())
      Source += ", against " + D.Source;
    if (Against) // what the file dilates by belongs to its way
      D.Dilation.reset();
    D.Antialiased = *R.Antialiased;
    D.Source = std::move(Source);
  }
  if (R.Dilation)
    D.Dilation = R.Dilation;
  D.Renderer = R.Renderer.value_or(D.Renderer);
  D.FalloffDegree = R.FalloffDegree.value_or(D.FalloffDegree);
  return D;
}

std::string drawingComments(const Drawing &D) {
  std::string Lines;
  if (D.Renderer != RendererKind::Splat)
    Lines += fmt::format("comment SplatRenderer: {}\n", name(D.Renderer));
  if (D.FalloffDegree != 2)
    Lines += fmt::format("comment SplatFalloffDegree: {}\n", D.FalloffDegree);
  if (D.Antialiased)
    Lines += "comment SplatRenderMode: mip\n";
  if (D.Dilation)
    Lines += fmt::format("comment Dilation: {}\n", *D.Dilation);
  return Lines;
}

} // namespace vorion::splat
