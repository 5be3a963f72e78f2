* A linear program: ship goods from three plants to five markets at least cost.
* NORTH_ALDER is what goes from NORTH to ALDER; a unit costs the length of the way.
* A plant sends no more than it makes, a market gets no less than it needs.
* The least cost is 4110.
NAME          TRANSPORT
ROWS
 N  COST
 L  NORTH
 L  HARBOUR
 L  VALLEY
 G  ALDER
 G  BIRCH
 G  CEDAR
 G  ELM
 G  FIR
COLUMNS
    NORTH_ALDER     COST        6
    NORTH_ALDER     NORTH       1
    NORTH_ALDER     ALDER       1
    NORTH_BIRCH     COST        3
    NORTH_BIRCH     NORTH       1
    NORTH_BIRCH     BIRCH       1
    NORTH_CEDAR     COST        12
    NORTH_CEDAR     NORTH       1
    NORTH_CEDAR     CEDAR       1
    NORTH_ELM       COST        8
    NORTH_ELM       NORTH       1
    NORTH_ELM       ELM         1
    NORTH_FIR       COST        8
    NORTH_FIR       NORTH       1
    NORTH_FIR       FIR         1
    HARBOUR_ALDER   COST        5
    HARBOUR_ALDER   HARBOUR     1
    HARBOUR_ALDER   ALDER       1
    HARBOUR_BIRCH   COST        12
    HARBOUR_BIRCH   HARBOUR     1
    HARBOUR_BIRCH   BIRCH       1
    HARBOUR_CEDAR   COST        7
    HARBOUR_CEDAR   HARBOUR     1
    HARBOUR_CEDAR   CEDAR       1
    HARBOUR_ELM     COST        15
    HARBOUR_ELM     HARBOUR     1
    HARBOUR_ELM     ELM         1
    HARBOUR_FIR     COST        5
    HARBOUR_FIR     HARBOUR     1
    HARBOUR_FIR     FIR         1
    VALLEY_ALDER    COST        9
    VALLEY_ALDER    VALLEY      1
    VALLEY_ALDER    ALDER       1
    VALLEY_BIRCH    COST        10
    VALLEY_BIRCH    VALLEY      1
    VALLEY_BIRCH    BIRCH       1
    VALLEY_CEDAR    COST        5
    VALLEY_CEDAR    VALLEY      1
    VALLEY_CEDAR    CEDAR       1
    VALLEY_ELM      COST        5
    VALLEY_ELM      VALLEY      1
    VALLEY_ELM      ELM         1
    VALLEY_FIR      COST        7
    VALLEY_FIR      VALLEY      1
    VALLEY_FIR      FIR         1
RHS
    RHS  NORTH       350
    RHS  HARBOUR     400
    RHS  VALLEY      300
    RHS  ALDER       180
    RHS  BIRCH       230
    RHS  CEDAR       150
    RHS  ELM         210
    RHS  FIR         120
ENDATA
