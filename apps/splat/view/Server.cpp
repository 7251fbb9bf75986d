#include "view/Server.h"

#include "io/Inside.h"
#include "vorion/support/Json.h"

#include <utility>

namespace vorion::splat {

namespace http = boost::beast::http;

Expected<std::unique_ptr<PageServer>> listenFor(int Port, Session &Shown) {
  // Calls Do with the request in the body.
  const auto Asking = [&Shown](auto Do) {
    return [&Shown, Do](const HttpCall &C) {
      const auto Asked = parseViewRequest(C.Request.body());
      return Asked ? Do(Shown, *Asked, C) : refusalOf(Asked.error());
    };
  };
  const auto Describe = [&Shown](const HttpCall & /*C*/) {
    return jsonAnswer(Shown.describe());
  };
  const auto Number = [&Shown](const HttpCall & /*C*/) {
    return jsonAnswer(Shown.number());
  };
  const auto Open = [&Shown](const HttpCall &C) {
    const auto Done =
        Shown.replace(asFileName(nameInQuery(C)), C.Request.body());
    return Done ? jsonAnswer(Shown.describe()) : refusalOf(Done.error());
  };
  const auto Frame = [](Session &S, const ViewRequest &R, const HttpCall &C) {
    const auto Answer = S.frame(R, {pageOf(C), C.HasLeft});
    return Answer ? packedAnswer(jsonText(Answer->Facts), Answer->Rgba)
                  : refusalOf(Answer.error());
  };
  const auto Pixel = [](Session &S, const ViewRequest &R, const HttpCall &) {
    const auto Answer = S.pixel(R);
    return Answer ? jsonAnswer(*Answer) : refusalOf(Answer.error());
  };
  const auto Command = [](Session &S, const ViewRequest &R, const HttpCall &) {
    const auto Answer = S.command(R);
    return Answer ? jsonAnswer(*Answer) : refusalOf(Answer.error());
  };
  const auto Picking = [&Shown](auto Do) {
    return [&Shown, Do](const HttpCall &C) {
      const auto Asked = parsePicked(C.Request.body());
      return Asked ? Do(Shown, *Asked) : refusalOf(Asked.error());
    };
  };
  const auto Selected = [](const Session &S, const PickedRequest &R) {
    const auto Answer = S.selection(R);
    return Answer ? packedAnswer(jsonText(Answer->Facts), Answer->Rgba)
                  : refusalOf(Answer.error());
  };
  const auto Edit = [](Session &S, const PickedRequest &R) {
    const auto Done = S.edit(R);
    return Done ? jsonAnswer(S.describe()) : refusalOf(Done.error());
  };
  const auto Save = [&Shown](const HttpCall &C) {
    auto Bytes = Shown.saved(asFileName(nameInQuery(C)));
    return Bytes
               ? HttpAnswer{200, "application/octet-stream", std::move(*Bytes)}
               : refusalOf(Bytes.error());
  };
  constexpr auto Get = http::verb::get, Post = http::verb::post;
  constexpr uint64_t Request = LargestViewRequest;
  // One scene is sent at a time.
  return PageServer::listen(Port, "/index.html",
                            {{Get, "/scene", 0, Describe},
                             {Get, "/number", 0, Number},
                             {Post, "/scene", LargestScene, Open},
                             {Post, "/frame", Request, Asking(Frame)},
                             {Post, "/pixel", Request, Asking(Pixel)},
                             {Post, "/command", Request, Asking(Command)},
                             {Post, "/selection", Request, Picking(Selected)},
                             {Post, "/edit", Request, Picking(Edit)},
                             {Get, "/saved", 0, Save}},
                            LargestScene + HttpLimits().Requests * Request);
}

} // namespace vorion::splat
