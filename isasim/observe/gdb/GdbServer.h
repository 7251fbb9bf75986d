/// A stub for gdb's remote protocol ("GDB Remote Serial Protocol", gdb manual,
/// appendix E): the only header of this folder that others include.
#pragma once

#include "vorion/isasim/Observer.h"
#include "vorion/support/Expected.h"

#include <functional>
#include <memory>
#include <string_view>

namespace vorion::isasim {

/// Listens on \p Port of the loopback interface, 0 for any that is free, and
/// tells \p Say which. The first run waits for a debugger and stops before its
/// first instruction; without one any more, runs go on. Each lane of each warp
/// is a thread. What the debugger writes changes the run, as is its purpose.
Expected<std::unique_ptr<Observer>>
startGdbServer(unsigned Port, const std::function<void(std::string_view)> &Say);

/// The same for a debugger at the other end of \p Socket, which it takes over.
std::unique_ptr<Observer> serveGdb(int Socket);

} // namespace vorion::isasim
