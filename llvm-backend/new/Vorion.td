//===- Vorion.td - the RISC-V target with our extensions ------------------===//

include "RISCV.td"

// LLVM 19's name of an extension that patches/0001 takes for ratified.
def FeatureExperimentalZacas
    : SubtargetFeature<"experimental-zacas", "HasExperimentalZacas", "true",
                       "The same as zacas", [FeatureStdExtZacas]>;

// XVortex needs compare-and-swap because LR/SC loops do not end when lanes of a
// warp contend.
def FeatureVendorXVortex
    : RISCVExtension<"xvortex", 2, 0, "'XVortex' (SIMT threads)",
                     [FeatureStdExtZicsr, FeatureStdExtA, FeatureStdExtZacas]>;
def HasVendorXVortex : Predicate<"Subtarget->hasVendorXVortex()">,
    AssemblerPredicate<(all_of FeatureVendorXVortex), "'XVortex' (SIMT threads)">;

def FeatureVendorXVorion
    : RISCVExtension<"xvorion", 1, 0, "'XVorion' (Gaussian rasterizer)",
                     [FeatureVendorXVortex]>;
def HasVendorXVorion : Predicate<"Subtarget->hasVendorXVorion()">,
    AssemblerPredicate<(all_of FeatureVendorXVorion), "'XVorion' (Gaussian rasterizer)">;

include "RISCVInstrInfoXVortex.td"
include "FloatConstants.td"
include "VorionSched.td"

// docs/abi.md, "Target".
def VORION : RISCVProcessorModel<"vorion", VorionModel,
    [Feature32Bit, FeatureStdExtI, FeatureStdExtM, FeatureStdExtA, FeatureStdExtF,
     FeatureStdExtZicsr, FeatureStdExtZicond, FeatureStdExtZacas, FeatureStdExtZba,
     FeatureStdExtZbb, FeatureStdExtZbs, FeatureVendorXVortex, FeatureVendorXVorion],
    // Spilled values are put right in front of their use, and take many cycles
    // to come back.
    [FeaturePostRAScheduler]>;
