// XVortex: R-type on custom-0 (opcode 0x0B), Vortex v2 encodings.
// "last" is the highest-numbered active lane.

let Effects = SetMask in
def VX_TMC : SimtInstruction<"vx_tmc", 0, 0, "", "rs1", "none", "void vx_tmc(uint mask)", LatencyMask,
  "Thread mask = rs1 of the last active lane; 0 ends the warp.">;
let Effects = Warps in
def VX_WSPAWN : SimtInstruction<"vx_wspawn", 1, 0, "", "rs1, rs2", "none", "void vx_wspawn(uint warps, uint entry)", LatencyMask,
  "Warps 1 to rs1-1 start at rs2 with lane 0 active.">;
let Effects = Split in {
def VX_SPLIT : SimtInstruction<"vx_split", 2, 0, "rd", "rs1", "uniform", "uint vx_split(uint predicate)", LatencyMask,
  "rd = depth of the divergence stack before the split. Bit 0 of rs1 is the predicate of each lane. If it differs among active lanes, push the mask and the next pc, and continue with the lanes whose predicate is true; otherwise push nothing.">;
def VX_SPLIT_N : SimtInstruction<"vx_split_n", 2, 0, "rd", "rs1", "uniform", "uint vx_split_n(uint predicate)", LatencyMask,
  "As vx_split with the predicate negated (encoded with rs2 = x1)."> {
  let Match = 0x0010200B;
}
}
let Effects = Join in
def VX_JOIN : SimtInstruction<"vx_join", 3, 0, "", "rs1", "none", "void vx_join(uint depth)", LatencyMask,
  "No effect if rs1 of the last active lane equals the depth of the divergence stack. Otherwise the first join of a split continues with its other lanes at the saved pc, and the second restores the mask and pops.">;
let Effects = Warps in
def VX_BAR : SimtInstruction<"vx_bar", 4, 0, "", "rs1, rs2", "none", "void vx_bar(uint id, uint warps)", LatencyBarrier,
  "Wait until rs2 warps (cores, if bit 31 of rs1 is set) have arrived at barrier rs1. Traps if not all lanes of the last vx_tmc are active.">;
let Effects = Predicate in {
def VX_PRED : SimtInstruction<"vx_pred", 5, 0, "", "rs1, rs2", "none", "void vx_pred(uint predicate, uint mask)", LatencyMask,
  "Mask &= bit 0 of rs1 if any active lane has it set; else mask = rs2 of the last active lane.">;
def VX_PRED_N : SimtInstruction<"vx_pred_n", 5, 0, "", "rs1, rs2", "none", "void vx_pred_n(uint predicate, uint mask)", LatencyMask,
  "As vx_pred with the predicate negated (encoded with rd = x1)."> {
  let Match = 0x0000508B;
}
}

let Effects = Vote in {
def VX_VOTE_ALL : SimtInstruction<"vx_vote_all", 0, 1, "rd", "rs1", "uniform", "uint vx_vote_all(uint predicate)", LatencySimt,
  "rd = 1 if rs1 is not 0 in every active lane, else 0.">;
def VX_VOTE_ANY : SimtInstruction<"vx_vote_any", 1, 1, "rd", "rs1", "uniform", "uint vx_vote_any(uint predicate)", LatencySimt,
  "rd = 1 if rs1 is not 0 in any active lane, else 0.">;
def VX_VOTE_UNI : SimtInstruction<"vx_vote_uni", 2, 1, "rd", "rs1", "uniform", "uint vx_vote_uni(uint value)", LatencySimt,
  "rd = 1 if rs1 has the same value in every active lane, else 0.">;
def VX_VOTE_BALLOT : SimtInstruction<"vx_vote_ballot", 3, 1, "rd", "rs1", "uniform", "uint vx_vote_ballot(uint predicate)", LatencySimt,
  "rd = mask of the active lanes whose rs1 is not 0.">;
}

// rs2 of a shuffle packs: bits 5:0 b, bits 11:6 c (clamp), bits 17:12 the
// segment mask. With lo = lane & segment and hi = lo | (c & ~segment):
let Effects = Shuffle in {
def VX_SHFL_UP : SimtInstruction<"vx_shfl_up", 4, 1, "rd", "rs1, rs2", "source", "uint vx_shfl_up(uint value, uint control)", LatencySimt,
  "rd = rs1 of lane - b, or the lane's own rs1 if that is below the segment or inactive.">;
def VX_SHFL_DOWN : SimtInstruction<"vx_shfl_down", 5, 1, "rd", "rs1, rs2", "source", "uint vx_shfl_down(uint value, uint control)", LatencySimt,
  "rd = rs1 of lane + b, or the lane's own rs1 if that is above hi or inactive.">;
def VX_SHFL_BFLY : SimtInstruction<"vx_shfl_bfly", 6, 1, "rd", "rs1, rs2", "source", "uint vx_shfl_bfly(uint value, uint control)", LatencySimt,
  "rd = rs1 of lane xor b, or the lane's own rs1 if that is above hi or inactive.">;
def VX_SHFL_IDX : SimtInstruction<"vx_shfl_idx", 7, 1, "rd", "rs1, rs2", "source", "uint vx_shfl_idx(uint value, uint control)", LatencySimt,
  "rd = rs1 of lane lo | (b & ~segment), or the lane's own rs1 if that is above hi or inactive.">;
}

// What the compiler provides without an instruction of its own.
class CompilerIntrinsic<string divergence, string prototype, string doc> {
  string Divergence = divergence;
  string Prototype = prototype;
  string Doc = doc;
}
def VX_UNIFORM : CompilerIntrinsic<"uniform", "uint vx_uniform(uint value)",
  "The value itself, which the caller asserts to be equal in all active lanes; branches on it need no split.">;
