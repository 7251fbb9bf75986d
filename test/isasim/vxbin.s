# A raw program of Vortex: two addresses and the bytes between them. It is code
# and data at once, and prints by bytes, each lane to its own.
# REQUIRES: vorion-mc, vorion-sim
# RUN: sh %S/Inputs/assemble.sh %build %s %t.elf
# RUN: llvm-objcopy-19 -O binary %t.elf %t.raw
# RUN: %python -c "import struct,sys; d=open(sys.argv[1],'rb').read(); open(sys.argv[2],'wb').write(struct.pack('<QQ',0x80000000,0x80000000+len(d)+4096)+d)" %t.raw %t.vxbin
# RUN: vorion-sim %t.vxbin --one-hart | FileCheck %s
# CHECK: ok
# RUN: head -c 15 %t.vxbin > %t.short.vxbin
# RUN: not vorion-sim %t.short.vxbin 2>&1 | FileCheck %s --check-prefix=SHORT
# SHORT: vorion-sim: error: {{.*}}.short.vxbin: truncated: 15 bytes, expected at least the two addresses of a .vxbin file
# RUN: %python -c "import struct,sys; open(sys.argv[1],'wb').write(struct.pack('<QQ',0x10000,0x20000))" %t.low.vxbin
# RUN: not vorion-sim %t.low.vxbin 2>&1 | FileCheck %s --check-prefix=LOW
# LOW: vorion-sim: error: {{.*}}.low.vxbin: addresses 0x10000 to 0x20000, expected a range within 0x80000000 and 0x81000000
# RUN: %python -c "import struct,sys; open(sys.argv[1],'wb').write(struct.pack('<QQ',0x80000000,0x80000004)+bytes(8))" %t.long.vxbin
# RUN: not vorion-sim %t.long.vxbin 2>&1 | FileCheck %s --check-prefix=LONG
# LONG: 8 bytes for 0x80000000 to 0x80000004, expected at most 4
  .globl _start
_start:
  la t0, word
  sw zero, 2044(t0) # beyond the file's bytes
  lw t1, 0(t0)
  addi t1, t1, 1
  sw t1, 0(t0)      # in the middle of the program
  lw t1, 0(t0)
  csrr t2, vx_thread_id
  addi t2, t2, 0x40
  sb t1, 0(t2)
  li t1, 'k'
  sb t1, 0(t2)
  li t1, '\n'
  sb t1, 0(t2)
  vx_tmc zero
word:
  .word 'n'
