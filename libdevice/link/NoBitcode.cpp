// lld can compile LLVM's bitcode, and would have all of LLVM's passes and
// targets for that. Objects for the device are machine code, so lld finds these
// in their place: the program is a third as large, and starts sooner.
#include "lld/Common/ErrorHandler.h"

#include <vector>

namespace lld::elf {

class BitcodeFile;
class InputFile;

/// What lld calls to compile bitcode.
class BitcodeCompiler {
public:
  BitcodeCompiler();
  ~BitcodeCompiler();
  void add(BitcodeFile &File);
  std::vector<InputFile *> compile();
};

BitcodeCompiler::BitcodeCompiler() = default;
BitcodeCompiler::~BitcodeCompiler() {}
void BitcodeCompiler::add(BitcodeFile & /*File*/) {
  error("an input is LLVM bitcode, expected machine code");
}
std::vector<InputFile *> BitcodeCompiler::compile() { return {}; }

} // namespace lld::elf
