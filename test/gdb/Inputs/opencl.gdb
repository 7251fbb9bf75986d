break twice
continue
list 3,3
delete
continue
