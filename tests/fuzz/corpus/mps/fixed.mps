*2345678901234567890123456789012345678901234567890
NAME          FIXED
ROWS
 N  THE COST
 G  ROW 1
 L  ROW 2
COLUMNS
    COL 1     THE COST         1.0   ROW 1            1.0
    COL 1     ROW 2            1.0
    COL 2     THE COST         2.0   ROW 2           -1.0
RHS
    RHS       ROW 1           1.5    ROW 2            3.0
BOUNDS
 UP BOUND     COL 1            4.0
ENDATA
