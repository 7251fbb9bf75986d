//===- FloatConstants.td - float constants as one instruction -------------===//

// Any float, from the bits of its number. Until registers are given it is one
// instruction that reads nothing, so the allocator makes a constant again where
// it is used rather than spilling it. FloatConstants.cpp expands it.
let Predicates = [HasVendorXVortex], Size = 12, isReMaterializable = 1,
    hasSideEffects = 0, mayLoad = 0, mayStore = 0, isCodeGenOnly = 1 in
def PseudoFloatConstant : Pseudo<(outs FPR32:$rd), (ins i32imm:$bits), []>,
                          Sched<[WriteFMovI32ToF32]>;
