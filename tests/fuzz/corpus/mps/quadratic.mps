NAME q
ROWS
 N o
COLUMNS
 x o -1
 y o 0
BOUNDS
 UP b x 3
 LO b y -3
 UP b y -5
QMATRIX
 x x 2
 x y 1
 y x 1
 y y 4
ENDATA
