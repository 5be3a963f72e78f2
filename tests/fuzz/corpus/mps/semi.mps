NAME
ROWS
 N o
 L r
COLUMNS
 s o 1 r 1
 t o -1 r 1
 u r 1
RHS
 b r 9
BOUNDS
 LO b s 2
 SC b s 5
 LO b t 1
 SI b t 4
 SC b u 3
ENDATA
