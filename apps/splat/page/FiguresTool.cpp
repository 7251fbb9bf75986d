// splat-figures: the figures of a page that splat wrote, as files. The page
// makes them itself (figures.js): its scripts run on a document without a
// browser (document.js).

#include "page/Figures.h"
#include "vorion/support/CommandLine.h"
#include "vorion/support/Diagnostics.h"
#include "vorion/support/File.h"
#include "vorion/support/Json.h"
#include "vorion/support/Printable.h"
#include "vorion/support/Tool.h"

#include <JavaScriptCore/JavaScript.h>
#include <cairo.h>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fmt/format.h>
#include <librsvg/rsvg.h>
#include <memory>
#include <nlohmann/json.hpp>
#include <vector>

namespace {

using namespace vorion;
using Json = nlohmann::json;

using OwnedText = std::unique_ptr<OpaqueJSString, decltype(&JSStringRelease)>;

OwnedText textOf(const std::string &Text) {
  return {JSStringCreateWithUTF8CString(Text.c_str()), JSStringRelease};
}

std::string stringOf(JSStringRef Text) {
  std::string Out(JSStringGetMaximumUTF8CStringSize(Text), '\0');
  Out.resize(JSStringGetUTF8CString(Text, Out.data(), Out.size()) - 1);
  return Out;
}

/// The scripts of a page, run in order.
class PageScripts {
public:
  explicit PageScripts(std::string Page)
      : Page(std::move(Page)), Context(JSGlobalContextCreate(nullptr)) {}
  PageScripts(const PageScripts &) = delete;
  PageScripts &operator=(const PageScripts &) = delete;
  ~PageScripts() { JSGlobalContextRelease(Context); }

  /// The result of \p Source as JSON.
  Expected<Json> run(const std::string &Source) {
    JSValueRef Failed = nullptr;
    const JSValueRef Value = JSEvaluateScript(Context, textOf(Source).get(),
                                              nullptr, nullptr, 1, &Failed);
    return jsonOf(Value, Failed);
  }

  /// The result of the function \p Name, called with \p Arguments.
  Expected<JSObjectRef> call(const std::string &Name,
                             const std::vector<JSValueRef> &Arguments) {
    JSValueRef Failed = nullptr;
    const JSValueRef Function = JSEvaluateScript(Context, textOf(Name).get(),
                                                 nullptr, nullptr, 1, &Failed);
    const JSValueRef Value =
        Failed ? nullptr
               : JSObjectCallAsFunction(
                     Context, JSValueToObject(Context, Function, nullptr),
                     nullptr, Arguments.size(), Arguments.data(), &Failed);
    if (Failed)
      return failure(Failed);
    return JSValueToObject(Context, Value, nullptr);
  }

  /// \p Png with the page's description and its resolution.
  Expected<std::string> described(std::string Png) {
    const JSObjectRef File = JSObjectMakeTypedArrayWithBytesNoCopy(
        Context, kJSTypedArrayTypeUint8Array, Png.data(), Png.size(),
        [](void *, void *) {}, nullptr, nullptr);
    const JSValueRef Made = JSEvaluateScript(Context, textOf("data.made").get(),
                                             nullptr, nullptr, 1, nullptr);
    const auto Whole = call("describedPng", {File, Made});
    if (!Whole)
      return Whole.error();
    const auto *Bytes = static_cast<const char *>(
        JSObjectGetTypedArrayBytesPtr(Context, *Whole, nullptr));
    return std::string(
        Bytes, JSObjectGetTypedArrayByteLength(Context, *Whole, nullptr));
  }

  /// The value of \p Text in scripts.
  JSValueRef value(const std::string &Text) {
    return JSValueMakeString(Context, textOf(Text).get());
  }

  Expected<Json> json(JSValueRef Value) { return jsonOf(Value, nullptr); }

private:
  Error failure(JSValueRef Failed) {
    const OwnedText Text(JSValueToStringCopy(Context, Failed, nullptr),
                         JSStringRelease);
    return {Page, fmt::format("{}, expected a page of this version of splat",
                              printable(stringOf(Text.get()), 200))};
  }

  Expected<Json> jsonOf(JSValueRef Value, JSValueRef Failed) {
    if (Failed)
      return failure(Failed);
    const OwnedText Text(JSValueCreateJSONString(Context, Value, 0, nullptr),
                         JSStringRelease);
    if (!Text)
      return Json();
    return parseJson<Json>(stringOf(Text.get()), Page, "a list of figures");
  }

