break leave.cl:5
continue
delete
thread 3
next
next
next
next
break leave.cl:6 if k == 5
next
next
delete
thread 3
next
print s
next
next
print s
detach
