#include "Damage.h"
#include "SceneFile.h"
#include "TestFiles.h"

#include <limits>

using namespace vorion;
using namespace vorion::splat;
using namespace vorion::splat::testing;

namespace {

TEST(SceneFile, IsToldByItsContentNotItsName) {
  const TestFolder Root;
  for (const SampleFile &F : sampleFiles()) {
    const auto Read = readScene(Root.write("scene.ply", F.Content));
    ASSERT_TRUE(Read) << F.Name << ": " << Read.error().What;
    const std::string_view Ending = name(Read->Format);
    EXPECT_NE(
        F.Name.find(Ending == "compressed-ply" ? "compressed.ply" : Ending),
        std::string::npos)
        << F.Name << " read as " << Ending;
  }
}

TEST(SceneFile, MissingFilesAndEmptyFoldersAreErrors) {
  const TestFolder Root;
  for (const std::string &Path :
       {Root.path("absent"), Root.path("."), std::string()}) {
    const auto Read = readScene(Path);
    ASSERT_FALSE(Read) << Path;
    EXPECT_EQ(Read.error().Code, ExitCode::InputFile);
  }
}

TEST(SceneFile, EveryValueThatIsNotFiniteIsFound) {
  for (const float Bad : {std::numeric_limits<float>::quiet_NaN(),
                          std::numeric_limits<float>::infinity(),
                          -std::numeric_limits<float>::infinity()})
    for (int Field = 0; Field < 5; ++Field) {
      Scene S = numberedScene(3, 1);
      std::vector<float> *Fields[] = {&S.Means, &S.LogScales, &S.Quats,
                                      &S.OpacityLogits, &S.Sh};
      std::vector<float> &V = *Fields[Field];
      V[2 * V.size() / 3 - 1] = Bad; // the last of Gaussian 1
      const auto Checked = checkFinite("s", S);
      ASSERT_FALSE(Checked);
      EXPECT_EQ(Checked.error().What, "Gaussian 1 holds a NaN or an infinity, "
                                      "expected finite values");
    }
  EXPECT_TRUE(checkFinite("s", numberedScene(3, 1)));
}

} // namespace
