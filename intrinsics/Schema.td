// The shapes of records. Field names are what the generators read.

// Instruction formats of the RISC-V unprivileged specification, chapter
// "RV32I base integer instruction set", section "Base instruction formats",
// and R4 of the F extension.
class Format<string mnemonics> { string Operands = mnemonics; }
def R : Format<"rd, rs1, rs2">;
def R4 : Format<"rd, rs1, rs2, rs3">;
def I : Format<"rd, rs1, imm">;
def S : Format<"rs1, rs2, imm">;
def B : Format<"rs1, rs2, imm">;
def U : Format<"rd, imm">;
def J : Format<"rd, imm">;

// An instruction: word & Mask == Match identifies it.
class Instruction<string mnemonic, Format format, int match, int mask,
                  string extension> {
  string Mnemonic = mnemonic;
  Format Fmt = format;
  int Match = match;
  int Mask = mask;
  string Extension = extension;
  LatencyClass Latency = LatencyAlu;
  EffectClass Effects = ?;            // every instruction declares it
  // rd and rs2 name the even one of two neighbouring registers, which hold 64
  // bits, the low ones in the even one. x0 stands for 64 zeros.
  bit Pairs = 0;
}

// Where a CSR's state lives: one copy for each of these.
class Scope<string name> { string Name = name; }
def Lane : Scope<"lane">;
def Warp : Scope<"warp">;
def Core : Scope<"core">;
def Agent : Scope<"agent">;     // the core's Raster Agent
def Socket : Scope<"socket">;
def Cluster : Scope<"cluster">;
def Device : Scope<"device">;

// What a write by several active lanes means.
class WriteRule<string name> { string Name = name; }
def ReadOnly : WriteRule<"none">;     // a write is an illegal instruction
def PerLane : WriteRule<"lane">;      // each active lane writes its own copy
def Scalar : WriteRule<"scalar">;     // the value of the last active lane
def Push : WriteRule<"push">;         // one element per active lane, lane order

class CsrField<string name, int low, int width, string doc> {
  string Name = name;
  int Low = low;
  int Width = width;
  string Doc = doc;
}

// A CSR. Uniform: all lanes read the same value (the compiler relies on it).
class Csr<string name, int number, Scope scope, WriteRule rule, bit uniform,
          string doc> {
  string Name = name;
  int Number = number;
  Scope In = scope;
  WriteRule Rule = rule;
  bit Uniform = uniform;
  string Doc = doc;
  string Extension = "xvortex";
  list<CsrField> Fields = [];
  // Whether kernels get an intrinsic for it (`vx_...`/`vr_...` in vorion.h).
  bit HasIntrinsic = 1;
}

// What the machine counts in a run. Its name is that of the reports, and of the
// driver's structure with "raster_" in front of a rasterizer's. Token: what
// clGetEventInfoVORION knows it by, 0 where OpenCL programs do not see it.
class Counter<string name, int token, string doc> {
  string Counter = name;
  int Token = token;
  string Counts = doc;                // lower case, no full stop
}

class CoreCounter<string name, int token, string doc> : Counter<name, token, doc>;

// A counter of the Raster Agents is a CSR that reads its low word.
class RasterCounter<string name, int number, int token, string doc>
    : Csr<"vr_n_" # name, number, Agent, ReadOnly, 1,
          !toupper(!substr(doc, 0, 1)) # !substr(doc, 1) # ".">,
      Counter<name, token, doc>;

// The counter, and the CSR of its high word, which follows 8 numbers later.
multiclass RasterCounter<string name, int number, int token, string doc> {
  let Extension = "xvorion" in {
  def "" : RasterCounter<name, number, token, doc>;
  def H : Csr<"vr_n_" # name # "h", !add(number, 8), Agent, ReadOnly, 1, "High word of vr_n_" # name # ".">;
  }
}

// A word of the configuration bank, all of which a write of vr_start queues as
// a command.
class BankCsr<string name, int number, string doc> : Csr<name, number, Agent, Scalar, 1, doc>;

// A named number of the ABI, for headers of the host and of the device.
class Constant<string name, int value, string doc> {
  string Name = name;
  int Value = value;
  string Doc = doc;
}

// A word of a command that vr_word accesses while vr_index is its number: what
// one kind of primitive needs takes no CSR.
class IndexedWord<string name, int number, string doc>
    : Constant<"VR_WORD_" # !toupper(name), number, doc> {
  string Word = name;
  list<CsrField> Fields = [];
}

class DescField<string name, string type, int count, string doc> {
  string Name = name;
  string Type = type;
  int Count = count;
  string Doc = doc;
}

// A structure shared by device, driver and simulator. Fields are 4 bytes each
// ("u32", "i32" or "f32"), laid out in order, `Count` of them for an array.
class Descriptor<string name, list<DescField> fields, string doc> {
  string Name = name;
  list<DescField> Fields = fields;
  string Doc = doc;
}
// How the compiler sees an intrinsic that selects a SIMT instruction.
// Divergence: "source" (lanes differ), "uniform" (never), "operands" (as its operands do).
class SimtInstruction<string mnemonic, int funct3, int funct7, string outs, string ins,
                      string divergence, string prototype, LatencyClass latency, string doc>
    : Instruction<mnemonic, R, 0, 0, "xvortex"> {
  let Match = !or(0x0B, !shl(funct3, 12), !shl(funct7, 25));
  int FixedZero = !or(!if(!eq(outs, ""), 0xF80, 0),           // rd
                           !if(!eq(ins, "rs1, rs2"), 0, 0x1F00000)); // rs2
  let Mask = !or(0xFE00707F, FixedZero);
  int Funct3 = funct3;
  int Funct7 = funct7;
  string Outs = outs;                 // "" or "rd"
  string Ins = ins;                   // "rs1" or "rs1, rs2"
  string Divergence = divergence;
  string Prototype = prototype;       // C, as in vorion.h
  let Latency = latency;
  string Doc = doc;
}
