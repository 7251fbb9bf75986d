// Sizes of pictures and of lists.
#include "Build.h"

#include <fmt/format.h>

namespace vorion::test {
namespace {

HardCase empty() {
  HardCase C{
      "empty-picture",
      "nothing is seen: lists of 0, no pair to sort, the background once",
      {},
      frontView(70, 50, 50),
      {}};
  C.Options.Background = {0.25F, 0.5F, 0.125F};
  add(C.Scene, {.Mean = {0, 0, -1}});
  C.ExpectedCulls[0] = 1;
  C.FoundIn = {"background-twice"};
  return C;
}

HardCase picture(int Width, int Height) {
  HardCase C{fmt::format("picture-{}x{}", Width, Height),
             Width == 1 ? "one pixel, one Gaussian"
                        : "odd sides and partial tiles on both paths",
             {},
             frontView(Width, Height, 40),
             {}};
  C.Options.Background = {0.25F, 0.5F, 0.125F};
  Numbers R(static_cast<uint32_t>(Width));
  add(C.Scene, {.Scale = {0.3, 0.3, 0.3}});
  for (int I = 0; I < (Width == 1 ? 0 : 20); ++I)
    add(C.Scene,
        {.Mean = {static_cast<float>(R.uniform(-0.5, 0.5) * Width / 20),
                  static_cast<float>(R.uniform(-0.5, 0.5) * Height / 20),
                  static_cast<float>(R.uniform(1.9, 2.1))},
         .Scale = {0.2, 0.1, 0.1},
         .Quat = R.turn(),
         .Color = R.color()});
  C.FoundIn = {"background-twice"};
  if (Width > 64)
    C.FoundIn.emplace_back("last-column-lost");
  return C;
}

HardCase listLengths() {
  HardCase C{"list-lengths",
             "lists of 0, 1, 16, 17, 63, 64, 65 and 128 in neighbouring tiles: "
             "around warps and batches",
             {},
             frontView(512, 16, 50),
             {}};
  Numbers R(31);
  int Tile = 0;
  for (const int Length : {0, 1, 16, 17, 63, 64, 65, 128}) {
    for (int I = 0; I < Length; ++I) {
      const double Column = 64 * Tile + 24 + R.uniform(0, 16);
      add(C.Scene, {.Mean = {static_cast<float>((Column - 256) / 25),
                             static_cast<float>(R.uniform(-0.2, 0.2)), 2},
                    .Scale = {0.1, 0.1, 0.1},
                    .Opacity = 0.06,
                    .Color = R.color()});
    }
    ++Tile;
  }
  C.FoundIn = {"list-cut-at-8", "last-entry-lost"};
  return C;
}

} // namespace

void addLists(std::vector<HardCase> &Cases) {
  Cases.push_back(empty());
  Cases.push_back(picture(1, 1));
  Cases.push_back(picture(17, 13));
  Cases.push_back(picture(65, 3));
  Cases.push_back(picture(129, 67));
  Cases.push_back(listLengths());
}

} // namespace vorion::test
