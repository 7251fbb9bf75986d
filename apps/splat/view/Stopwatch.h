/// How long the machine takes for a view of `splat view`: by a process of its
/// own, which finds the machine as new as `splat render --time` does. A frame
/// after others would find caches and memory as they have left them.
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
#include <utility>
#include <vector>

namespace vorion::splat {

/// What a frame took on the machine.
struct MachineTime {
  uint64_t Cycles = 0;
  double Milliseconds = 0;
  std::string On; ///< the machine and its clock (ClockedMachine.h)
  /// By the names of the stages that have any.
  std::vector<std::pair<std::string, uint64_t>> Stages;
  std::vector<TileWork> Tiles;
};

class Stopwatch {
public:
  /// \p Words: of `splat render`, for the device.
  Stopwatch(TemporaryFolder F, std::vector<std::string> Words,
            DeviceOptions Machine)
      : Folder(std::move(F)), DeviceWords(std::move(Words)),
        Machine(std::move(Machine)) {}

  /// Measures the view and the setting of \p R; the last few are kept. Where
  /// \p GiveUp says so on the way, the error is \c superseded().
  Expected<std::shared_ptr<const MachineTime>>
  measure(const ShownScene &S, const ViewRequest &R,
          const std::function<bool()> &GiveUp);

  /// A file for a scene that has none.
  std::string sceneFile(uint64_t Number) const;

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
  std::deque<Kept> Last; ///< by the lock; newest first
};

} // namespace vorion::splat
