#include "python/Arrays.h"
#include "python/Bindings.h"
#include "python/Objects.h"

#include "commands/Choices.h"
#include "commands/DeviceArguments.h"
#include "commands/EnergyArguments.h"
#include "commands/MeshArguments.h"
#include "commands/PictureOptions.h"
#include "picture/SceneUnit.h"
#include "render/FrameTime.h"
#include "render/Gradients.h"
#include "render/MeshRules.h"
#include "render/Pictures.h"
#include "render/Report.h"

#include <fmt/format.h>
#include <memory>
#include <mutex>
#include <nlohmann/json.hpp>
#include <optional>
#include <pybind11/stl.h>
#include <unistd.h>

namespace vorion::splat::python {

namespace py = pybind11;
using Json = nlohmann::ordered_json;

namespace {

/// Lets Python end a run between two stages, as with Ctrl-C. The GIL is
/// released while it watches.
class Interrupts {
public:
  /// Fails \p L if a signal's handler has raised something.
  void look(Launcher &L) {
    const py::gil_scoped_acquire Held;
    if (PyErr_CheckSignals() == 0)
      return;
    Raised.emplace();
    L.fail({"", "interrupted"});
  }
  /// Throws what was raised. The GIL is held.
  void rethrow() const {
    if (Raised)
      throw *Raised;
  }

private:
  std::optional<py::error_already_set> Raised;
};

/// The process that opened the first machine. One that is forked from it has
/// none of the threads that OpenCL and the machine wait for, and holds whatever
/// locks they held.
pid_t OpenedIn = 0;

void checkProcess() {
  if (OpenedIn != 0 && OpenedIn != ::getpid())
    throw Failed(
        {"",
         fmt::format(
             "process {} was forked from process {} after that had opened a "
             "machine, and has none of its threads, expected a new process "
             "(the start methods spawn and forkserver of multiprocessing)",
             ::getpid(), OpenedIn),
         ExitCode::Usage});
}

/// A device with what was compiled for it.
class Machine {
public:
  Machine(const std::string &Name, const DeviceOptions &Options)
      : Own(new State{valueOf(Device::open(Name, Options))}) {}
  ~Machine() {
    if (OpenedIn != ::getpid()) {
      // Its release would wait for ever.
      [[maybe_unused]] const State *Left = Own.release();
    }
  }

  const Device &device() const { return Own->Dev; }

  /// What watches a run: the clock may be on in this one alone.
  DeviceOptions watching(bool Timed) const {
    DeviceOptions O = device().options();
    if (O.clockRuns() == ClockText::Runs::Profiled)
      // By the option of splat, whose reports say the same.
      O.set("VORION_TIME", Timed ? "on" : "", Timed ? "--time" : "");
    return O;
  }

