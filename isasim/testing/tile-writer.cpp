/// A plugin that writes the tiles of a run, as far as a rasterizer is given
/// them, to the file that VORION_RASTER_TILES names, or else to
/// raster-tiles.bin in the current folder.
#include "raster/WorkLog.h"
#include "testing/RasterTile.h"
#include "vorion/isasim/Machine.h"
#include "vorion/isasim/Plugin.h"
#include "vorion/support/Environment.h"

#include <cstring>

using namespace vorion;
using namespace vorion::isasim;

namespace {

class TileWriter : public Observer {
public:
  TileWriter() {
    const char *Name = environmentVariable("VORION_RASTER_TILES");
    File = std::fopen(Name ? Name : "raster-tiles.bin", "wb");
  }
  ~TileWriter() override {
    if (File)
      std::fclose(File);
  }
  TileWriter(const TileWriter &) = delete;
  TileWriter &operator=(const TileWriter &) = delete;

private:
  void runBegins(const RunStart &Start) override { Device = Start.Device; }

  void rasterCommand(const raster::CommandWork &Work) override {
    const raster::Job &J = Work.What;
    if (!File || !Device || J.Refusal || J.IsBackward || J.TakesPushed ||
        !J.Units.isConic())
      return;
    RasterTile T;
    std::snprintf(T.What.Name.data(), T.What.Name.size(), "%u,%u", J.X, J.Y);
    T.What.X = J.X;
    T.What.Y = J.Y;
    T.What.Width = J.Width;
    T.What.Height = J.Height;
    T.What.Cutoff = J.Blend.StopBelow;
    T.What.Gaussians = J.Count;
    const uint32_t Bytes = T.recordBytes();
    T.Input.resize(size_t{J.Count} * Bytes / 4);
    for (uint32_t N = 0; N != J.Count; ++N) {
      uint32_t Entry = 0;
      std::memcpy(&Entry, Device->hostPointer(J.List + 4 * N, 4), 4);
      Entry &= ~raster::VR_INTERSECT;
      std::memcpy(&T.Input[size_t{N} * Bytes / 4],
                  Device->hostPointer(J.Gaussians + Bytes * Entry, Bytes),
                  Bytes);
    }
    T.write(File);
  }

  std::FILE *File = nullptr;
  Machine *Device = nullptr;
};

} // namespace

const Plugin vorion_plugin = {.Make = []() -> std::unique_ptr<Observer> {
  return std::make_unique<TileWriter>();
}};
