break shared.cl:7
continue
print squares
print squares[5]
info symbol squares
set var squares[3] = 77
print squares[3]
detach