  /// What \p Run gives with a launcher of this machine; throws its error. One
  /// run at a time, without the GIL. \p Timed: the clock of the machine is on.
  template <typename Function> auto run(bool Timed, const Function &Run) {
    Interrupts Signals;
    checkProcess();
    std::optional<Failed> Failure;
    auto Result = [&] {
      const py::gil_scoped_release Released;
      const std::lock_guard Turn(Own->Lock);
      Launcher *Mine = nullptr;
      Launcher L(
          Own->Dev, "", [&](std::string_view) { Signals.look(*Mine); },
          &Own->Programs);
      Mine = &L;
      L.setProfiled(Timed);
      auto Got = Run(L);
      if (Got)
        L.recordBuilds();
      else
        Failure.emplace(Got.error(), L.buildLog());
      return Got;
    }();
    Signals.rethrow();
    if (Failure)
      throw Failed(*Failure);
    return std::move(*Result);
  }

private:
  struct State {
    explicit State(Device D) : Dev(std::move(D)) {}
    Device Dev;
    ProgramCache Programs;
    std::mutex Lock;
  };
  std::unique_ptr<State> Own;
};

/// As vorion.Machine has them, texts by variables with the arguments that gave
/// them: the clock is on where a run asks for it, unless
/// \p Options or the environment say when.
std::unique_ptr<Machine> openMachine(
    const std::string &Name,
    const std::map<std::string, std::pair<std::string, std::string>> &Given) {
  DeviceOptions Options;
  for (const auto &[Variable, By] : Given)
    Options.set(Variable, By.first, By.second);
  if ((Options.text("VORION_TIME").empty() ||
       Options.clockRuns() == ClockText::Runs::Never) &&
      Options.text("VORION_REGION").empty())
    Options.set("VORION_TIME", "profiled");
  checkProcess();
  OpenedIn = ::getpid();
  const py::gil_scoped_release Released;
  return std::make_unique<Machine>(Name, Options);
}

/// What made a picture, as --json has it, but of files.
py::object reportOf(const Machine &M, const SceneFile &S, const Camera &C,
                    const RenderOptions &O, const RenderPlan &Plan,
                    const RenderResult &R,
                    const std::optional<EnergyRequest> &Energy = {}) {
  Json Report{{"program", {{"name", "vorion"}, {"version", VORION_VERSION}}},
              {"scene",
               {{"gaussians", S.Gaussians.size()},
                {"sh_degree", S.Gaussians.ShDegree}}}};
  Report.update(valueOf(drawnJson(C, O, Plan, M.device(), R)));
  if (Json Time = frameJson(R.Stages); !Time.is_null())
    Report["time"] = std::move(Time);
  if (Energy)
    Report["energy"] = valueOf(frameEnergyJson(R.Stages, *Energy));
  return toPython(Report);
}

Shape sizesOf(const Camera &C) {
  return {static_cast<std::size_t>(C.Height),
          static_cast<std::size_t>(C.Width)};
}

/// What a picture is to have beside its colours (render/Layers.h).
struct Layers {
  bool Depth = false, Normals = false;
  bool Visible = false; ///< the mesh in each pixel
  DepthAs As = DepthAs::Accumulated;
  unsigned Top = 0; ///< contributors of a pixel

