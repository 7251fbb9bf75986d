set print thread-events off
set breakpoint pending on
break other
break same
continue
list 3,3
continue
list 3,3
continue
delete
continue
