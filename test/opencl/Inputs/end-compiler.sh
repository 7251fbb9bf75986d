# Compiles f.cl of a folder, ends the compiler by a signal as soon as it runs
# the compiler of kernels, and prints what is left of it.
# usage: end-compiler.sh SIGNAL FOLDER
set -u
Signal=$1
Folder=$2
Temporary=TMPDIR=$Folder/temporary

# The processes that began with this folder for temporary files: only the
# compiler and what it runs do.
left() { grep -lzxF "$Temporary" /proc/[0-9]*/environ 2>/dev/null | cut -d/ -f3; }
count() { left | wc -l; }

# Waits, half a minute at most, until their number is as is said.
waitFor() {
  local Try
  for Try in $(seq 300); do
    [ "$(count)" "$1" "$2" ] && return
    sleep 0.1
  done
  echo "waited in vain for $1 $2 processes, there are $(count)"
}

env "$Temporary" vorion-clang "-I$Folder" "$Folder/f.cl" -o "$Folder/f.elf" &
Compiler=$!
waitFor -ge 2
kill "-$Signal" "$Compiler"
wait "$Compiler" 2>/dev/null
echo "exit code $?"
waitFor -eq 0
echo "$(count) processes"
echo "$(ls "$Folder/temporary" | wc -l) temporary files"
for Process in $(left); do kill -KILL "$Process"; done
