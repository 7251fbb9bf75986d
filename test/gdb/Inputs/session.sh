# usage: session.sh PROGRAM COMMANDS [OPTION...]: runs PROGRAM under vorion-sim and
# gdb with the file COMMANDS; prints gdb's transcript, then what vorion-sim said.
#        session.sh --opencl COMMAND COMMANDS LOG: the same with a host program,
# whose kernel gdb finds by itself.
if [ "$1" = --opencl ]; then
  host=$2; commands=$3; log=$4; program=
  : > "$log"
  VORION_GDB=0 $host 2> "$log" & simulator=$!
  said="the host program"
else
  program=$1; commands=$2; shift 2
  log=$program.gdb.log
  : > "$log"
  vorion-sim "$program" --gdb 0 "$@" 2> "$log" & simulator=$!
  said=vorion-sim
fi
port=
while [ -z "$port" ]; do
  kill -0 $simulator || { cat "$log"; exit 1; }
  sleep 0.05
  port=$(sed -n 's/.*waiting on port \([0-9]*\).*/\1/p' "$log")
done
# Standard input rather than -x, which ends at the first error.
gdb-multiarch -q -nx -ex 'set pagination off' -ex 'set confirm off' -ex 'set width 0' -ex 'set prompt' -ex "target remote 127.0.0.1:$port" ${program:+"$program"} < "$commands" 2>&1
wait $simulator
echo "$said ended with $?"
cat "$log"
