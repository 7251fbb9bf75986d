#include "view/ShownScene.h"

#include "scene/SceneWriter.h"

namespace vorion::splat {

Expected<Success> writeShown(const std::string &Path, const ShownScene &S) {
  Scene InOwnFrame = S.File.Gaussians;
  InOwnFrame.setOrigin({});
  if (auto Written = writeScene(Path, InOwnFrame, S.File.DrawnAs); !Written)
    return Written.error();
  return Success{};
}

} // namespace vorion::splat
