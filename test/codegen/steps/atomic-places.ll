; Which loads and stores are atomic accesses: those that say so, and loads that a
; compare-exchange of the same place judges.
; REQUIRES: vorion-opt, vorion-llc
; RUN: vorion-opt -mtriple=riscv32 -mcpu=vorion -passes=vorion-atomic-places -S %s | FileCheck %s
; RUN: vorion-llc -O0 -mtriple=riscv32 -mcpu=vorion %s -o - | FileCheck %s --check-prefix=CODE
; RUN: vorion-llc -mtriple=riscv32 -mcpu=vorion %s -o - | FileCheck %s --check-prefix=CODE

; CHECK-LABEL: @plain(
; CHECK: load atomic {{.*}} !pcsections ![[MD:[0-9]+]]
; CHECK: store atomic {{.*}} !pcsections ![[MD]]
; CHECK-NOT: !pcsections
; CODE-LABEL: plain:
; CODE: [[LOAD:\.Lpcsection[0-9]+]]:
; CODE-NEXT: lw
; CODE: [[STORE:\.Lpcsection[0-9]+]]:
; CODE-NEXT: sw
; CODE: .section vorion_atomics,
; CODE: .word [[LOAD]]-
; CODE: .word [[STORE]]-
; CODE-NOT: .word
define i32 @plain(ptr %p, ptr %q) {
  %v = load atomic i32, ptr %p acquire, align 4
  store atomic i32 7, ptr %p release, align 4
  store i32 %v, ptr %q
  %w = load volatile i32, ptr %q
  ret i32 %w
}

; CHECK-LABEL: @judged(
; CHECK: load volatile float, ptr %p, align 4, !pcsections ![[MD]]
; CHECK: load volatile i32, ptr %q, align 4{{$}}
; CODE-LABEL: judged:
; CODE: .Lpcsection{{[0-9]+}}:
; CODE-NEXT: flw
define i32 @judged(ptr %p, ptr %q, float %x) {
entry:
  br label %loop
loop:
  %old = load volatile float, ptr %p
  %new = fadd float %old, %x
  %expected = bitcast float %old to i32
  %bits = bitcast float %new to i32
  %r = cmpxchg ptr %p, i32 %expected, i32 %bits monotonic monotonic
  %ok = extractvalue { i32, i1 } %r, 1
  br i1 %ok, label %done, label %loop
done:
  %other = load volatile i32, ptr %q
  %s = cmpxchg ptr %p, i32 %other, i32 0 monotonic monotonic
  ret i32 %other
}

; The compiler's own loops begin with a load: here of two words.
; CODE-LABEL: wide:
; CODE: .Lpcsection{{[0-9]+}}:
; CODE-NEXT: lw
; CODE: .Lpcsection{{[0-9]+}}:
; CODE-NEXT: lw
; CODE: amocas.d
define i64 @wide(ptr %p, i64 %x) {
  %a = atomicrmw add ptr %p, i64 %x monotonic
  ret i64 %a
}

; CODE-LABEL: nothing:
; CODE-NOT: vorion_atomics
define i32 @nothing(ptr %p, i32 %x) {
  %a = atomicrmw add ptr %p, i32 %x monotonic
  ret i32 %a
}

; CHECK: ![[MD]] = !{!"vorion_atomics"}
