# What the instructions of a run are worth, and what is refused;
# docs/tables/energy.md has the rows that there are.
# REQUIRES: vorion-mc, vorion-sim
# RUN: rm -rf %t && mkdir %t
# RUN: vorion-sim --print-energy-parameters > %t/made
# RUN: sed -n '/begin of what is made/,/end of what is made/{//!p}' %S/../../docs/tables/energy.md > %t/kept
# RUN: cmp %t/made %t/kept
# RUN: sh %S/Inputs/assemble.sh %build %s %t/p.elf
# RUN: vorion-sim %t/p.elf --energy > %t/first
# RUN: FileCheck %s --input-file %t/first --implicit-check-not=note
# RUN: vorion-sim %t/p.elf --energy --set host_threads=1 | cmp - %t/first
# RUN: vorion-sim %t/p.elf --voltage 0.8 | FileCheck %s --check-prefix=VOLTS
# Counters of a run say it where the clock is on, and of all runs.
# RUN: vorion-sim %t/p.elf --time --stats %t/timed.json > %t/timed.txt
# RUN: vorion-sim %t/p.elf --stats %t/untimed.json > %t/untimed.txt
# RUN: %python -c "import json; s = json.load(open('%t/timed.json')); e = s['runs'][0]['energy']; assert e == s['energy'] and 0 < e['chip_joules']['value'] < e['joules']['value']; printed = next(l for l in open('%t/first') if l.startswith('all ')).split()[1]; assert format(1e3 * e['joules']['value'], '.4g') == printed"
# RUN: not grep -q energy %t/untimed.json
# The default technology can be written, changed and read again.
# RUN: vorion-sim --print-technology > %t/mine.json
# RUN: vorion-sim %t/p.elf --technology %t/mine.json | cmp - %t/first
# Counters, and power over time, are by the same numbers.
# RUN: vorion-sim %t/p.elf --voltage 0.8 --stats %t/volts.json --timeline %t/volts.time > %t/volts
# RUN: vorion-sim %t/p.elf --time --timeline %t/timed.time > %t/timed.txt
# RUN: %python -c "import json; at = [json.load(open('%t/' + n + '.json'))['energy']['chip_joules']['value'] for n in ('volts', 'timed')]; printed = next(l for l in open('%t/volts') if l.startswith('all ')).split()[1]; assert at[0] < 0.6 * at[1]; j = json.load(open('%t/volts.json'))['energy']['joules']['value']; assert format(1e3 * j, '.4g') == printed"
# RUN: %python -c "import json; most = [max(v for e in json.load(open('%t/' + n + '.time'))['traceEvents'] if e.get('name') == 'chip, mW' and e['ph'] == 'C' for v in e['args'].values()) for n in ('volts', 'timed')]; assert 0 < most[0] < 0.6 * most[1], most"
# RUN: sed 's/"pj": 4.8/"pj": -4.8/' %t/mine.json > %t/negative.json
# RUN: not vorion-sim %t/p.elf --technology %t/negative.json 2>&1 | FileCheck %s --check-prefix=NEGATIVE
# RUN: sed '/"tile command"/d' %t/mine.json > %t/missing.json
# RUN: not vorion-sim %t/p.elf --technology %t/missing.json 2>&1 | FileCheck %s --check-prefix=MISSING
# RUN: sed 's/"gate"/"gaet"/' %t/mine.json > %t/unknown.json
# RUN: not vorion-sim %t/p.elf --technology %t/unknown.json 2>&1 | FileCheck %s --check-prefix=UNKNOWN
# RUN: not vorion-sim %t/p.elf --energy --clock 2000 2>&1 | FileCheck %s --check-prefix=FAST
# RUN: not vorion-sim %t/p.elf --energy --set timing.dram.standard=hbm2e 2>&1 | FileCheck %s --check-prefix=DRAM
# CHECK: cycles
# CHECK: energy mJ 5 % 95 % %
# CHECK: front end
# CHECK: arithmetic
# CHECK: leakage
# CHECK: dram
# CHECK: chip
# CHECK: all
# CHECK: power: chip {{.*}} W ({{.*}} to {{.*}}), all {{.*}}, 1.150 V, technology 16nm
# RUN: vorion-sim %t/p.elf --voltage 0.5 | FileCheck %s --check-prefix=LOW
# VOLTS: 0.800 V, technology 16nm
# VOLTS-NEXT: note: at 0.800 V the technology's frequency law allows {{[0-9]+}} MHz, and the clock is 530
# LOW: note: 0.500 V is below 0.57 V, the lower end of the technology's frequency law
# NEGATIVE: error: {{.*}}negative.json: key energies.instruction fetched.pj is -4.8, expected a number from 0 to
# MISSING: error: {{.*}}missing.json: key energies.tile command is missing
# UNKNOWN: error: {{.*}}unknown.json: key areas.gate is missing
# FAST: error: a clock of 2000 MHz exceeds the frequency law of technology 16nm, which ends at 530 MHz, expected --voltage
# DRAM: error: technology 16nm has no currents for the machine's DRAM, 'hbm2e', expected a --technology with them
  .globl _start
_start:
  li a1, 100
1:
  mul a2, a1, a1
  addi a1, a1, -1
  bnez a1, 1b
  li a0, 0
  .insn r 0x0b, 0, 0, x0, a0, x0
