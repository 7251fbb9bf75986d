// What an instruction costs a core's pipeline: the one table that the compiler's
// scheduling model and the simulator's clock are made from.
// [paper]: a five-stage in-order core that issues one instruction a cycle to 16
// ALUs (INT32 and FP32) or 16 SFUs. [vortex]: hw/rtl/VX_config.vh of Vortex,
// release 2, whose descendant the core is. What neither fixes is "ours".

// Cycles: from issue until what uses the result can issue. Interval: until the
// unit takes the next instruction. Of memory, Cycles is what the compiler
// expects, a hit in L2; the simulator asks its caches.
class LatencyClass<string name, string unit, int cycles, int interval, string source> {
  string Name = name;
  string Unit = unit;                 // alu, sfu or lsu
  int Cycles = cycles;
  int Interval = interval;
  string Source = source;
}
def LatencyAlu : LatencyClass<"alu", "alu", 1, 1, "forwarded within the pipeline [paper]">;
def LatencyMul : LatencyClass<"mul", "alu", 4, 1, "LATENCY_IMUL [vortex]">;
def LatencyDiv : LatencyClass<"div", "sfu", 34, 34, "a bit a cycle and two, not pipelined: VX_serial_div [vortex]">;
def LatencyFma : LatencyClass<"fma", "alu", 4, 1, "LATENCY_FMA, addition and multiplication too [vortex]">;
def LatencyFcmp : LatencyClass<"fcmp", "alu", 2, 1, "LATENCY_FNCP [vortex]">;
def LatencyFcvt : LatencyClass<"fcvt", "alu", 5, 1, "LATENCY_FCVT [vortex]">;
def LatencyFdiv : LatencyClass<"fdiv", "sfu", 15, 1, "LATENCY_FDIV, pipelined [vortex]">;
def LatencyFsqrt : LatencyClass<"fsqrt", "sfu", 10, 1, "LATENCY_FSQRT, pipelined [vortex]">;
def LatencySimt : LatencyClass<"simt", "sfu", 1, 1, "votes and shuffles: wiring and a multiplexer; ours">;
def LatencyCsr : LatencyClass<"csr", "sfu", 1, 1, "a read in front of write-back; ours">;
def LatencyBranch : LatencyClass<"branch", "sfu", 1, 1, "as an ALU operation; the front end's loss is a parameter of the clock [paper]">;
def LatencyMask : LatencyClass<"mask", "sfu", 1, 1, "as a branch; ours">;
def LatencyLoad : LatencyClass<"load", "lsu", 11, 1, "address generation and an L2 hit; ours">;
def LatencyStore : LatencyClass<"store", "lsu", 1, 1, "nothing waits for it">;
def LatencyAtomic : LatencyClass<"atomic", "lsu", 11, 1, "as a load">;
def LatencyFence : LatencyClass<"fence", "lsu", 1, 1, "ours">;
def LatencyBarrier : LatencyClass<"barrier", "sfu", 1, 1, "when the others have arrived; ours">;
