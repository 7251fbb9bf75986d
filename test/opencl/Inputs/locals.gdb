break locals.cl:12
continue
info locals
print add
thread 6
info locals
break locals.cl:3
continue
info locals
kill
