#include "view/ShownScene.h"

#include "scene/SceneWriter.h"

namespace vorion::splat {

void joinMeshes(ShownScene &S) {
  S.Surface = joined(S.OwnMesh, S.AddedMesh.Triangles, S.File.Gaussians.Origin);
}

Expected<Success> writeShown(const std::string &Path, const ShownScene &S) {
  Scene InOwnFrame = S.File.Gaussians;
  InOwnFrame.setOrigin({});
  if (auto Written = writeScene(Path, InOwnFrame, S.File.DrawnAs,
                                [&](GltfWriter &To) {
                                  if (S.OwnMesh)
                                    addMesh(To, *S.OwnMesh);
                                });
      !Written)
    return Written.error();
  return Success{};
}

} // namespace vorion::splat
