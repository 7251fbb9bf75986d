//===- VorionSched.td - the scheduling model of the 5-stage core ----------===//
//
// One instruction a cycle, in order. What each costs is intrinsics/Latencies.td;
// the records' instructions get their class by name (VorionLatencies.td), and
// upstream's kinds, which pseudo instructions have, the class that fits here.
//
//===----------------------------------------------------------------------===//

class VorionPipeline : SchedMachineModel {
  let MicroOpBufferSize = 0;
  let IssueWidth = 1;
  let MispredictPenalty = 2; // fetch and decode behind a branch that is taken
  let CompleteModel = false;
}

include "VorionLatencies.td"

// Upstream's kinds of instructions that cost the same.
class Kinds<list<SchedWrite> writes, list<ProcResourceKind> units, int cycles, int interval = 1> {
  list<SchedWrite> Writes = writes;
  list<ProcResourceKind> Units = units;
  int Cycles = cycles;
  int Interval = interval;
}

let SchedModel = VorionModel in {
foreach K = [
  Kinds<[WriteIALU, WriteIALU32, WriteShiftImm, WriteShiftImm32, WriteShiftReg, WriteShiftReg32,
         WriteNop], [VorionAlu], LatencyAluCycles>,
  Kinds<[WriteIMul, WriteIMul32], [VorionAlu], LatencyMulCycles>,
  Kinds<[WriteIDiv, WriteIDiv32, WriteIRem, WriteIRem32], [VorionSfu], LatencyDivCycles, LatencyDivCycles>,
  Kinds<[WriteFAdd32, WriteFMul32, WriteFMA32, WriteFAdd64, WriteFMul64, WriteFMA64], [VorionAlu], LatencyFmaCycles>,
  Kinds<[WriteFCmp32, WriteFSGNJ32, WriteFMinMax32, WriteFClass32, WriteFMovF32ToI32, WriteFMovI32ToF32, WriteFCmp64,
         WriteFSGNJ64, WriteFMinMax64, WriteFClass64, WriteFMovF64ToI64, WriteFMovI64ToF64],
        [VorionAlu], LatencyFcmpCycles>,
  Kinds<[WriteFCvtI32ToF32, WriteFCvtF32ToI32, WriteFCvtI64ToF32, WriteFCvtF32ToI64, WriteFCvtI32ToF64,
         WriteFCvtF64ToI32, WriteFCvtI64ToF64, WriteFCvtF64ToI64, WriteFCvtF32ToF64, WriteFCvtF64ToF32],
        [VorionAlu], LatencyFcvtCycles>,
  Kinds<[WriteFDiv32, WriteFDiv64], [VorionSfu], LatencyFdivCycles>,
  Kinds<[WriteFSqrt32, WriteFSqrt64], [VorionSfu], LatencyFsqrtCycles>,
  Kinds<[WriteCSR], [VorionSfu], LatencyCsrCycles>,
  Kinds<[WriteJmp, WriteJal, WriteJalr], [VorionSfu], LatencyBranchCycles>,
  Kinds<[WriteLDB, WriteLDH, WriteLDW, WriteLDD, WriteFLD32, WriteFLD64], [VorionLsu], LatencyLoadCycles>,
  Kinds<[WriteSTB, WriteSTH, WriteSTW, WriteSTD, WriteFST32, WriteFST64, WriteAtomicSTW, WriteAtomicSTD],
        [VorionLsu], LatencyStoreCycles>,
  Kinds<[WriteAtomicW, WriteAtomicD, WriteAtomicLDW, WriteAtomicLDD], [VorionLsu], LatencyAtomicCycles>
] in
  foreach W = K.Writes in
    def : WriteRes<W, K.Units> {
      let Latency = K.Cycles;
      let ReleaseAtCycles = [K.Interval];
    }

// Every operand is read in one stage.
foreach R = [
  ReadJmp, ReadJalr, ReadCSR, ReadStoreData, ReadMemBase, ReadIALU, ReadIALU32, ReadShiftImm, ReadShiftImm32,
  ReadShiftReg, ReadShiftReg32, ReadIDiv, ReadIDiv32, ReadIRem, ReadIRem32, ReadIMul, ReadIMul32, ReadAtomicWA,
  ReadAtomicWD, ReadAtomicDA, ReadAtomicDD, ReadAtomicLDW, ReadAtomicLDD, ReadAtomicSTW, ReadAtomicSTD, ReadFStoreData,
  ReadFMemBase, ReadFAdd32, ReadFAdd64, ReadFMul32, ReadFMul64, ReadFMA32, ReadFMA32Addend, ReadFMA64,
  ReadFMA64Addend, ReadFDiv32, ReadFDiv64, ReadFSqrt32, ReadFSqrt64, ReadFCmp32, ReadFCmp64, ReadFSGNJ32, ReadFSGNJ64,
  ReadFMinMax32, ReadFMinMax64, ReadFCvtF32ToI32, ReadFCvtF32ToI64, ReadFCvtF64ToI32, ReadFCvtF64ToI64,
  ReadFCvtI32ToF32, ReadFCvtI32ToF64, ReadFCvtI64ToF32, ReadFCvtI64ToF64, ReadFCvtF32ToF64, ReadFCvtF64ToF32,
  ReadFMovF32ToI32, ReadFMovI32ToF32, ReadFMovF64ToI64, ReadFMovI64ToF64, ReadFClass32, ReadFClass64
] in
  def : ReadAdvance<R, 0>;

// The machine has none of these; what it has of Zba, Zbb and Zbs is classed by
// name.
defm : UnsupportedSchedV;
defm : UnsupportedSchedZabha;
defm : UnsupportedSchedZba;
defm : UnsupportedSchedZbb;
defm : UnsupportedSchedZbc;
defm : UnsupportedSchedZbs;
defm : UnsupportedSchedZbkb;
defm : UnsupportedSchedZbkx;
defm : UnsupportedSchedZfa;
defm : UnsupportedSchedZfh;
defm : UnsupportedSchedSFB;
defm : UnsupportedSchedXsfvcp;
defm : UnsupportedSchedZvk;
}
