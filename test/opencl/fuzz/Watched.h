/// Runs seeded cases, each in a process of its own that is watched: what ends
/// by a signal, takes too long or says that something is wrong is a find.
#pragma once

#include <cstdint>
#include <functional>
#include <string>

namespace vorion::test {

/// The main function of such a program: options --first N, --count N,
/// --seconds N (stop after so long), --limit N (seconds a case may take),
/// --resume FILE (go on behind the last seed in FILE, and keep it there),
/// --here (run the first case in this process, for a debugger). \p Case gives
/// what is wrong, or nothing. Prints a line for each find and the counts;
/// exit code 0 if there is no find, else 1; 2 usage.
int runWatched(int Argc, char **Argv, const char *Name,
               const std::function<std::string(uint64_t Seed)> &Case);

} // namespace vorion::test
