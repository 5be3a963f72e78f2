NAME free
OBJSENSE
 MAX
ROWS
 N cost
 N other
 L l
 G g
 E e
 E f
COLUMNS
 x cost 1 l 1
 x g -2.5
 m1 'MARKER' 'INTORG'
 i cost 3 e 1
 j e 1 f 2
 m2 'MARKER' 'INTEND'
 y other 1 f 1e-3
RHS
 rhs cost -5 l 4
 rhs e 2
RANGES
 r l 2 e -1
 r f 3
BOUNDS
 UP b x -4
 LI b i -3
 FR b y
ENDATA
