define state
  printf "state: ra %x sp %x a0 %x pc %x mask %x depth %d\n", $ra, $sp, $a0, $pc, $mask, $depth
end
break square
continue
delete
state
print square(12)
print half(3)
print add(5)
print add(5)
print called
state
thread 1
state
print square(9)
state
thread 2
print peek(4)
backtrace
return
state
set unwindonsignal on
print peek(4)
state
break add
print add(1)
print by
backtrace 2
print square(3)
finish
state
break square
print square(5)
return
state
delete
set $pc = main
state
continue
