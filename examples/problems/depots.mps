* A mixed-integer program: which depots to open, and which one serves each town.
* OPEN_WEST is 1 where the depot WEST is opened, WEST_T1 where it serves the town T1.
* Every town has one depot; a depot serves no more than it has room for.
* The least cost is 453.
NAME          DEPOTS
ROWS
 N  COST
 E  SERVE_T1
 E  SERVE_T2
 E  SERVE_T3
 E  SERVE_T4
 E  SERVE_T5
 E  SERVE_T6
 E  SERVE_T7
 L  ROOM_WEST
 L  ROOM_EAST
 L  ROOM_SOUTH
 L  ROOM_MIDDLE
COLUMNS
    MARKER    'MARKER'    'INTORG'
    OPEN_WEST       COST        90
    OPEN_WEST       ROOM_WEST   -120
    OPEN_EAST       COST        80
    OPEN_EAST       ROOM_EAST   -110
    OPEN_SOUTH      COST        100
    OPEN_SOUTH      ROOM_SOUTH  -150
    OPEN_MIDDLE     COST        130
    OPEN_MIDDLE     ROOM_MIDDLE  -160
    WEST_T1         COST        30
    WEST_T1         SERVE_T1    1
    WEST_T1         ROOM_WEST   30
    WEST_T2         COST        45
    WEST_T2         SERVE_T2    1
    WEST_T2         ROOM_WEST   45
    WEST_T3         COST        30
    WEST_T3         SERVE_T3    1
    WEST_T3         ROOM_WEST   25
    WEST_T4         COST        100
    WEST_T4         SERVE_T4    1
    WEST_T4         ROOM_WEST   50
    WEST_T5         COST        56
    WEST_T5         SERVE_T5    1
    WEST_T5         ROOM_WEST   35
    WEST_T6         COST        96
    WEST_T6         SERVE_T6    1
    WEST_T6         ROOM_WEST   40
    WEST_T7         COST        48
    WEST_T7         SERVE_T7    1
    WEST_T7         ROOM_WEST   20
    EAST_T1         COST        78
    EAST_T1         SERVE_T1    1
    EAST_T1         ROOM_EAST   30
    EAST_T2         COST        99
    EAST_T2         SERVE_T2    1
    EAST_T2         ROOM_EAST   45
    EAST_T3         COST        40
    EAST_T3         SERVE_T3    1
    EAST_T3         ROOM_EAST   25
    EAST_T4         COST        80
    EAST_T4         SERVE_T4    1
    EAST_T4         ROOM_EAST   50
    EAST_T5         COST        28
    EAST_T5         SERVE_T5    1
    EAST_T5         ROOM_EAST   35
    EAST_T6         COST        32
    EAST_T6         SERVE_T6    1
    EAST_T6         ROOM_EAST   40
    EAST_T7         COST        16
    EAST_T7         SERVE_T7    1
    EAST_T7         ROOM_EAST   20
    SOUTH_T1        COST        30
    SOUTH_T1        SERVE_T1    1
    SOUTH_T1        ROOM_SOUTH  30
    SOUTH_T2        COST        99
    SOUTH_T2        SERVE_T2    1
    SOUTH_T2        ROOM_SOUTH  45
    SOUTH_T3        COST        20
    SOUTH_T3        SERVE_T3    1
    SOUTH_T3        ROOM_SOUTH  25
    SOUTH_T4        COST        100
    SOUTH_T4        SERVE_T4    1
    SOUTH_T4        ROOM_SOUTH  50
    SOUTH_T5        COST        42
    SOUTH_T5        SERVE_T5    1
    SOUTH_T5        ROOM_SOUTH  35
    SOUTH_T6        COST        48
    SOUTH_T6        SERVE_T6    1
    SOUTH_T6        ROOM_SOUTH  40
    SOUTH_T7        COST        48
    SOUTH_T7        SERVE_T7    1
    SOUTH_T7        ROOM_SOUTH  20
    MIDDLE_T1       COST        48
    MIDDLE_T1       SERVE_T1    1
    MIDDLE_T1       ROOM_MIDDLE  30
    MIDDLE_T2       COST        54
    MIDDLE_T2       SERVE_T2    1
    MIDDLE_T2       ROOM_MIDDLE  45
    MIDDLE_T3       COST        15
    MIDDLE_T3       SERVE_T3    1
    MIDDLE_T3       ROOM_MIDDLE  25
    MIDDLE_T4       COST        50
    MIDDLE_T4       SERVE_T4    1
    MIDDLE_T4       ROOM_MIDDLE  50
    MIDDLE_T5       COST        21
    MIDDLE_T5       SERVE_T5    1
    MIDDLE_T5       ROOM_MIDDLE  35
    MIDDLE_T6       COST        56
    MIDDLE_T6       SERVE_T6    1
    MIDDLE_T6       ROOM_MIDDLE  40
    MIDDLE_T7       COST        28
    MIDDLE_T7       SERVE_T7    1
    MIDDLE_T7       ROOM_MIDDLE  20
    MARKER    'MARKER'    'INTEND'
RHS
    RHS  SERVE_T1    1
    RHS  SERVE_T2    1
    RHS  SERVE_T3    1
    RHS  SERVE_T4    1
    RHS  SERVE_T5    1
    RHS  SERVE_T6    1
    RHS  SERVE_T7    1
BOUNDS
 UP BND  OPEN_WEST  1
 UP BND  OPEN_EAST  1
 UP BND  OPEN_SOUTH  1
 UP BND  OPEN_MIDDLE  1
 UP BND  WEST_T1  1
 UP BND  WEST_T2  1
 UP BND  WEST_T3  1
 UP BND  WEST_T4  1
 UP BND  WEST_T5  1
 UP BND  WEST_T6  1
 UP BND  WEST_T7  1
 UP BND  EAST_T1  1
 UP BND  EAST_T2  1
 UP BND  EAST_T3  1
 UP BND  EAST_T4  1
 UP BND  EAST_T5  1
 UP BND  EAST_T6  1
 UP BND  EAST_T7  1
 UP BND  SOUTH_T1  1
 UP BND  SOUTH_T2  1
 UP BND  SOUTH_T3  1
 UP BND  SOUTH_T4  1
 UP BND  SOUTH_T5  1
 UP BND  SOUTH_T6  1
 UP BND  SOUTH_T7  1
 UP BND  MIDDLE_T1  1
 UP BND  MIDDLE_T2  1
 UP BND  MIDDLE_T3  1
 UP BND  MIDDLE_T4  1
 UP BND  MIDDLE_T5  1
 UP BND  MIDDLE_T6  1
 UP BND  MIDDLE_T7  1
ENDATA
