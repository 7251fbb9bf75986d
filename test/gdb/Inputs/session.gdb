info threads
break square
continue
backtrace
info registers a0 pc mask
continue
print x
thread 4
print $mask
next
stepi
watch results[3]
delete 1
continue
set var results[3] = 77
print results[3]
set $a5 = 5
print $a5
print $fa0
delete
thread 20
print $sp
continue
