#include "render/Report.h"

#include "cameras/CameraFile.h"
#include "device/Configuration.h"
#include "io/Hash.h"
#include "io/ReportHead.h"
#include "mesh/Mesh.h"
#include "render/Explain.h"
#include "render/FrameTime.h"
#include "render/Gradients.h"
#include "vorion/support/File.h"
#include "vorion/support/Letters.h"
#include "vorion/support/Printable.h"

#include <fmt/format.h>
#include <initializer_list>
#include <nlohmann/json.hpp>

namespace vorion::splat {

using Json = nlohmann::ordered_json;

namespace {

Json json(const KernelCounters &C) {
  Json Object;
  for (const CounterInfo &Counter : KernelCounterTable)
    Object[Counter.Name] = C.*Counter.Member;
  return Object;
}

/// The sum of the counters of all kernels, where they were counted.
std::optional<KernelCounters> sum(const std::vector<KernelReport> &Kernels) {
  std::optional<KernelCounters> Sum;
  for (const KernelReport &K : Kernels)
    if (K.Counters) {
      Sum = Sum.value_or(KernelCounters{});
      *Sum += *K.Counters;
    }
  return Sum;
}

Json json(const StageReport &S) {
  Json Kernels = Json::array();
  for (const KernelReport &K : S.Kernels) {
    Json One{
        {"name", K.Name}, {"launches", K.Launches}, {"seconds", K.Seconds}};
    if (K.Counters)
      One["counters"] = json(*K.Counters);
    Kernels.push_back(std::move(One));
  }
  return {{"name", name(S.Kind)}, {"seconds", S.Seconds}, {"kernels", Kernels}};
}

Json json(const std::vector<ProgramSpec> &Programs) {
  Json All = Json::array();
  for (const ProgramSpec &P : Programs)
    All.push_back(
        {{"name", P.name()}, {"files", {P.File}}, {"defines", P.Defines}});
  return All;
}

struct Totals {
  double Seconds = 0;
  std::optional<KernelCounters> Counters;
};

Totals totals(const RenderResult &R) {
  Totals T;
  for (const StageReport &S : R.Stages) {
    T.Seconds += S.Seconds;
    if (const auto Counted = sum(S.Kernels)) {
      T.Counters = T.Counters.value_or(KernelCounters{});
      *T.Counters += *Counted;
    }
  }
  return T;
}

} // namespace

Json stagesJson(const std::vector<StageReport> &Stages) {
  Json All = Json::array();
  for (const StageReport &S : Stages)
    All.push_back(json(S));
  return All;
}

static std::string
hashOf(std::initializer_list<const std::vector<float> *> Results) {
  std::string All;
  for (const std::vector<float> *Values : Results)
    All.append(reinterpret_cast<const char *>(Values->data()),
               Values->size() * sizeof(float));
  return fnv1a64(All);
}

std::string pictureHash(const Image &P) {
  return hashOf({&P.Render, &P.Alpha});
}

static std::string resultHash(const RenderRecord &R) {
  const Image &P = R.Result.Picture;
  if (!R.Back)
    return pictureHash(P);
  const SceneGradients &G = R.Back->Gradients;
  return hashOf({&P.Render, &P.Alpha, &G.Means2d, &G.Conics, &G.Means, &G.Quats,
                 &G.Scales, &G.Opacities, &G.Sh, &G.Sums});
}

Expected<Json> drawnJson(const Camera &View, const RenderOptions &O,
                         const RenderPlan &Plan, const Device &Dev,
                         const RenderResult &Result) {
  Json Device{{"name", Dev.name()},
              {"version", Dev.version()},
              {"compute_units", Dev.computeUnits()},
              {"global_bytes", Dev.globalBytes()}};
  if (Dev.isVorion()) {
    auto Configuration = machineConfiguration(Dev.options());
    if (!Configuration)
      return Configuration.error();
    Device["configuration"] = std::move(*Configuration);
  }
  Json Culled;
  for (std::size_t I = 0; I < CullReasons.size(); ++I)
    Culled[std::string(CullReasons[I])] = Result.Culled[I];
  const Totals T = totals(Result);
  Json Total{{"seconds", T.Seconds}};
  if (T.Counters)
    Total["counters"] = json(*T.Counters);
  Json Report{{"view", View.Name},
              {"resolution", {View.Width, View.Height}},
              {"rules", name(O.Convention)},
              {"support", name(O.Reach)},
              {"path", name(O.Blending)},
              {"options",
               {{"renderer", name(O.Kind)},
                {"falloff_degree", O.FalloffDegree},
                {"tile", O.tileSize()},
                {"ztiles", O.ZTiles},
                {"pixel_unit", toString(O.PixelUnit)},
                {"skip_saturated", O.SkipSaturated},
                {"cull_blocks", O.CullBlocks},
                {"deal", name(O.Deal)},
                {"tile_height", O.tileHeight()},
                {"simt_group", O.SimtGroup},
                {"order", name(O.Order)},
                {"ray_window", O.RayWindow},
                {"ray_restart", name(O.Restart)},
                {"antialiased", O.Antialiased},
                {"antialiased_by", O.AntialiasedBy},
                {"dilation", O.Dilation},
                {"background", O.Background},
                {"cutoff", O.Cutoff},
                {"alpha_cutoff", O.AlphaCutoff},
                {"depth_bits", O.DepthBits},
                {"sh_limit", O.ShLimit},
                {"camera_model", O.Optics->Name},
                {"projection", name(O.Through)},
                {"near", O.nearLimit()},
                {"exp", name(O.Exponential)},
                {"blend", name(O.Arithmetic)}}},
              {"effects", effectsJson(Plan.Effects)},
              {"programs", json(Plan.Programs)},
              {"device", Device},
              {"counts",
               {{"visible", Result.Visible},
                {"culled", Culled},
                {"pairs", Result.Pairs},
                {"device_bytes", Result.DeviceBytes}}},
              {"stages", stagesJson(Result.Stages)},
              {"total", Total}};
  if (const auto &Rays = Result.Rays)
    Report["rays"] = {{"rays", Rays->Rays},
                      {"nodes", Rays->Nodes},
                      {"evaluated", Rays->Evaluated},
                      {"blended", Rays->Blended},
                      {"most_blended", Rays->MostBlended},
                      {"restarts", Rays->Restarts}};
  if (const Mesh *M = O.Surface.get())
    Report["mesh"] = {
        {"vertices", M->vertices()},
        {"triangles", M->triangles()},
        {"textures", M->Textures.size()},
        {"subpixel_bits", O.SubpixelBits},
        {"depth", name(O.MeshDepth)},
        {"filter_bits", O.FilterBits ? Json(*O.FilterBits) : Json()},
        {"light", O.Light ? Json(*O.Light) : Json()},
        {"material", O.IsMirror ? Json("mirror") : Json()}};
  return Report;
}

Expected<Json> jsonReport(const RenderRecord &R) {
  auto SceneHash = hashScene(R.ScenePath);
  if (!SceneHash)
    return SceneHash.error();
  Expected<std::string> CameraHash = fnv1a64({}); // where none are read
  if (!R.CameraFile.empty())
    CameraHash = hashCameraFile(R.CameraFile);
  if (!CameraHash)
    return CameraHash.error();
  auto Drawn = drawnJson(R.View, R.Options, R.Plan, R.Dev, R.Result);
  if (!Drawn)
    return Drawn;
  Json Report = reportHead(R.Back ? "splat-gradients" : "splat-render", 2);
  Report.update(
      {{"scene",
        {{"file", R.ScenePath},
         {"fnv1a64", *SceneHash},
         {"gaussians", R.Gaussians},
         {"dropped_nonfinite", R.Input.Dropped},
         {"sh_degree", R.Input.Gaussians.ShDegree},
         {"format", name(R.Input.Format)},
         {"axes_changed", R.AxesChange}}},
       {"cameras", {{"file", R.CameraFile}, {"fnv1a64", *CameraHash}}},
       {"picture", R.Output},
       {"result_fnv1a64", resultHash(R)}});
  Report.update(*Drawn);
  if (const Mesh *M = R.Options.Surface.get())
    Report["mesh"]["file"] = M->file();
  if (R.Back) {
    auto Hash = fnv1a64OfFile(R.Back->Upstream);
    if (!Hash)
      return Hash.error();
    Report["backward"] = {{"upstream", R.Back->Upstream}, {"fnv1a64", *Hash}};
    // Units that the cores do not have.
    if (R.Options.Blending == Path::Raster) {
      Report["backward"]["reciprocal"] = name(R.Back->Options.Unit);
      Report["backward"]["sums"] = name(R.Back->Options.Order);
    } else {
      Report["backward"]["simt_sums"] = name(R.Back->Options.Pixels);
    }
  }
  if (Json Time = frameJson(R.Result.Stages); !Time.is_null())
    Report["time"] = std::move(Time);
  return Report;
}

std::string textReport(const Camera &View, const RenderOptions &Options,
                       const Device &Dev, const RenderResult &Result) {
  std::string Text = fmt::format(
      "{} {}x{} on {}: {} rules, support {}, path {}\n{} seen, {} with "
      "tiles of {}x{}\n",
      escaped(View.Name), View.Width, View.Height, Dev.name(),
      name(Options.Convention), name(Options.Reach), name(Options.Blending),
      counted(Result.Visible, "Gaussian"), counted(Result.Pairs, "pair"),
      Options.tileSize(), Options.tileHeight());
  Text += "culled:";
  for (std::size_t I = 0; I < CullReasons.size(); ++I)
    Text += fmt::format("{} {} {}", I == 0 ? "" : ",", Result.Culled[I],
                        CullReasons[I]);
  Text += '\n';
  Text += fmt::format("{:<16}{:>10}{:>16}{:>18}{:>14}\n", "stage", "seconds",
                      "warp instr.", "lane instr.", "raster blends");
  const auto Row = [&](std::string_view Name, double Seconds,
                       const std::optional<KernelCounters> &C) {
    Text += fmt::format("{:<16}{:>10.3f}", Name, Seconds);
    if (C)
      Text += fmt::format("{:>16}{:>18}{:>14}", C->WarpInstructions,
                          C->LaneInstructions, C->RasterBlends);
    Text += '\n';
  };
  for (const StageReport &S : Result.Stages)
    Row(name(S.Kind), S.Seconds, sum(S.Kernels));
  const Totals T = totals(Result);
  Row("total", T.Seconds, T.Counters);
  return Text + frameText(Result.Stages);
}

} // namespace vorion::splat
