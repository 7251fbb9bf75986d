break add
continue
break 5
continue
info args
info locals
thread 6
info locals
kill
