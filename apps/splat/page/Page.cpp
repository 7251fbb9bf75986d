#include "page/Page.h"

#include "vorion/support/Json.h"

#include <algorithm>
#include <cstddef>
#include <nlohmann/json.hpp>

namespace vorion::splat {

namespace {

/// No tag inside a script may end it.
std::string forScript(std::string Text) {
  for (std::size_t At = 0; (At = Text.find("</", At)) != std::string::npos;)
    Text.replace(At, 2, "<\\/");
  return Text;
}

void fillIn(std::string &Page, std::string_view Place, std::string_view Text) {
  if (const std::size_t At = Page.find(Place); At != std::string::npos)
    Page.replace(At, Place.size(), Text);
}

std::string base64(const std::string &Bytes) {
  constexpr std::string_view Digits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string Text;
  for (std::size_t I = 0; I < Bytes.size(); I += 3) {
    const std::size_t Have = std::min<std::size_t>(3, Bytes.size() - I);
    unsigned Word = 0;
    for (std::size_t K = 0; K < 3; ++K)
      Word = Word << 8 |
             (K < Have ? static_cast<unsigned char>(Bytes[I + K]) : 0U);
    for (std::size_t K = 0; K < 4; ++K)
      Text += K <= Have ? Digits[Word >> (18 - 6 * K) & 63] : '=';
  }
  return Text;
}

} // namespace

std::string filledPage(std::string_view Template,
                       const nlohmann::ordered_json &Data,
                       std::string_view Library) {
  std::string Page(Template);
  // The data last: they may say anything.
  fillIn(Page, "@LIBRARY@", Library);
  fillIn(Page, "@DATA@", forScript(jsonText(Data)));
  return Page;
}

std::string pngUri(const std::string &Bytes) {
  return "data:image/png;base64," + base64(Bytes);
}

} // namespace vorion::splat
