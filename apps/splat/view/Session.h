/// The device and the scene that `splat view` keeps between frames.
#pragma once

#include "render/Renderer.h"
#include "view/FairLock.h"
#include "view/Judge.h"
#include "view/PageCalls.h"
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
#include <vector>

namespace vorion::splat {

/// A picture that the device has drawn.
struct DrawnView {
  uint64_t Scene = 0;
  ViewRequest Request; ///< that it was first drawn for
  RenderResult Result;
  nlohmann::ordered_json Effects; ///< what the view needs, and why
};

/// What the page gets.
struct ViewAnswer {
  nlohmann::ordered_json Facts;
  std::string Rgba; ///< rows from the top
};

class Session {
public:
  struct Setup {
    std::string Device, Kernels;
    DeviceOptions Machine;
    ReadOptions Reading;                   ///< of dropped scenes
    std::vector<std::string> ReadingWords; ///< the same for `splat render`
    std::vector<Camera> Cameras;           ///< as photographs have them
    bool ThroughLens = false; ///< to begin with, where a camera has a choice
    int Width = 480, Height = 272;
  };

  /// Opens the device and shows \p First.
  static Expected<std::unique_ptr<Session>> open(Setup S, ShownScene First);

  /// Device, scene, cameras and knobs, as JSON.
  std::string describe() const;

  /// Draws what \p R asks for. What takes long, which is the clock and the
  /// reference, is done for one call after the other, in the order in which
  /// they came. It ends without an answer, which is an error, if \p From has
  /// left or calls again.
  Expected<ViewAnswer> frame(const ViewRequest &R, const Asker &From);

  /// Ends what takes long, now and later.
  void giveUp() { Ending = true; }

  /// What a pixel is made of, as JSON.
  std::string pixel(const ViewRequest &R);

  /// Shows the scene in \p Content, a file \p Name. If it is none, the error
  /// says so and the old scene stays.
  Expected<Success> replace(std::string Name, const std::string &Content);

private:
  Session(Setup S, Device D, TemporaryFolder F);
  void show(ShownScene Next);
  std::shared_ptr<const ShownScene> scene() const;

  Expected<std::shared_ptr<const DrawnView>>
  drawn(const ViewRequest &R, const std::shared_ptr<const ShownScene> &S);
  /// Needs the device's lock.
  std::shared_ptr<const DrawnView> findDrawn(const ViewRequest &R,
                                             uint64_t Scene) const;
  Expected<DrawnView> drawNew(const ViewRequest &R, const ShownScene &S);
  Expected<GaussianBuffers> uploaded(Launcher &L, const RenderPlan &Plan,
                                     const ShownScene &S);

  const Setup Settings;
  Device Dev;
  Judge Reference;
  Stopwatch Clock;

  std::mutex ReplaceLock; ///< one scene is opened after the other
  mutable std::mutex SceneLock;
  std::shared_ptr<const ShownScene> Shown; ///< by this lock

  PageCalls Calls; ///< of frame()
  std::atomic<bool> Ending = false;
  FairLock DeviceLock;
  /// \name By this lock
  /// @{
  ProgramCache Programs;
  uint64_t Uploaded = 0; ///< number of the scene in Gaussians
  std::array<bool, MaxShDegree> UploadedBands{};
  GaussianBuffers OnDevice;           ///< activated: no camera changes that
  std::optional<ViewFacts> Facts;     ///< of all views of a scene so far
  uint64_t FactsOf = 0;               ///< its number
  const LensModel *FactsBy = nullptr; ///< of these views
  std::deque<std::shared_ptr<const DrawnView>> Kept; ///< newest first
  /// @}
};

} // namespace vorion::splat
