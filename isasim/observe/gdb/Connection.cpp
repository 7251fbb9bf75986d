#include "observe/gdb/Connection.h"

#include <arpa/inet.h>
#include <cerrno>
#include <cstring>
#include <fmt/format.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

namespace vorion::isasim::gdb {

namespace {

constexpr char Interrupt = 3;
/// More than gdb puts into a packet, whose size the server tells it.
constexpr size_t LongestPacket = 1 << 16;

unsigned char sumOf(std::string_view Contents) {
  unsigned char Sum = 0;
  for (const char C : Contents)
    Sum = static_cast<unsigned char>(Sum + static_cast<unsigned char>(C));
  return Sum;
}

int digit(char C) {
  return C >= '0' && C <= '9'   ? C - '0'
         : C >= 'a' && C <= 'f' ? C - 'a' + 10
         : C >= 'A' && C <= 'F' ? C - 'A' + 10
                                : -1;
}

} // namespace

std::string toHex(std::string_view Bytes) {
  std::string Text;
  for (const char C : Bytes)
    Text += fmt::format("{:02x}", static_cast<unsigned char>(C));
  return Text;
}

std::string fromHex(std::string_view Text) {
  std::string Bytes;
  for (size_t N = 0; N + 1 < Text.size(); N += 2) {
    const int High = digit(Text[N]), Low = digit(Text[N + 1]);
    if (High < 0 || Low < 0)
      break;
    Bytes += static_cast<char>(High << 4 | Low);
  }
  return Bytes;
}

Connection::~Connection() {
  close();
  if (Listener >= 0)
    ::close(Listener);
}

void Connection::close() {
  if (Socket >= 0)
    ::close(Socket);
  Socket = -1;
}

Expected<unsigned> Connection::listen(unsigned Port) {
  const auto Fail = [&] {
    return Error{"",
                 fmt::format("cannot listen on port {}: {}, expected a "
                             "free port, or 0 for any",
                             Port, std::strerror(errno)),
                 ExitCode::Usage};
  };
  Listener = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  if (Listener < 0)
    return Fail();
  const int Yes = 1;
  setsockopt(Listener, SOL_SOCKET, SO_REUSEADDR, &Yes, sizeof(Yes));
  sockaddr_in Address{};
  Address.sin_family = AF_INET;
  Address.sin_port = htons(static_cast<uint16_t>(Port));
  Address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t Size = sizeof(Address);
  auto *Generic = reinterpret_cast<sockaddr *>(&Address);
  if (bind(Listener, Generic, Size) != 0 || ::listen(Listener, 1) != 0 ||
      getsockname(Listener, Generic, &Size) != 0)
    return Fail();
  return unsigned{ntohs(Address.sin_port)};
}

bool Connection::waitFor(int Descriptor, short Events) const {
  constexpr int Milliseconds = 50;
  for (pollfd Poll{Descriptor, Events, 0}; !GiveUp();) {
    const int Ready = poll(&Poll, 1, Milliseconds);
    if (Ready > 0 || (Ready < 0 && errno != EINTR))
      return true; // what follows says what is wrong
  }
  return false;
}

bool Connection::accept() {
  if (!waitFor(Listener, POLLIN))
    return false;
  do
    Socket = accept4(Listener, nullptr, nullptr, SOCK_CLOEXEC);
  while (Socket < 0 && errno == EINTR);
  // Packets are small, and each waits for the next.
  const int Yes = 1;
  if (Socket >= 0)
    setsockopt(Socket, IPPROTO_TCP, TCP_NODELAY, &Yes, sizeof(Yes));
  return Socket >= 0;
}

int Connection::next() {
  if (At == Buffer.size()) {
    if (!waitFor(Socket, POLLIN))
      return -1;
    Buffer.resize(4096);
    ssize_t Got = 0;
    do
      Got = recv(Socket, Buffer.data(), Buffer.size(), 0);
    while (Got < 0 && errno == EINTR);
    Buffer.resize(Got > 0 ? static_cast<size_t>(Got) : 0);
    At = 0;
    if (Got <= 0)
      return -1;
  }
  return static_cast<unsigned char>(Buffer[At++]);
}

/// A debugger that waits for longer than two seconds sends its packet again,
/// as where a program takes its time until its first kernel. It expects one
/// answer to all of them.
bool Connection::comesAgain(std::string_view Contents) const {
  const std::string_view Unread(Buffer.data() + At, Buffer.size() - At);
  return Unread.find(fmt::format("${}#", Contents)) != std::string_view::npos;
}

std::optional<std::string> Connection::receive() {
  while (isOpen()) {
    int C = next();
    if (C == Interrupt)
      return std::string(1, Interrupt);
    if (C >= 0 && C != '$')
      continue; // an acknowledgement
    std::string Contents;
    while (C >= 0 && (C = next()) >= 0 && C != '#') {
      Contents += static_cast<char>(C);
      if (Contents.size() > LongestPacket)
        C = -1; // no debugger
    }
    const int High = C < 0 ? -1 : next(), Low = High < 0 ? -1 : next();
    if (Low < 0)
      break;
    if (!Acknowledges)
      return Contents;
    const int Sum =
        digit(static_cast<char>(High)) << 4 | digit(static_cast<char>(Low));
    put(Sum == sumOf(Contents) ? "+" : "-");
    if (Sum == sumOf(Contents) && !comesAgain(Contents))
      return Contents;
  }
  close();
  return std::nullopt;
}

void Connection::put(std::string_view Bytes) {
  while (!Bytes.empty() && isOpen()) {
    if (!waitFor(Socket, POLLOUT))
      return close();
    const ssize_t Sent =
        ::send(Socket, Bytes.data(), Bytes.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
    if (Sent < 0 && (errno == EINTR || errno == EAGAIN))
      continue;
    if (Sent <= 0)
      return close();
    Bytes.remove_prefix(static_cast<size_t>(Sent));
  }
}

void Connection::send(std::string_view Contents) {
  std::string Escaped;
  for (const char C : Contents) {
    if (C == '$' || C == '#' || C == '}' || C == '*') {
      Escaped += '}';
      Escaped += static_cast<char>(C ^ 0x20);
    } else {
      Escaped += C;
    }
  }
  put(fmt::format("${}#{:02x}", Escaped, sumOf(Escaped)));
}

bool Connection::interrupted() {
  if (!isOpen())
    return false;
  pollfd Poll{Socket, POLLIN, 0};
  if (At == Buffer.size() && poll(&Poll, 1, 0) <= 0)
    return false;
  const std::optional<std::string> Packet = receive();
  return Packet && *Packet == std::string(1, Interrupt);
}

} // namespace vorion::isasim::gdb
