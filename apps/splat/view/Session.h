/// The state of `splat view` between frames: device and scene.
#pragma once

#include "render/Renderer.h"
#include "view/FairLock.h"
#include "view/Judge.h"
#include "view/PageCalls.h"
#include "view/Picked.h"
#include "view/Request.h"
#include "view/ShownScene.h"
#include "view/Stopwatch.h"

#include <array>
#include <atomic>
#include <deque>
#include <memory>
#include <mutex>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace vorion::splat {

/// A picture that the device has rendered.
struct DrawnView {
  uint64_t Scene = 0;
  ViewRequest Request; ///< the first request for it
  RenderResult Result;
  nlohmann::ordered_json Effects; ///< effects of the view with their reasons
};

/// The response to the page.
struct ViewAnswer {
  nlohmann::ordered_json Facts;
  std::string Rgba; ///< rows from the top
};

class Session {
public:
  struct Setup {
    std::string Device, Kernels;
    DeviceOptions Machine;
    ReadOptions Reading;                   ///< for scenes that the page sends
    std::vector<std::string> ReadingWords; ///< the same as options of `splat
                                           ///< render`
    std::vector<Camera> Cameras;           ///< with the lenses of photographs
    bool ThroughLens = false; ///< initial state, for cameras with both
    /// Width and height of pictures at rest; empty: the page decides.
    std::optional<std::pair<int, int>> Size;
  };

  /// Opens the device and shows \p First.
  static Expected<std::unique_ptr<Session>> open(Setup S, ShownScene First);

  /// Device, scene, cameras and knobs, as JSON.
  std::string describe() const;

  /// The number of the scene, as JSON.
  std::string number() const;

  /// Executes the request \p R. Slow parts (clock and reference) are executed
  /// for one call at a time, in the order of calls. They end with an error if
  /// \p From is gone or calls again.
  Expected<ViewAnswer> frame(const ViewRequest &R, const Asker &From);

  /// Cancels slow parts of current and future calls.
  void giveUp() { Ending = true; }

  /// The Gaussians and triangles of a pixel, as JSON.
  Expected<std::string> pixel(const ViewRequest &R);

  /// The line for a shell that draws the picture of \p R, as JSON: `splat
  /// render` in the folder of this process, with a file of its camera.
  Expected<std::string> command(const ViewRequest &R) const;

  /// Shows the file \p Name with \p Content: a scene takes the place of all
  /// that is shown, a mesh that of the last mesh beside a scene. On an error
  /// nothing changes.
  Expected<Success> replace(std::string Name, const std::string &Content);

  /// Which Gaussians \p R selects, and where \c R.View shows them: pairs of
  /// floats, little endian, in place of the pixels.
  Expected<ViewAnswer> selection(const PickedRequest &R) const;

  /// Changes the scene. Undo takes the last change back. On an error the scene
  /// stays.
  Expected<Success> edit(const PickedRequest &R);

  /// The bytes of the scene in the format of the extension of \p Name.
  Expected<std::string> saved(const std::string &Name);

private:
  Session(Setup S, Device D, TemporaryFolder F);
  Expected<Success> replaceMesh(std::string Name, const std::string &Content);
  void change(ShownScene Next);
  void show(ShownScene Next);
  std::shared_ptr<const ShownScene> scene() const;

  Expected<std::shared_ptr<const DrawnView>>
  drawn(const ViewRequest &R, const std::shared_ptr<const ShownScene> &S);
  /// Requires the device lock.
  std::shared_ptr<const DrawnView> findDrawn(const ViewRequest &R,
                                             uint64_t Scene) const;
  Expected<DrawnView> drawNew(const ViewRequest &R, const ShownScene &S);
  Expected<GaussianBuffers> uploaded(Launcher &L, const RenderPlan &Plan,
                                     const ShownScene &S);

  const Setup Settings;
  Device Dev;
  Judge Reference;
  Stopwatch Clock;

  std::mutex ReplaceLock; ///< scenes are opened and edited one at a time
  /// \name Protected by ReplaceLock
  /// @{
  std::shared_ptr<const ShownScene> Opened; ///< the scene before its edits;
                                            ///< empty without edits
  /// The edit that removed each of its Gaussians, from 1; 0 for the others.
  std::vector<unsigned> RemovedBy;
  unsigned Edits = 0;
  /// @}
  std::atomic<unsigned> Saves = 0;
  mutable std::mutex SceneLock;
  std::shared_ptr<const ShownScene> Shown; ///< protected by SceneLock

  PageCalls Calls; ///< of frame()
  std::atomic<bool> Ending = false;
  FairLock DeviceLock;
  /// \name Protected by DeviceLock
  /// @{
  ProgramCache Programs;
  uint64_t Uploaded = 0; ///< number of the scene in Gaussians
  std::array<bool, MaxShDegree> UploadedBands{};
  GaussianBuffers OnDevice;           ///< activated, which does not depend on
                                      ///< the camera
  std::optional<ViewFacts> Facts;     ///< of all views of a scene so far
  uint64_t FactsOf = 0;               ///< number of this scene
  const LensModel *FactsBy = nullptr; ///< lens of these views
  std::deque<std::shared_ptr<const DrawnView>> Kept; ///< newest first
  /// @}
};

} // namespace vorion::splat
