// The units of a rasterizer's lane that a field of a CSR chooses between, in the
// order in which command lines show them; docs/adding-a-lane-unit.md. The paper
// names no exponential and gives no reciprocal's cost: latencies and operations
// without another source are our estimates of a plausible build.

// The number is the field's value, and a constant of the ABI.
class LaneUnit<string prefix, string choice, int number, string doc>
    : Constant<prefix # !toupper(!subst("-", "_", choice)), number, doc> {
  string Choice = choice;             // its name on command lines
  string Report = choice;             // and in reports of the clock
  // Time in cycles, and what it is made of: docs/lane-units.md#area-of-a-lane.
  int Latency = 1;
  int Interval = 1;
  int Multipliers = 0;                // fp32
  int Adders = 0;                     // fp32
  int ProductBits = 0;                // of other multipliers; below 0, what an fp32 one has less
  int AdderBits = 0;                  // of other adders
  int TableBits = 0;
  int ChoiceBits = 0;
  int RegisterBits = 0;               // between stages, where they are no part of the lane's rest
  string Source = ?;                  // or derivation
}

// A pipelined divider. It and an fp32 multiplier differ in what is between
// exponents and rounding: there a product of 24 x 24 bits, here a row of 24 bits
// for each of the 26 bits of the quotient, one before the point that may be 0 and
// one to round by, 3 or 4 a cycle. A row has a choice between remainder and
// difference (the bit above a row's needs no subtraction: if it is set, the row's
// succeeds). Between stages: remainder, divisor, exponent, half the quotient on
// average.
defvar DividerLatency = 8;
defvar DividerProductBits = !sub(0, !mul(24, 24)); // with a multiplier
defvar DividerRowBits = !mul(26, 24);              // adder bits, and choice bits
defvar DividerRegisterBits = !mul(!sub(DividerLatency, 1), !add(24, 24, 8, 13));

// vr_mode.primitive: what decides whether a primitive covers a pixel, and with
// which alpha or depth (docs/primitives.md). Bodies: Blended.h of
// isasim/raster/ for primitives that are blended, Surfaces.h for opaque ones.
class FrontEndUnit<string choice, int number, string record, string doc>
    : LaneUnit<"VR_PRIMITIVE_", choice, number, "Kind of primitive: " # doc # "."> {
  string Record = record;             // a descriptor
  bit IsOpaque = 1;                   // a pixel has the nearest, and blends nothing
  int PixelWords = 4;                 // of the pixel buffer, in a render
  int OutputWords = 4;                // of a pixel at vr_output
}
def : FrontEndUnit<"conic", 0, "vx_gaussian", "the exponential of a quadratic form"> {
  let Report = "power";
  let IsOpaque = 0;
  let Multipliers = 7;
  let Adders = 4;
  let Source = "first stage [paper]; a dx dx, c dy dy, b dx dy and the half are 7 multiplications, dx, dy and two sums 4 additions";
}
def : FrontEndUnit<"triangle", 1, "vx_triangle", "three edges and a plane of depths"> {
  let PixelWords = 2;
  let OutputWords = 2;
  let Latency = 2;
  let Multipliers = 2;
  let Adders = 3;
  let ProductBits = !mul(3, 2, 6, 32);
  let AdderBits = !mul(3, 2, 40);
  let Source = "a of 32 bits times a column of 6, b times a row, three times, and two sums of 40; depth takes 2 multiplications and 2 additions, the test a comparison; ours";
}
def : FrontEndUnit<"ray", 3, "vx_ray_gaussian", "a Gaussian in 3D that the pixel's ray meets"> {
  let IsOpaque = 0;
  let Latency = !add(2, DividerLatency);
  let Multipliers = 12;
  let Adders = 7;
  let ProductBits = DividerProductBits;
  let AdderBits = DividerRowBits;
  let ChoiceBits = !add(DividerRowBits, 32);
  let RegisterBits = DividerRegisterBits;
  let Source = "a dx, b dy, c dy, their two squares, the plane's two steps and its square, the weight, the half and the square of degree 4 are 11 multiplications, dx, dy and five sums 7 additions, in two cycles; a divider as VR_RECIPROCAL_EXACT; a choice of degrees; ours";
}
// A number that docs/primitives.md gives to a kind which is not built.
class ReservedFrontEndNumber<int number, string choice> {
  int Value = number;
  string Choice = choice;
}
def : ReservedFrontEndNumber<2, "wide-conic">;

// vr_options.exp. Its bodies: ExpVector.h and ScalarUnits.h of isasim/raster/.
class ExpUnit<string choice, int number, string bound, string doc>
    : LaneUnit<"VR_EXP_", choice, number, "Exponential unit: " # doc # "."> {
  string MaxRelativeError = bound;    // for results of at least 2^-125
  // What the cores' path is compiled with, if it has the unit: the file of
  // apps/splat/kernels/, and the degree of the polynomial if it is units.cl.
  string Kernel = "units.cl";
  int KernelDegree = 0;
}
class TableExpUnit<string choice, int number, string bound, int entries, int startBits>
    : ExpUnit<choice, number, bound, "table of " # entries # " entries"> {
  let Kernel = "";
  let Latency = 3;
  let ProductBits = !add(!mul(24, 24), !mul(12, 12));
  let AdderBits = !add(startBits, 8);
  let TableBits = !mul(entries, !add(startBits, 12));
}
class PolynomialExpUnit<int degree, int number, string bound, string steps>
    : ExpUnit<"poly" # degree, number, bound, "base-2 polynomial of degree " # degree> {
  let KernelDegree = degree;
  let Latency = !add(degree, 2);
  let Multipliers = !add(degree, 1);
  let Adders = !add(degree, 1);
  let AdderBits = 8;
  let Source = "y, then " # steps # " steps of Horner's rule, in fp32; y's fraction; an exponent";
}

