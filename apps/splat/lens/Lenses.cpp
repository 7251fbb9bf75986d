#include "lens/Lenses.h"

#include "lens/Models.h"
#include "vorion/support/Letters.h"

#include <algorithm>
#include <vector>

namespace vorion::splat {

namespace {

std::string oneOf(const std::vector<std::string> &Names) {
  std::string Text;
  for (std::size_t I = 0; I < Names.size(); ++I)
    Text += (I == 0 ? "" : I + 1 == Names.size() ? " or " : ", ") + Names[I];
  return Text;
}

} // namespace

std::span<const LensModel *const> lenses::all() {
  static constexpr std::array List{
#define VORION_LENS(Name) &(Name),
#include "reference/lens/Lenses.def"
  };
  return List;
}

const LensModel *lensModelNamed(std::string_view Name) {
  const std::string Upper = upperCase(std::string(Name));
  for (const LensModel *M : lenses::all())
    for (const auto &Names : {M->Names, M->OtherNames})
      if (std::ranges::find(Names, std::string_view(Upper)) != Names.end())
        return M;
  return nullptr;
}

const LensModel *lensModelOfViewer(std::string_view Name) {
  for (const LensModel *M : lenses::all())
    if (!M->ViewerName.empty() && M->ViewerName == Name)
      return M;
  return nullptr;
}

std::string knownLensModels() {
  std::vector<std::string> Names;
  for (const LensModel *M : lenses::all())
    Names.insert(Names.end(), M->Names.begin(), M->Names.end());
  return oneOf(Names);
}

std::string knownViewerModels() {
  std::vector<std::string> Names;
  for (const LensModel *M : lenses::all())
    if (!M->ViewerName.empty())
      Names.push_back('"' + std::string(M->ViewerName) + '"');
  return oneOf(Names);
}

} // namespace vorion::splat