  std::string Page;
  JSGlobalContextRef Context;
};

Expected<std::string> pngOf(const std::string &Name, const std::string &Svg,
                            double DotsPerInch) {
  GError *Why = nullptr;
  const std::unique_ptr<RsvgHandle, decltype(&g_object_unref)> Handle(
      rsvg_handle_new_from_data(reinterpret_cast<const guint8 *>(Svg.data()),
                                Svg.size(), &Why),
      g_object_unref);
  if (!Handle)
    return Error{Name, Why->message, ExitCode::Internal};
  rsvg_handle_set_dpi(Handle.get(), DotsPerInch);
  double Width = 0, Height = 0;
  rsvg_handle_get_intrinsic_size_in_pixels(Handle.get(), &Width, &Height);
  const RsvgRectangle All{0, 0, std::round(Width), std::round(Height)};
  const std::unique_ptr<cairo_surface_t, decltype(&cairo_surface_destroy)>
      Surface(cairo_image_surface_create(CAIRO_FORMAT_RGB24,
                                         static_cast<int>(All.width),
                                         static_cast<int>(All.height)),
              cairo_surface_destroy);
  const std::unique_ptr<cairo_t, decltype(&cairo_destroy)> To(
      cairo_create(Surface.get()), cairo_destroy);
  cairo_set_source_rgb(To.get(), 1, 1, 1);
  cairo_paint(To.get());
  std::string Png;
  const auto Append = [](void *Out, const unsigned char *Bytes, unsigned Size) {
    static_cast<std::string *>(Out)->append(
        reinterpret_cast<const char *>(Bytes), Size);
    return CAIRO_STATUS_SUCCESS;
  };
  if (!rsvg_handle_render_document(Handle.get(), To.get(), &All, &Why))
    return Error{Name, Why->message, ExitCode::Internal};
  if (const cairo_status_t Status =
          cairo_surface_write_to_png_stream(Surface.get(), Append, &Png);
      Status != CAIRO_STATUS_SUCCESS)
    return Error{Name, cairo_status_to_string(Status)};
  return Png;
}

Expected<Success> write(const std::string &File, const std::string &Folder) {
  const auto Bytes = readFile(File);
  if (!Bytes)
    return Bytes.error();
  PageScripts Scripts(File);
  if (auto Opened = Scripts.run(std::string(splat::documentScript())); !Opened)
    return Opened.error();
  const auto Found = Scripts.call(
      "openDocument",
      {Scripts.value(
          {reinterpret_cast<const char *>(Bytes->data()), Bytes->size()})});
  if (!Found)
    return Found.error();
  const auto Sources = Scripts.json(*Found);
  if (!Sources)
    return Sources.error();
  for (const Json &Source : *Sources)
    if (auto Ran = Scripts.run(Source.get<std::string>()); !Ran)
      return Ran.error();
  const auto Figures = Scripts.run("figuresOfAllChoices()");
  if (!Figures)
    return Figures.error();
  const auto Resolution = Scripts.run("DOTS_PER_INCH");
  std::error_code Failed;
  std::filesystem::create_directories(Folder, Failed);
  if (Failed)
    return Error{Folder, "cannot make: " + Failed.message()};
  for (const Json &Figure : *Figures) {
    const std::string Base = Folder + "/" + Figure["name"].get<std::string>();
    auto Png = pngOf(Base, Figure["svg"].get<std::string>(), *Resolution);
    if (!Png)
      return Png.error();
    Png = Scripts.described(std::move(*Png));
    if (!Png)
      return Png.error();
    for (const auto &[Ending, Text] :
         {std::pair("svg", Figure["svg"].get<std::string>()),
          std::pair("csv", Figure["csv"].get<std::string>()),
          std::pair("tex", Figure.value("latex", "")), std::pair("png", *Png)})
      if (!Text.empty())
        if (auto Written =
                writeFileAtomically(fmt::format("{}.{}", Base, Ending), Text);
            !Written)
          return Written;
  }
  return Success{};
}

} // namespace

int main(int Count, char **Values) {
  return runTool("splat-figures", [&] {
    CLI::App App("Writes each chart and table of a page of splat as SVG, PNG "
                 "and CSV, tables also as LaTeX, sized for a column of a "
                 "paper.",
                 "splat-figures");
    std::string Page, Folder;
    takesFile(App.add_option("page", Page, "Page that splat wrote"), {".html"})
        ->required();
    writesFolder(App.add_option("folder", Folder, "Folder for the figures"))
        ->required();
    App.footer(std::string(ExitCodeHelp));
    if (const auto Done = parseCommandLine(App, {Values + 1, Values + Count}))
      return *Done;
    const auto Written = write(Page, Folder);
    return Written ? EXIT_SUCCESS
                   : reportError("splat-figures", Written.error());
  });
}
