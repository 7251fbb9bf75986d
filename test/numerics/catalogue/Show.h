/// The catalogue for people: what each case is, what came out of it, and its
/// picture with and without the guards that it is about.
#pragma once

#include "Check.h"

#include <string>

namespace vorion::test {

/// Checks the cases of \p P as they stand and with their broken kernels. Prints
/// one sentence, then a table, and writes index.html, hard-cases.json and the
/// pictures into \p Folder, which is made. An Error (GuestFailed), after all
/// that, if a contract is broken.
Expected<Success> show(CheckPlan P, const std::string &Folder);

} // namespace vorion::test
