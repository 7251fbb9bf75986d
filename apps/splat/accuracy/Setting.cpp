#include "accuracy/Setting.h"

#include "mesh/Mesh.h"
#include "vorion/support/Suggest.h"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sstream>

namespace vorion::splat {

/// The values of a knob whose choices are an enumeration's.
template <typename Choices>
static std::vector<std::string> namesOf(const Choices &Of) {
  std::vector<std::string> Names;
  Names.reserve(Of.size());
  for (const auto One : Of)
    Names.emplace_back(name(One));
  return Names;
}

const std::vector<Knob> &allKnobs() {
  static const std::vector<Knob> All{
      {KnobId::Exp, "exp", namesOf(ExpUnits), "exp"},
      {KnobId::Blend, "blend", namesOf(BlendUnits), ""},
      {KnobId::AlphaCutoff,
       "alpha-cutoff",
       {"1", "2", "4", "8"},
       "alpha-cutoff"},
      {KnobId::Cutoff,
       "cutoff",
       {"0.0001", "0.001", "0.003", "0.01", "0.03"},
       "cutoff"},
      {KnobId::Tile, "tile", {"64", "32", "16"}, ""},
      {KnobId::Support, "support", {"exact", "box3", "square3"}, "support"},
      {KnobId::ShDegree, "sh-degree", {"3", "2", "1", "0"}, "sh-degree"},
      {KnobId::DepthBits,
       "depth-bits",
       {"32", "24", "20", "16", "12"},
       "depth-bits"},
      {KnobId::ZTiles, "ztiles", {"1", "2", "4", "8"}, ""},
      {KnobId::PixelUnit,
       "pixel-unit",
       {"off", "last:1/4", "last:1/2", "occluded:0.9"},
       ""},
      {KnobId::SkipSaturated, "skip-saturated", {"off", "on"}, ""},
      {KnobId::SubpixelBits,
       "subpixel-bits",
       {"8", "6", "4"},
       "subpixel-bits",
       false},
      {KnobId::MeshDepth, "mesh-depth", namesOf(DepthFormats), "mesh-depth",
       false},
      {KnobId::FilterBits,
       "filter-bits",
       {"fp32", "8", "6", "4"},
       "filter-bits",
       false},
  };
  return All;
}

const std::vector<Knob> &trainKnobs() {
  static const std::vector<Knob> All{
      {KnobId::Reciprocal, "reciprocal", namesOf(Reciprocals), ""},
      {KnobId::Sum, "sum", {"tree", "rows"}, ""},
  };
  return All;
}

const Knob &knob(KnobId Id) {
  const auto Found = std::ranges::find(allKnobs(), Id, &Knob::Id);
  return Found != allKnobs().end()
             ? *Found
             : *std::ranges::find(trainKnobs(), Id, &Knob::Id);
}

static const Knob *findIn(const std::vector<Knob> &Knobs,
                          const std::string &Name) {
  const auto Found = std::ranges::find(Knobs, Name, &Knob::Name);
  return Found == Knobs.end() ? nullptr : &*Found;
}

std::vector<std::string> knobNames() {
  std::vector<std::string> Names;
  Names.reserve(allKnobs().size());
  for (const Knob &K : allKnobs())
    Names.push_back(K.Name);
  return Names;
}

/// What pictures of knobsNamed() lack for knob \p Id; empty if nothing.
static std::string_view missing(KnobId Id, const Mesh *Surface, bool Parallel) {
  switch (Id) {
  case KnobId::SubpixelBits:
    return Surface ? "" : "a mesh";
  case KnobId::MeshDepth:
    // Integer depths fall with 1/z.
    return !Surface ? "a mesh" : Parallel ? "no orthographic camera" : "";
  case KnobId::FilterBits:
    return Surface && Surface->hasTextures() ? "" : "a mesh with textures";
  case KnobId::ZTiles:
    return Surface && Surface->has(AlphaMode::Blend)
               ? "a mesh without transparency"
               : "";
  default:
    return "";
  }
}

Expected<std::vector<Knob>> knobsNamed(const std::vector<std::string> &Names,
                                       const Mesh *Surface, bool Parallel) {
  for (const std::string &Name : Names) {
    const Knob *K = findIn(allKnobs(), Name);
    if (!K)
      return Error{
          "",
          fmt::format("--knobs {}: unknown knob, expected one or more of {}{}",
                      Name, fmt::join(knobNames(), ", "),
                      didYouMean(Name, knobNames())),
          ExitCode::Usage};
    if (const auto Lacks = missing(K->Id, Surface, Parallel); !Lacks.empty())
      return Error{"", fmt::format("--knobs {}: expected {}", Name, Lacks),
                   ExitCode::Usage};
  }
  std::vector<Knob> Found;
  for (const Knob &K : allKnobs())
    if (Names.empty() ? missing(K.Id, Surface, Parallel).empty()
                      : std::ranges::find(Names, K.Name) != Names.end())
      Found.push_back(K);
  return Found;
}

/// Parses "exp=poly3"; empty if knob or value are unknown.
static std::optional<Choice> choiceOf(const std::string &Text) {
  const std::size_t Equals = Text.find('=');
  const Knob *K = findIn(allKnobs(), Text.substr(0, Equals));
  if (!K || Equals == std::string::npos)
    return std::nullopt;
  const auto Value = std::ranges::find(K->Values, Text.substr(Equals + 1));
  if (Value == K->Values.end())
    return std::nullopt;
  return Choice{K->Id, static_cast<std::size_t>(Value - K->Values.begin())};
}

Setting Setting::with(const Knob &K, std::size_t Value) const {
  Setting S = *this;
  if (Value != 0)
    S.Choices.push_back({K.Id, Value});
  return S;
}

std::string Setting::name() const {
  std::string Text;
  for (const Choice &C : Choices)
    Text += fmt::format("{}{}={}", Text.empty() ? "" : ",", knob(C.Id).Name,
                        value(C.Id));
  return Text.empty() ? "default" : Text;
}

Expected<Setting> Setting::parse(const std::string &Name) {
  const auto Wrong = [&](const std::string &What) {
    return Error{"",
                 fmt::format("setting '{}': {}, expected default or "
                             "KNOB=VALUE,... with knobs of {}",
                             Name, What, fmt::join(knobNames(), ", ")),
                 ExitCode::Usage};
  };
  if (Name == "default")
    return Setting();
  std::vector<Choice> Parts;
  std::istringstream In(Name);
  for (std::string Part; std::getline(In, Part, ',');) {
    const auto Found = choiceOf(Part);
    if (!Found)
      return Wrong(fmt::format("unknown choice '{}'", Part));
    Parts.push_back(*Found);
  }
  // One order, so that a setting has one name.
  std::ranges::sort(Parts, {}, &Choice::Id);
  Setting S;
  for (std::size_t I = 0; I < Parts.size(); ++I) {
    const Knob &K = knob(Parts[I].Id);
    if (I > 0 && Parts[I - 1].Id == Parts[I].Id)
      return Wrong(fmt::format("duplicate knob {}", K.Name));
    S = S.with(K, Parts[I].Value);
  }
  return S;
}

std::size_t Setting::place(KnobId Id) const {
  const auto Found = std::ranges::find(Choices, Id, &Choice::Id);
  return Found == Choices.end() ? 0 : Found->Value;
}

ExpUnit Setting::exponential() const { return ExpUnits[place(KnobId::Exp)]; }

BlendUnit Setting::arithmetic() const {
  return BlendUnits[place(KnobId::Blend)];
}

Support Setting::support() const {
  constexpr Support All[] = {Support::Exact, Support::Box3, Support::Square3};
  return *std::ranges::find(All, value(KnobId::Support),
                            [](Support S) { return splat::name(S); });
}

bool Setting::hasCost() const {
  return std::ranges::all_of(
      Choices, [](const Choice &C) { return knob(C.Id).HasCost; });
}

/// A flag has the values off and on.
static void append(std::vector<std::string> &To, const std::string &Option,
                   const std::string &Value) {
  To.push_back("--" + Option);
  if (Value != "on")
    To.push_back(Value);
}

std::vector<std::string> Setting::arguments() const {
  std::vector<std::string> Out{"--path", "raster"};
  for (const Choice &C : Choices)
    append(Out, knob(C.Id).Name, value(C.Id));
  return Out;
}

std::optional<std::vector<std::string>> Setting::coresArguments() const {
  std::vector<std::string> Out{"--path", "simt"};
  if (!isOnCores(exponential()))
    return std::nullopt;
  for (const Choice &C : Choices) {
    const std::string &Option = knob(C.Id).CoresName;
    if (Option.empty())
      return std::nullopt;
    append(Out, Option, value(C.Id));
  }
  return Out;
}

std::vector<Setting> singleChanges(const std::vector<Knob> &Knobs) {
  std::vector<Setting> All{Setting()};
  for (const Knob &K : Knobs)
    for (std::size_t V = 1; V < K.Values.size(); ++V)
      All.push_back(Setting().with(K, V));
  return All;
}

} // namespace vorion::splat
