// What an instruction does besides giving rd of each active lane a value that
// follows from the lane's own operands, and where its result is defined. Checkers
// of programs, the translator, the fuzzer and the models of tests read this table.

// The accrued floating-point exceptions are no effect.
class Effect<string doc> { string Doc = doc; }
def ReadsLanes : Effect<"reads operands of other active lanes, or which lanes are active">;
def ChangesMask : Effect<"changes the thread mask or the divergence stack">;
def Jumps : Effect<"may transfer control, or always traps">;
def ReadsMemory : Effect<"reads memory">;
def WritesMemory : Effect<"writes memory">;
def AccessesCsr : Effect<"reads or writes a CSR, whose record defines further effects">;
def Orders : Effect<"is not reordered with memory accesses or other instructions with this effect">;

// In which active lanes rd is defined.
class Definedness<string doc> { string Doc = doc; }
def NoResult : Definedness<"has no rd">;
def Always : Definedness<"in every lane">;
def OwnOperands : Definedness<"in lanes whose operands are defined, or in which one operand determines the result">;
def EveryLane : Definedness<"in every lane if rs1 is defined in every active lane, else in none">;
def AnyLane : Definedness<"in every lane if rs1 is defined in an active lane, else in none">;
def FromMemory : Definedness<"in lanes that read defined bytes">;

// An operand on which the instruction acts, so that it must be defined: in every
// active lane, or in the last one.
class Use<string operand, string what, bit lastLane = 0> {
  string Operand = operand;           // rs1 or rs2
  string What = what;                 // as checkers report it, in front of "from memory that ..."
  bit LastLane = lastLane;
}

class EffectClass<list<Effect> effects, Definedness result, list<Use> uses = []> {
  list<Effect> Effects = effects;
  Definedness Result = result;
  list<Use> Uses = uses;              // at most two
}
def LaneWise : EffectClass<[], OwnOperands>;
def Vote : EffectClass<[ReadsLanes], EveryLane>;
def Shuffle : EffectClass<[ReadsLanes], AnyLane>;
def Split : EffectClass<[ReadsLanes, ChangesMask], Always, [Use<"rs1", "condition">]>;
def Join : EffectClass<[ReadsLanes, ChangesMask, Jumps], NoResult, [Use<"rs1", "depth", 1>]>;
def Predicate : EffectClass<[ReadsLanes, ChangesMask], NoResult,
                            [Use<"rs1", "condition">, Use<"rs2", "mask", 1>]>;
def SetMask : EffectClass<[ReadsLanes, ChangesMask], NoResult, [Use<"rs1", "mask", 1>]>;
// Starts warps or waits for them.
def Warps : EffectClass<[ReadsLanes, Orders], NoResult,
                        [Use<"rs1", "operand", 1>, Use<"rs2", "operand", 1>]>;
def Load : EffectClass<[ReadsMemory], FromMemory, [Use<"rs1", "access to an address">]>;
def Store : EffectClass<[WritesMemory], NoResult, [Use<"rs1", "access to an address">]>;
def Atomic : EffectClass<[ReadsMemory, WritesMemory], FromMemory,
                         [Use<"rs1", "access to an address">, Use<"rs2", "atomic with a value">]>;
def Fence : EffectClass<[Orders], NoResult>;
def Branch : EffectClass<[Jumps], NoResult,
                         [Use<"rs1", "branch on a value">, Use<"rs2", "branch on a value">]>;
def Jump : EffectClass<[Jumps], Always>;
def IndirectJump : EffectClass<[Jumps], Always, [Use<"rs1", "jump to an address">]>;
def Trap : EffectClass<[Jumps], NoResult>;
def CsrRegister : EffectClass<[AccessesCsr, Orders], Always,
                              [Use<"rs1", "write of a CSR with a value">]>;
def CsrImmediate : EffectClass<[AccessesCsr, Orders], Always>;
