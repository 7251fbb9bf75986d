; A switch is branches: no jump through a table, which lanes could not take apart.
; REQUIRES: vorion-llc
; RUN: vorion-llc -mtriple=riscv32 -mcpu=vorion < %s | FileCheck %s

declare void @sink(i32)

; CHECK-LABEL: cases:
; CHECK-NOT: {{[ \t]jr[ \t]}}
; CHECK-NOT: LJTI
; CHECK: vx_split
; CHECK-NOT: LJTI
define void @cases(i32 %x) {
  switch i32 %x, label %default [ i32 0, label %a
                                  i32 1, label %b
                                  i32 2, label %c
                                  i32 3, label %d
                                  i32 4, label %a
                                  i32 5, label %b ]
a:
  call void @sink(i32 10)
  br label %b
b:
  call void @sink(i32 11)
  br label %end
c:
  call void @sink(i32 12)
  br label %end
d:
  call void @sink(i32 13)
  br label %end
default:
  call void @sink(i32 14)
  br label %end
end:
  ret void
}
