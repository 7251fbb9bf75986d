/// The server of `splat view`, accessible only from this computer.
#pragma once

#include "view/PageServer.h"
#include "view/Session.h"

namespace vorion::splat {

/// Listens on \p Port of 127.0.0.1, 0 for a free one. \p Shown must outlive the
/// server. Fails if the port is in use.
Expected<std::unique_ptr<PageServer>> listenFor(int Port, Session &Shown);

} // namespace vorion::splat