  bool needDepths() const { return Depth && As != DepthAs::Median; }
  bool needLists() const {
    return Top != 0 || (Depth && As == DepthAs::Median);
  }
};

/// Declares what of them is more than a flag.
void addLayers(CLI::App &App, Layers &L) {
  addChoice(App, "--depth-as", L.As,
            {DepthAs::Accumulated, DepthAs::Expected, DepthAs::Median}, "");
  App.add_option("--contributors", L.Top)->check(isBetween(0U, MaxTop));
}

/// Adds \p Triangles, null for none, to \p O for a scene in the frame of
/// \p Drawn.
void placeMesh(std::shared_ptr<Mesh> Triangles, const Scene &Drawn,
               RenderOptions &O) {
  if (O.Light && !Triangles)
    throw Failed(lightWithoutMesh());
  O.Surface = joined(std::move(Triangles), nullptr, Drawn.Origin);
  valueOf(checkMeshCamera(O, ""));
}

/// By name; what was not asked for is None.
py::dict layersOf(const Layers &L, RenderResult &R, const RenderOptions &O,
                  const Shape &Sizes) {
  py::dict By;
  By["depth"] = L.Depth ? py::object(arrayOf(depthsOf(R, O, L.As).Depth, Sizes))
                        : py::none();
  By["normals"] = L.Normals ? py::object(arrayOf(std::move(R.Normals->Render),
                                                 {Sizes[0], Sizes[1], 3}))
                            : py::none();
  By["visible"] = py::none();
  if (L.Visible) {
    VisibleMesh &V = *R.MeshShown;
    py::dict Shown;
    const Shape Planes{V.LayerDepths.size() / V.Depth.size(), Sizes[0],
                       Sizes[1]};
    Shown["depth"] = arrayOf(std::move(V.Depth), Sizes);
    Shown["triangle"] = arrayOf(std::move(V.Triangles), Sizes);
    if (Planes[0] != 0) {
      Shown["layer_depth"] = arrayOf(std::move(V.LayerDepths), Planes);
      Shown["layer_triangle"] = arrayOf(std::move(V.LayerTriangles), Planes);
    }
    By["visible"] = std::move(Shown);
  }
  By["contributors"] = py::none();
  if (L.Top != 0) {
    Contributors Of = topContributors(*R.Lists, O, L.Top);
    const Shape Several{Sizes[0], Sizes[1], L.Top};
    By["contributors"] = py::make_tuple(arrayOf(std::move(Of.Indices), Several),
                                        arrayOf(std::move(Of.Weights), Several),
                                        arrayOf(std::move(Of.Counts), Sizes));
  }
  return By;
}

py::tuple render(Machine &M, const SceneFile &S, const Camera &C,
                 std::shared_ptr<Mesh> Triangles, Words Given, bool Depth,
                 bool Normals, bool Visible, bool Timed) {
  DrawArguments A;
  Layers Beside{Depth, Normals, Visible};
  EnergyArguments Asked;
  parse(std::move(Given), [&](CLI::App &App) {
    addDrawOptions(App, A);
    addMeshPrecisionOptions(App, A.Options);
    addLightOption(App, A.Options.Light);
    addLayers(App, Beside);
    addEnergyOptions(App, Asked, "the picture");
  });
  const auto Energy = valueOf(requestedEnergy(Asked, std::nullopt));
  Timed |= Energy.has_value();
  valueOf(parseDrawTexts(A));
  A.Options.Optics = C.Optics.Model;
  A.Options.Rolling = C.Optics.Shutter.has_value();
  valueOf(checkDrawOptions(A.Options));
  if (Beside.needLists())
    valueOf(checkPixelLists(A.Options, Beside.Top != 0 ? "--contributors"
                                                       : "--depth-as median"));
  valueOf(checkBlends(M.device(), A.Options.Blending));
  drawAs(A.Options, S.DrawnAs);
  std::optional<Scene> Copy;
  const Scene &Drawn = preparedToDraw(S.Gaussians, {C}, A.Options.Convention,
                                      A.Options.Near, Copy);
  if (Triangles && (Normals || Beside.needLists()))
    throw Failed(layersBesideMesh());
  placeMesh(std::move(Triangles), Drawn, A.Options);
  valueOf(checkMeshPrecision(A.Options, ""));
  if (Visible && !A.Options.Surface)
    throw Failed({"", "visible shows a mesh, expected mesh", ExitCode::Usage});
  A.Options.KeepVisible = Visible;
  valueOf(checkTransparency(A.Options, Beside.needDepths()));
  RenderPlan Plan;
  RenderResult R = M.run(Timed, [&](Launcher &L) -> Expected<RenderResult> {
    if (auto Finite = checkFinite("the scene", Drawn); !Finite)
      return Finite.error();
    const ViewFacts Facts = factsOfAll(Drawn, {C}, A.Options);
    Plan = planRender(
        EffectPlan(A.Request, {Drawn, A.Options, Facts,
                               /*KeepPairs=*/false, Beside.needDepths(),
                               M.watching(Timed), Normals, Beside.needLists()}),
        A.Options);
    warnOfMissing(Plan.Effects, A.Effects);
    return splat::render(L, Plan, Drawn, C, A.Options,
                         /*KeepPairs=*/false);
  });
  const Shape Sizes = sizesOf(C);
  py::object Report = reportOf(M, S, C, A.Options, Plan, R, Energy);
  py::dict By = layersOf(Beside, R, A.Options, Sizes);
  return py::make_tuple(
      arrayOf(std::move(R.Picture.Render), {Sizes[0], Sizes[1], 3}),
      arrayOf(std::move(R.Picture.Alpha), Sizes), std::move(By),
      std::move(Report));
}

/// \p Stored: by logarithms of scales and logits of opacities.
py::tuple gradients(Machine &M, const SceneFile &S, const Camera &C,
                    std::shared_ptr<Mesh> Triangles, const FloatArray &ByImage,
                    const FloatArray &ByAlpha, Words Given, bool Stored,
                    bool Timed) {
  RenderOptions O;
  BackwardOptions B;
  parse(std::move(Given), [&](CLI::App &App) {
    addGradientOptions(App, O, B);
    addLightOption(App, O.Light);
  });
  O.Optics = C.Optics.Model;
  O.Rolling = C.Optics.Shutter.has_value();
  valueOf(checkGradientOptions(O, B));
  valueOf(checkBlends(M.device(), O.Blending));
  B.Parameters = Stored ? GradientsOf::Stored : GradientsOf::Activated;
  drawAs(O, S.DrawnAs);
  std::optional<Scene> Copy;
  const Scene &Drawn =
      preparedToDraw(S.Gaussians, {C}, O.Convention, O.Near, Copy);
  placeMesh(std::move(Triangles), Drawn, O);
  valueOf(checkOpaque(O));
  const Shape Sizes = sizesOf(C);
  const Shape Colours{Sizes[0], Sizes[1], 3};
  const PixelGradients U{valuesOf(ByImage, "v_image", Colours),
                         valuesOf(ByAlpha, "v_alpha", Sizes)};
  GradientResult R = M.run(Timed, [&](Launcher &L) -> Expected<GradientResult> {
    if (auto Finite = checkFinite("the scene", Drawn); !Finite)
      return Finite.error();
    return takeGradients(L, Drawn, C, O, B, U);
  });
  const std::size_t N = S.Gaussians.size();
  SceneGradients &G = R.Gradients;
  py::dict By;
  By["means"] = arrayOf(std::move(G.Means), {N, 3});
  By["quats"] = arrayOf(std::move(G.Quats), {N, 4});
  By[Stored ? "log_scales" : "scales"] = arrayOf(std::move(G.Scales), {N, 3});
  By[Stored ? "opacity_logits" : "opacities"] =
      arrayOf(std::move(G.Opacities), {N});
  By["sh"] = arrayOf(std::move(G.Sh), {N, S.Gaussians.coefficients(), 3});
  By["means2d"] = arrayOf(std::move(G.Means2d), {N, 2});
  By["conics"] = arrayOf(std::move(G.Conics), {N, 3});
  py::object Report = reportOf(M, S, C, O, gradientPlan(Drawn, C, O), R);
  return py::make_tuple(arrayOf(std::move(R.Picture.Render), Colours),
                        arrayOf(std::move(R.Picture.Alpha), Sizes),
                        std::move(By), std::move(Report));
}

/// Names of the options that \p Declare adds, without "--".
Words optionNames(const std::function<void(CLI::App &)> &Declare) {
  CLI::App App;
  App.set_help_flag();
  Declare(App);
  Words Names;
  for (const CLI::Option *O : App.get_options())
    Names.insert(Names.end(), O->get_lnames().begin(), O->get_lnames().end());
  return Names;
}

} // namespace

void addMachine(py::module_ &M) {
  py::class_<Machine>(M, "Machine")
      .def(py::init(&openMachine))
      .def_property_readonly(
          "name", [](const Machine &Of) { return Of.device().name(); })
      .def("render", render)
      .def("gradients", gradients);
  M.def("render_options", [] {
    DrawArguments A;
    Layers Beside;
    EnergyArguments Energy;
    return optionNames([&](CLI::App &App) {
      addDrawOptions(App, A);
      addMeshPrecisionOptions(App, A.Options);
      addLightOption(App, A.Options.Light);
      addLayers(App, Beside);
      addEnergyOptions(App, Energy, "");
    });
  });
  M.def("gradient_options", [] {
    RenderOptions O;
    BackwardOptions B;
    return optionNames([&](CLI::App &App) {
      addGradientOptions(App, O, B);
      addLightOption(App, O.Light);
    });
  });
}

} // namespace vorion::splat::python
