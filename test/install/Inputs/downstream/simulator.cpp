// Runs a program on the simulator as a library. usage: with-simulator PROGRAM
#include <cstdio>
#include <vorion/isasim/Machine.h>
#include <vorion/support/File.h>

int main(int Argc, char **Argv) {
  using namespace vorion;
  if (Argc != 2)
    return 2;
  const auto Bytes = readFile(Argv[1]);
  if (!Bytes)
    return 3;
  const auto Program = isasim::Image::parse(*Bytes, Argv[1]);
  auto Machine = isasim::Machine::create(isasim::Config());
  if (!Program || !Machine)
    return 3;
  (*Machine)->load(*Program);
  const isasim::RunResult Result = (*Machine)->run();
  std::printf("ended with %u\n", Result.ExitCode);
  return Result.End == isasim::Outcome::Done ? 0 : 1;
}
