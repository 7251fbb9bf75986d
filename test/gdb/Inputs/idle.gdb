break square
shell sleep 5
continue
