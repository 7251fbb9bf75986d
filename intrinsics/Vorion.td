//===- Vorion.td - every instruction, CSR and descriptor of ours ----------===//
//
// The one definition. `llvm-tblgen --dump-json` of this file feeds the
// generators in this folder; nothing here is repeated by hand elsewhere.
//
//===----------------------------------------------------------------------===//

include "Effects.td"
include "Latencies.td"
include "Schema.td"
include "Rv32.td"
include "Simt.td"
include "Csrs.td"
include "RasterCsrs.td"
include "Units.td"
include "Counters.td"
include "Clock.td"
include "Descriptors.td"
