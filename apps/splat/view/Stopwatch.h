/// Measures the simulated time of a view of `splat view` in a separate process,
/// which starts with a new machine, as `splat render --time` does. In this
/// process, the state of caches and memory would depend on earlier frames.
#pragma once

#include "device/DeviceOptions.h"
#include "device/TileWork.h"
#include "view/FairLock.h"
#include "view/Request.h"
#include "view/ShownScene.h"
#include "vorion/support/TemporaryFolder.h"

#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace vorion::splat {

/// The time of a frame on the machine.
struct MachineTime {
  uint64_t Cycles = 0;
  double Milliseconds = 0;
  std::string On; ///< the machine and its clock (ClockedMachine.h)
  /// Cycles by name of the stages.
  std::vector<std::pair<std::string, uint64_t>> Stages;
  std::vector<TileWork> Tiles; ///< empty with a mesh
};

class Stopwatch {
public:
  /// \p Words: device options of `splat render`.
  Stopwatch(TemporaryFolder F, std::vector<std::string> Words,
            DeviceOptions Machine)
      : Folder(std::move(F)), DeviceWords(std::move(Words)),
        Machine(std::move(Machine)) {}

  /// Measures the view and the setting of \p R; the last few results are
  /// cached. If \p GiveUp returns true, the error is \c superseded().
  Expected<std::shared_ptr<const MachineTime>>
  measure(const ShownScene &S, const ViewRequest &R,
          const std::function<bool()> &GiveUp);

  /// The file name for a scene without a file, with the extension \p Ending.
  std::string sceneFile(uint64_t Number, std::string_view Ending) const;

  /// The arguments of `splat` that draw \p R with the only camera of the file
  /// \p Cameras and with the mesh \p Mesh (empty: none), without the output.
  std::vector<std::string> words(const std::string &Scene,
                                 const std::string &Mesh, const ShownScene &S,
                                 const ViewRequest &R,
                                 const std::string &Cameras) const;

private:
  struct Kept {
    uint64_t Scene;
    Camera View;
    Setting Chosen;
    std::shared_ptr<const MachineTime> Time;
  };

  TemporaryFolder Folder;
  std::vector<std::string> DeviceWords;
  DeviceOptions Machine;
  FairLock Lock;
  std::deque<Kept> Last; ///< protected by Lock; newest first
};

} // namespace vorion::splat
