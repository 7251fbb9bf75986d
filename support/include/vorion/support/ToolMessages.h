/// What a process that serves a tool's calls and its client say to each other
/// over a socket: texts, each behind its length. PoCL's driver has no library
/// of ours, so all is here.
#pragma once

#include <cerrno>
#include <cstdint>
#include <cstring>
#include <optional>
#include <string>
#include <string_view>
#include <sys/socket.h>
#include <vector>

namespace vorion {

/// The argument of a tool that is to serve calls over its standard input.
inline constexpr const char *ServeCalls = "--serve-calls";

/// Whether \p Bytes bytes have gone, of which \p Move moves some at a time: it
/// gets how many have gone, and gives what send() and recv() give.
template <typename Function>
bool allMoved(std::size_t Bytes, const Function &Move) {
  for (std::size_t Done = 0; Done < Bytes;) {
    const ssize_t Some = Move(Done);
    if (Some < 0 && errno == EINTR)
      continue;
    if (Some <= 0)
      return false;
    Done += static_cast<std::size_t>(Some);
  }
  return true;
}

/// Whether all of \p Text went through \p Socket. No signal says that nobody
/// reads there.
inline bool sendText(int Socket, std::string_view Text) {
  const auto Length = static_cast<uint64_t>(Text.size());
  std::string All(sizeof(Length), '\0');
  std::memcpy(All.data(), &Length, sizeof(Length));
  All += Text;
  return allMoved(All.size(), [&](std::size_t Done) {
    return ::send(Socket, All.data() + Done, All.size() - Done, MSG_NOSIGNAL);
  });
}

/// The next text of \p Socket; nothing if the other side is gone.
inline std::optional<std::string> receiveText(int Socket) {
  const auto Fill = [Socket](char *To, std::size_t Bytes) {
    return allMoved(Bytes, [&](std::size_t Done) {
      return ::recv(Socket, To + Done, Bytes - Done, 0);
    });
  };
  uint64_t Length = 0;
  if (!Fill(reinterpret_cast<char *>(&Length), sizeof(Length)))
    return std::nullopt;
  std::string Text(Length, '\0');
  if (!Fill(Text.data(), Text.size()))
    return std::nullopt;
  return Text;
}

/// What a tool is called with: the arguments behind its name.
inline std::string callText(const std::vector<std::string> &Arguments) {
  std::string Text;
  for (const std::string &Argument : Arguments) {
    Text += Argument;
    Text += '\0';
  }
  return Text;
}
inline std::vector<std::string> argumentsOf(std::string_view Call) {
  std::vector<std::string> Arguments;
  while (!Call.empty()) {
    const std::size_t End = Call.find('\0');
    Arguments.emplace_back(Call.substr(0, End));
    Call.remove_prefix(End + 1);
  }
  return Arguments;
}

} // namespace vorion
