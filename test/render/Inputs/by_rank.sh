#!/bin/sh
# usage: mpirun.sh -n 2 by_rank.sh FIRST SECOND: a command line for each process. Open MPI has a colon for that, at which
# its version 5.0.7 ends with a segmentation fault.
shift "$OMPI_COMM_WORLD_RANK"
exec sh -c "exec $1"
