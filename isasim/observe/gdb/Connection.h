/// Packets of gdb's remote protocol over one TCP connection.
#pragma once

#include "vorion/support/Expected.h"

#include <functional>
#include <optional>
#include <string>
#include <string_view>

namespace vorion::isasim::gdb {

class Connection {
public:
  Connection() = default;
  ~Connection();
  Connection(const Connection &) = delete;
  Connection &operator=(const Connection &) = delete;

  /// Listens on 127.0.0.1; gives the port.
  Expected<unsigned> listen(unsigned Port);
  /// While something is waited for, \p MustStop is asked every now and then;
  /// true ends the wait and the connection.
  void stopWaitingWhen(std::function<bool()> MustStop) {
    GiveUp = std::move(MustStop);
  }
  /// Waits for a debugger; false if none can come.
  bool accept();
  /// Takes over a connected socket instead.
  void adopt(int Descriptor) { Socket = Descriptor; }
  bool isOpen() const { return Socket >= 0; }
  void close();

  /// The next packet's contents, acknowledged; nothing when the debugger has
  /// gone. An interrupt (Ctrl-C) is the packet "\x03".
  std::optional<std::string> receive();
  void send(std::string_view Contents);
  /// Whether the debugger asks for a stop, without waiting.
  bool interrupted();
  void stopAcknowledging() { Acknowledges = false; }

private:
  int next();
  bool comesAgain(std::string_view Contents) const;
  void put(std::string_view Bytes);
  /// Whether \p Descriptor is ready for \p Events (poll's) before GiveUp.
  bool waitFor(int Descriptor, short Events) const;

  int Listener = -1, Socket = -1;
  bool Acknowledges = true;
  std::function<bool()> GiveUp = [] { return false; };
  std::string Buffer;
  size_t At = 0;
};

std::string toHex(std::string_view Bytes);
/// Stops at what is no hexadecimal digit.
std::string fromHex(std::string_view Text);

} // namespace vorion::isasim::gdb
