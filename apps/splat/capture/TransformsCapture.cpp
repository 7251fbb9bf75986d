#include "capture/TransformsCapture.h"

#include "capture/Photo.h"
#include "capture/Transforms.h"
#include "io/Inside.h"
#include "vorion/support/File.h"
#include "vorion/support/Json.h"
#include "vorion/support/Printable.h"

#include <algorithm>
#include <fmt/format.h>
#include <optional>

namespace vorion::splat {

namespace fs = std::filesystem;

namespace {

/// Completes views whose size the file does not say.
Expected<Success> setSizes(TransformsFile &T) {
  std::optional<PhotoSize> Size;
  for (TransformsView &V : T.Views) {
    if (V.hasSize())
      continue;
    // All of a file are of one size; the first says which.
    if (!Size) {
      const auto Picture = readRegularFile(V.Picture);
      if (!Picture)
        return Picture.error();
      const auto Read = photoSize(V.Picture, *Picture);
      if (!Read)
        return Read.error();
      Size = *Read;
    }
    V.Pose.Width = Size->Width;
    V.Pose.Height = Size->Height;
    complete(V.Pose, V.Known);
  }
  return Success{};
}

/// The pictures of \p T, a file in \p Folder.
std::vector<fs::path> picturesOf(const fs::path &Folder,
                                 const TransformsFile &T,
                                 const std::string &Given,
                                 std::vector<std::string> &Notes) {
  std::vector<std::string> Names;
  Names.reserve(T.Views.size());
  for (const TransformsView &V : T.Views)
    Names.push_back(V.Pose.Name);
  return findPictures(
             pictureFolders({CaptureFormat::Transforms, {}, Folder, {}}, Given),
             Names, Notes)
      .Files;
}

Expected<TransformsFile> transformsOf(const fs::path &File) {
  const auto Content = readRegularFile(File.string(), JsonLimits().Bytes);
  if (!Content)
    return Content.error();
  return parseTransforms(File.string(), *Content);
}

} // namespace

Expected<Success> readTransforms(const fs::path &File, ViewSet Set,
                                 const CaptureOptions &Options, Capture &C) {
  auto T = transformsOf(File);
  if (!T)
    return T.error();
  const fs::path Folder = File.parent_path();
  const std::vector<fs::path> Pictures =
      picturesOf(Folder, *T, Options.Images, C.Notes);
  for (std::size_t I = 0; I < T->Views.size(); ++I) {
    TransformsView &V = T->Views[I];
    if (auto Straight = checkPinhole(File.string(), "frame", V, Options);
        !Straight)
      return Straight;
    if (auto Inside = checkInside(File.string(), V.Pose.Name, Options); !Inside)
      return Inside;
    V.Picture = Pictures[I].string();
    if (Options.Masks != MaskSource::Files) {
      V.Mask.clear();
    } else if (V.Mask.empty()) {
      V.Mask = maskOf(Folder / "masks", fs::path(V.Picture).filename());
    } else {
      if (auto Inside = checkInside(File.string(), V.Mask, Options); !Inside)
        return Inside;
      V.Mask = (Folder / V.Mask).string();
    }
  }
  // A test set is often passed on without its pictures.
  if (Set == ViewSet::Test)
    leaveOutMissing(T->Views, C);
  else if (auto Left = leaveOutSome(T->Views, C); !Left)
    return Left;
  if (auto Sized = setSizes(*T); !Sized)
    return Sized;
  if (Set == ViewSet::All &&
      std::ranges::any_of(T->Views, &TransformsView::HeldOut))
    C.HeldOutBy = "val_filenames and test_filenames";
  if (Set == ViewSet::Test && !T->Views.empty())
    C.HeldOutBy = File.filename().string();
  for (TransformsView &V : T->Views) {
    V.HeldOut = Set == ViewSet::Test || (Set == ViewSet::All && V.HeldOut);
    C.Views.push_back(std::move(V));
  }
  if (T->Points.empty())
    return Success{};
  if (auto Inside = checkInside(File.string(), T->Points, Options); !Inside)
    return Inside;
  const std::string Points = (Folder / T->Points).string();
  const auto Cloud = readRegularFile(Points);
  if (!Cloud)
    return Cloud.error();
  auto Parsed = parsePointCloud(Points, *Cloud);
  if (!Parsed)
    return Parsed.error();
  C.Points = std::move(*Parsed);
  return Success{};
}

Expected<Success> addTransformsCameras(const fs::path &File, LensOf Of,
                                       CaptureCameras &To) {
  auto T = transformsOf(File);
  if (!T)
    return T.error();
  const fs::path Folder = File.parent_path();
  std::vector<std::string> Notes;
  const std::vector<fs::path> Pictures = picturesOf(Folder, *T, {}, Notes);
  for (std::size_t I = 0; I < T->Views.size(); ++I) {
    TransformsView &V = T->Views[I];
    // Nothing outside the folder is opened for a size. Who draws has no
    // --allow-outside.
    if (!staysInside(V.Pose.Name) && !V.hasSize())
      return isOutside(File.string(), V.Pose.Name, "the keys w and h");
    V.Picture = Pictures[I].string();
  }
  if (auto Sized = setSizes(*T); !Sized)
    return Sized;
  for (TransformsView &V : T->Views)
    if (auto Added = addCamera(File.string(), std::move(V), Of, To); !Added)
      return Added;
  To.Files.push_back(File.string());
  return Success{};
}

void addTransformsFiles(const fs::path &File, std::vector<fs::path> &To) {
  To.push_back(File);
  std::error_code Ignored;
  if (!fs::is_regular_file(File, Ignored)) // a pipe can be read only once
    return;
  const auto T = transformsOf(File);
  if (!T)
    return;
  const fs::path Folder = File.parent_path();
  std::vector<std::string> Notes;
  const std::vector<fs::path> Pictures = picturesOf(Folder, *T, {}, Notes);
  for (std::size_t I = 0; I < T->Views.size(); ++I) {
    const TransformsView &V = T->Views[I];
    const fs::path &Picture = Pictures[I];
    To.push_back(Picture);
    To.push_back(V.Mask.empty()
                     ? fs::path(maskOf(Folder / "masks", Picture.filename()))
                     : Folder / V.Mask);
  }
  if (!T->Points.empty())
    To.push_back(Folder / T->Points);
}

} // namespace vorion::splat
