#include "Vorion.h"
#include "RISCVSubtarget.h"
#include "llvm/CodeGen/MachineFunctionPass.h"
using namespace llvm;
namespace {
class VerifySplits final : public MachineFunctionPass {
public:
  static char ID;
  VerifySplits() : MachineFunctionPass(ID) {}
  bool runOnMachineFunction(MachineFunction &) override { return false; }
};
char VerifySplits::ID = 0;
}
FunctionPass *vorion::createVerifySplitsPass() { return new VerifySplits(); }
