# The signature region as riscv-arch-test dumps it, by either way of asking.
# REQUIRES: vorion-sim
# RUN: llvm-mc-19 -triple=riscv32 -filetype=obj %s -o %t.o && ld.lld-19 --defsym=FIRST_ADDRESS=0x80000000 -T %S/Inputs/test-program.ld %t.o -o %t.elf
# RUN: vorion-sim %t.elf --one-hart +signature=%t.words && FileCheck %s --check-prefix=WORDS --match-full-lines < %t.words
# WORDS:          c0ffee01
# WORDS-NEXT:     00000002
# WORDS-NEXT:     00000503
# WORDS-NOT:      {{.}}
# RUN: vorion-sim %t.elf --one-hart +signature=%t.long +signature-granularity=8
# RUN: FileCheck %s --check-prefix=LONG --match-full-lines < %t.long
# LONG:           00000002c0ffee01
# LONG-NEXT:      0000000000000503
# RUN: vorion-sim %t.elf --one-hart --signature %t.again && diff %t.words %t.again
# RUN: not vorion-sim %t.elf --one-hart +signature=%t.none +signature-granularity=3 2>&1 | FileCheck %s --check-prefix=GRAIN
# GRAIN: vorion-sim: error: --signature-granularity: {{.*}}3

# Without the symbols, or without a file to write to, there is none.
# RUN: llvm-objcopy-19 --strip-all %t.elf %t.stripped
# RUN: not vorion-sim %t.stripped --set max_instructions=100000 --one-hart +signature=%t.none 2>&1 | FileCheck %s --check-prefix=LIMIT
# LIMIT: limit reached: {{[0-9]+}} instructions, the maximum
# RUN: not vorion-sim %t.elf --one-hart +signature=%t.nofolder/x 2>&1 | FileCheck %s --check-prefix=FOLDER
# FOLDER: vorion-sim: error: {{.*}}.nofolder/x: cannot write: No such file or directory
  .globl _start
_start:
  la t0, begin_signature
  li t1, 0xc0ffee01
  sw t1, 0(t0)
  li t1, 5
  sb t1, 9(t0)
  la t0, tohost
  li t1, 1
1:
  sw t1, 0(t0)
  j 1b
  .data
  .balign 4
  .globl begin_signature, end_signature, tohost
begin_signature:
  .word 1, 2, 3
end_signature:
  .word 4
  .balign 8
tohost:
  .dword 0
