#include "commands/OutputFile.h"

#include "io/ReportHead.h"
#include "scene/SceneFile.h"
#include "vorion/support/CommandLine.h"
#include "vorion/support/File.h"
#include "vorion/support/Letters.h"
#include "vorion/support/Printable.h"
#include "vorion/support/Suggest.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <fmt/format.h>
#include <system_error>

namespace vorion::splat {
namespace {

/// Endings that promise a kind of file to whoever sees them, besides those of
/// scenes.
constexpr std::array<std::string_view, 16> OtherKinds{
    ".png", ".jpg", ".jpeg", ".webp", ".exr",  ".pfm", ".npz", ".npy",
    ".svg", ".pdf", ".html", ".csv",  ".json", ".glb", ".mp4", ".webm"};

Error badName(std::string_view Option, const std::string &File,
              std::string_view What) {
  return {"", fmt::format("{} {}: {}", Option, escaped(File), What),
          ExitCode::Usage};
}

/// The known kind that \p File's ending promises, the longest that there is
/// (a compressed PLY's ending ends with PLY's), or nothing.
std::string_view promised(const std::string &File) {
  const std::string Lower = lowerCase(File);
  std::string_view Longest;
  const auto Try = [&](std::string_view Ending) {
    if (Lower.ends_with(Ending) && Ending.size() > Longest.size())
      Longest = Ending;
  };
  for (const SceneFormatRecord &F : sceneFormats())
    Try(F.Ending);
  for (const std::string_view Ending : OtherKinds)
    Try(Ending);
  return Longest;
}

/// What a user takes for the ending.
std::string endingOf(const std::string &File) {
  return lowerCase(std::filesystem::path(File).extension().string());
}

/// Standard output, a device or a pipe, whose name promises nothing.
bool isStream(const std::string &File) {
  std::error_code Ignored;
  const std::filesystem::file_status Status =
      std::filesystem::status(File, Ignored);
  return File == StandardOutput || (std::filesystem::exists(Status) &&
                                    !std::filesystem::is_regular_file(Status) &&
                                    !std::filesystem::is_directory(Status));
}

} // namespace

Expected<Success> checkEnding(std::string_view Option, const std::string &File,
                              const std::vector<std::string_view> &Endings) {
  const auto Ends = [&File](std::string_view E) { return File.ends_with(E); };
  const std::string_view Kind = promised(File);
  // An ending may be a whole name, as meta.json.
  const auto Fits = [&](std::string_view E) {
    return Ends(E) && E.ends_with(Kind);
  };
  if (File.empty() || isStream(File) || std::ranges::any_of(Endings, Fits))
    return Success{};
  std::string Listed;
  for (std::size_t I = 0; I < Endings.size(); ++I)
    Listed += fmt::format("{}{}",
                          I == 0                    ? ""
                          : I + 1 == Endings.size() ? " or "
                                                    : ", ",
                          Endings[I]);
  return badName(Option, File,
                 fmt::format("unknown file extension, expected {}{}", Listed,
                             std::ranges::any_of(Endings, Ends)
                                 ? ""
                                 : didYouMean(endingOf(File), Endings)));
}

void nameOutput(const char *Option, std::string &File, const std::string &Input,
                std::string_view Ending) {
  if (!File.empty())
    return;
  std::error_code Ignored;
  std::filesystem::path Path =
      std::filesystem::absolute(Input, Ignored).lexically_normal();
  if (!Path.has_filename()) // of a folder, after a slash
    Path = Path.parent_path();
  const std::string Stem = Path.stem().string();
  File = (Stem.empty() ? "out" : Stem) + std::string(Ending);
  // Only an input of the wrong kind has this name. The command says so later.
  if (std::filesystem::absolute(File, Ignored).lexically_normal() == Path)
    File += Ending;
  completeCommandLine(Option, File);
}

Expected<Success> checkJsonName(const std::string &File) {
  const std::string_view Kind = promised(File);
  if (Kind.empty() || Kind == ".json")
    return Success{};
  return badName("--json", File, "is JSON, expected .json");
}

Expected<Success> checkPrefix(std::string_view Option,
                              const std::string &Prefix) {
  if (promised(Prefix).empty())
    return Success{};
  return badName(
      Option, Prefix,
      "is a prefix of several file names, expected one without an extension");
}

CLI::Option *addFiguresOption(CLI::App &App, std::string &Folder,
                              const std::string &Of) {
  return writesFolder(App.add_option(
      "--figures", Folder,
      fmt::format("Write the charts and tables of {} into this folder for a "
                  "paper: .svg, .png, .csv, and tables as .tex",
                  Of)));
}

std::vector<CLI::Option *> addPageOptions(CLI::App &App, PageFiles &P,
                                          const std::string &Help) {
  return {writesFile(App.add_option("--html", P.Html, Help), {".html"}),
          addFiguresOption(App, P.Figures)};
}

Expected<Success> checkPage(const PageFiles &P) {
  if (auto Checked = checkEnding("--html", P.Html, {".html"}); !Checked)
    return Checked;
  std::error_code Ignored;
  if (std::filesystem::exists(P.Figures, Ignored) &&
      !std::filesystem::is_directory(P.Figures, Ignored))
    return badName("--figures", P.Figures, "is a file, expected a folder");
  return Success{};
}

} // namespace vorion::splat
