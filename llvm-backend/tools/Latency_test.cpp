// The compiler's scheduling model and the simulator's table say the same of
// every instruction that is a record, although each is made by its own tools.
#include "timing/Latencies.h"

#include "llvm/MC/MCInst.h"
#include "llvm/MC/MCInstrInfo.h"
#include "llvm/MC/MCSchedule.h"
#include "llvm/MC/MCSubtargetInfo.h"
#include "llvm/MC/TargetRegistry.h"
#include "llvm/Support/TargetSelect.h"

#include <gtest/gtest.h>
#include <map>
#include <memory>

namespace sim = vorion::isasim;

extern "C" void LLVMInitializeRISCVTargetInfo();
extern "C" void LLVMInitializeRISCVTargetMC();

namespace {

/// LLVM's name of an instruction, from its mnemonic.
std::string llvmName(std::string Mnemonic) {
  static const std::map<std::string, std::string> Others = {
      {"zext.h", "ZEXT_H_RV32"},
      {"rev8", "REV8_RV32"},
      {"amocas.d", "AMOCAS_D_RV32"}};
  if (const auto Found = Others.find(Mnemonic); Found != Others.end())
    return Found->second;
  for (char &C : Mnemonic)
    C = C == '.' ? '_' : static_cast<char>(std::toupper(C));
  return Mnemonic;
}

TEST(Latencies, CompilerAndSimulatorAgreeOnEveryInstruction) {
  LLVMInitializeRISCVTargetInfo();
  LLVMInitializeRISCVTargetMC();
  std::string Error;
  const llvm::Target *Target =
      llvm::TargetRegistry::lookupTarget("riscv32", Error);
  ASSERT_NE(Target, nullptr) << Error;
  const std::unique_ptr<llvm::MCInstrInfo> Names(Target->createMCInstrInfo());
  const std::unique_ptr<llvm::MCSubtargetInfo> Subtarget(
      Target->createMCSubtargetInfo("riscv32", "vorion", ""));
  const llvm::MCSchedModel &Model = Subtarget->getSchedModel();
  std::map<std::string, unsigned> Opcodes;
  for (unsigned Opcode = 0; Opcode < Names->getNumOpcodes(); ++Opcode)
    Opcodes[Names->getName(Opcode).str()] = Opcode;

  for (unsigned O = 0; O < sim::NumOps; ++O) {
    const std::string Mnemonic = sim::InsnTable[O].Mnemonic;
    SCOPED_TRACE(Mnemonic);
    const auto Found = Opcodes.find(llvmName(Mnemonic));
    ASSERT_NE(Found, Opcodes.end());
    const unsigned Class = Names->get(Found->second).getSchedClass();
    const llvm::MCSchedClassDesc *Description = Model.getSchedClassDesc(Class);
    ASSERT_TRUE(Description->isValid());
    const sim::LatencyInfo &Expected =
        sim::LatencyTable[static_cast<unsigned>(sim::ClassOfOp[O])];
    EXPECT_EQ(llvm::MCSchedModel::computeInstrLatency(*Subtarget, *Description),
              Expected.Cycles);
    const llvm::MCWriteProcResEntry *Use =
        Subtarget->getWriteProcResBegin(Description);
    ASSERT_NE(Use, Subtarget->getWriteProcResEnd(Description));
    EXPECT_EQ(Use->ReleaseAtCycle, Expected.Interval);
  }
}

} // namespace
