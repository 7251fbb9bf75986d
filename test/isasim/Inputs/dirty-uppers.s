# Calls of another object's function, for vector_uppers.py.
  .text
clean:
  vzeroupper
  call elsewhere
  call elsewhere        # legacy code leaves them clean
  ret

one_path:
  vzeroupper
  testl %edi, %edi
  je 1f
  vmovdqu (%rsi), %ymm0
  vmovdqu %ymm0, (%rdx)
1:
  call elsewhere
  ret

own_call:
  vzeroupper
  call clean
  call elsewhere
  ret

tail:
  vmovdqu (%rsi), %ymm0
  jmp elsewhere
