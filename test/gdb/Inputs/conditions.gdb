break leave.cl:11 if i == 5
continue
backtrace
print s
delete
thread 1
break leave.cl:11 if $_thread == 40
continue
print i
delete
thread 1
break leave.cl:11 thread 43
continue
delete
watch -location ((int *)o)[9]
continue
print i
delete
dprintf leave.cl:11,"lane %d has %d\n", i, s
continue