def : ExpUnit<"exact", 0, "0x1p-24", "correctly rounded"> {
  let Report = "correctly-rounded";
  let Kernel = "falloff.cl";
  let Latency = 8;
  let ProductBits = !mul(16, 53, 53);
  let AdderBits = !mul(14, 53);
  let Source = "16 multipliers of 53 x 53 bits, 14 adders of 53: as the simulator finds the nearest number";
}
def : TableExpUnit<"table", 1, "2.85e-4", 16, 17> {
  let Source = "y 24 x 24 bits, a rest times a drop 12 x 12; a sum of 17, an exponent";
}
def : TableExpUnit<"table32", 5, "8.3e-5", 32, 18> { let Source = "as table, with a sum of 18"; }
def : TableExpUnit<"table64", 6, "2.65e-5", 64, 19> { let Source = "as table, with a sum of 19"; }
def : PolynomialExpUnit<2, 2, "2.7e-3", "two">;
def : PolynomialExpUnit<3, 3, "1.1e-4", "three">;
def : PolynomialExpUnit<4, 4, "7.2e-6", "four">;
// Numbers of units that are gone, which no other unit takes: a program that
// asks for one is refused, and never computes with another unit.
class ReservedExpNumber<int number, string choice> {
  int Value = number;
  string Choice = choice;             // the name that the unit had on command lines
}
def : ReservedExpNumber<7, "linear">;
def : ReservedExpNumber<8, "schraudolph">;

// vr_options.blend. Its bodies: BlendVector.h and ScalarUnits.h.
class BlendUnit<string choice, int number, int significandBits, string doc>
    : LaneUnit<"VR_BLEND_", choice, number, "Blend arithmetic: " # doc # "."> {
  int SignificandBits = significandBits; // of a multiplication's operands
  let Adders = 5;
}
class NarrowBlendUnit<string choice, int number, int significandBits>
    : BlendUnit<choice, number, significandBits, choice # " multiplications, fp32 sums"> {
  let Report = "blend " # choice;
  let ProductBits = !mul(4, significandBits, significandBits);
  let AdderBits = !add(!mul(4, 8), !mul(3, 16));
  let Source = "alpha T and three colours are 4 multiplications whose products are exact, so without rounding or normalisation: a significand product and an exponent sum of 8 each; 4 fp32 sums, the cut-off a comparison; 3 operands rounded by sums of 16";
}

def : BlendUnit<"fp32", 0, 24, "fp32"> {
  let Report = "blend";
  let Multipliers = 5;
  let Source = "third stage [paper]; T (1 - alpha), alpha T and three colours are 5 multiplications and 4 additions, the cut-off a comparison";
}
def : NarrowBlendUnit<"bf16", 1, 8>;
def : NarrowBlendUnit<"fp16", 2, 11>;

// vr_backward.reciprocal, of a pair of lanes. Its body: ReciprocalVector.h.
class ReciprocalUnit<string choice, int number, string bound, int latency, string doc>
    : LaneUnit<"VR_RECIPROCAL_", choice, number, "Reciprocal unit: " # doc # "."> {
  string MaxRelativeError = bound;    // over alpha in [1/255, 0.99], rounding included
  let Latency = latency;
}
// From a table's entry, or by the Taylor series. The paper's units take 3
// multiplications below 0.5 and 4 above, one after the other, and an addition
// each; three steps take 6. A pair of lanes has one multiplier to spare
// (docs/rasterizer.md, "The backward mode").
class IteratedReciprocalUnit<string choice, int number, string bound, int latency, string doc>
    : ReciprocalUnit<choice, number, bound, latency, doc> {
  let Multipliers = 3;
  let Adders = 3;
  let TableBits = !mul(8, 24);
  // Between stages: 1 - alpha, or alpha, and what is made of it so far.
  let RegisterBits = !mul(!sub(latency, 1), 2, 32);
  let Source = "three multipliers and three adders [paper], the fourth multiplication in the pair's spare multiplier";
}

def : ReciprocalUnit<"exact", 0, "0x1p-23", DividerLatency, "T / (1 - alpha), correctly rounded"> {
  let Multipliers = 1;
  let ProductBits = DividerProductBits;
  let AdderBits = DividerRowBits;
  let ChoiceBits = DividerRowBits;
  let RegisterBits = DividerRegisterBits;
  let Source = "a divider, an fp32 multiplier with 26 subtractions of 24 bits in place of the product, and registers; ours";
}
def : IteratedReciprocalUnit<"even-left", 1, "0.5462", 6, "Taylor to alpha^4 below 0.5; above, two Newton-Raphson steps from 8 entries evenly spaced in alpha, exact at their left ends">;
def : IteratedReciprocalUnit<"even-best", 2, "0.3230", 6, "as VR_RECIPROCAL_EVEN_LEFT, with the entries' best seeds">;
def : IteratedReciprocalUnit<"log-left", 3, "0.0313", 6, "as VR_RECIPROCAL_EVEN_LEFT, with entries evenly spaced in log(1 - alpha)">;
def : IteratedReciprocalUnit<"log-best", 4, "0.0313", 6, "as VR_RECIPROCAL_LOG_LEFT, with the entries' best seeds">;
def : IteratedReciprocalUnit<"mantissa-2", 5, "1.25e-5", 5, "8 entries by the mantissa of 1 - alpha, two Newton-Raphson steps">;
def : IteratedReciprocalUnit<"mantissa-3", 6, "1.7e-7", 7, "8 entries by the mantissa of 1 - alpha, three Newton-Raphson steps"> {
  let Multipliers = 5;
  let Source = "six multiplications, in five multipliers and the pair's spare one, and three adders; ours";
}
