// llvm-mc's own main, as llvmMcMain, takes its host for the target where none
// is named, and has only ours.
#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

int llvmMcMain(int Argc, char **Argv);

/// Whether some argument is the option \p Name, with one dash or two, its value
/// in it or behind it.
static bool has(const std::vector<char *> &Arguments, std::string_view Name) {
  return std::ranges::any_of(Arguments, [&](std::string_view A) {
    const std::size_t Dashes = A.starts_with("--") ? 2 : 1;
    return A.starts_with("-") && A.substr(Dashes).starts_with(Name) &&
           (A.size() == Dashes + Name.size() || A[Dashes + Name.size()] == '=');
  });
}

int main(int Argc, char **Argv) {
  std::vector<char *> Arguments(Argv, Argv + Argc);
  std::string Triple = "--triple=riscv32-unknown-elf", Cpu = "--mcpu=vorion";
  if (!has(Arguments, "triple") && !has(Arguments, "arch")) {
    if (!has(Arguments, "mcpu"))
      Arguments.push_back(Cpu.data());
    Arguments.push_back(Triple.data());
  }
  return llvmMcMain(int(Arguments.size()), Arguments.data());
}
