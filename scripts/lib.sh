# What the scripts share; sourced, not run. Sets Root (the checkout) and Build.
set -euo pipefail

Root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
Build="$Root/build/dev"
Logs="$Root/build/logs"
Started=$SECONDS

# Another checkout of the same sources finds what this one compiled.
export CCACHE_BASEDIR="$Root" CCACHE_NOHASHDIR=1

fail() { # fail MESSAGE: one line, exit code 1
  printf '%s: error: %s\n' "$(basename "$0")" "$1" >&2
  exit 1
}

# readJobs: sets Jobs to what VORION_JOBS says, or to the number of processors.
readJobs() {
  Jobs=${VORION_JOBS:-$(nproc)}
  case "$Jobs" in 0* | *[!0-9]*) fail "VORION_JOBS: '$Jobs', expected a whole number above 0" ;; esac
}

elapsed() { printf '%d:%02d' $(((SECONDS - Started) / 60)) $(((SECONDS - Started) % 60)); }

# say MESSAGE: a line from the command of a step, which its log would hide.
say() { printf '%s[%s] %s\n' "$([ ! -t 8 ] || printf '\r\033[K')" "$(elapsed)" "$1" >&8; }

# step TITLE LOG COMMAND...: runs it with its output in build/logs/LOG.log, says what
# is going on (on a terminal with the last line of output), and on failure shows the log's end.
# What the command says by itself goes through descriptor 8.
step() {
  local Title=$1 Log="$Logs/$2.log" Pid Status=0 Last Indent=8 Columns
  shift 2
  mkdir -p "$Logs"
  printf '[%s] %s\n' "$(elapsed)" "$Title"
  "$@" 8>&1 >"$Log" 2>&1 </dev/null &
  Pid=$!
  # Whoever interrupts it gets a prompt on a line of its own.
  [ ! -t 1 ] || trap 'printf "\n"; trap - INT; kill -INT $$' INT
  while kill -0 "$Pid" 2>/dev/null; do
    if [ -t 1 ]; then
      # A window's size changes, and its last column would begin a new line.
      { Columns=$(stty size <&8 | cut -d ' ' -f 2); } 8>&1
      [ "${Columns:-0}" -gt "$((Indent + 1))" ] || Columns=80
      Last=$(tail -n 1 "$Log" | LC_ALL=C tr -dc '[:print:]' | cut -c "1-$((Columns - Indent - 1))")
      printf '\r\033[K%*s%s' "$Indent" '' "$Last"
    fi
    sleep 0.3
  done
  [ ! -t 1 ] || { printf '\r\033[K' && trap - INT; }
  wait "$Pid" || Status=$?
  if [ "$Status" -ne 0 ]; then
    tail -n 40 "$Log" >&2
    fail "$Title failed with status $Status, the whole log is ${Log#"$Root"/}"
  fi
}

# makeRoot NEW_FOLDER [RELEASE]: a fresh Debian root (of Debian 12, bookworm), with what a chroot into it needs until
# the script ends.
makeRoot() {
  local Folder=$1 Release=${2:-bookworm} Mirror Extra
  [ -e "$Folder" ] && fail "$Folder exists, expected the name of a new folder"
  # The mirror that this machine's own apt uses has the other releases, too.
  Mirror=$(apt-get indextargets --format '$(CODENAME) $(REPO_URI)' 'Created-By: Packages' |
    awk '$1 == "bookworm" || $1 == "trixie" { print $2; exit }')
  [ -n "$Mirror" ] || fail "apt knows no mirror of Debian 12 or 13 (bookworm, trixie)"
  # shellcheck disable=SC2064 # the folder is what it is now
  trap "umount '$Folder/dev/pts' '$Folder/dev' '$Folder/proc' 2>/dev/null || true; umount -R '$Folder/sys' 2>/dev/null || true" EXIT
  step "making a Debian root ($Release)" debootstrap debootstrap --variant=minbase "$Release" "$Folder" "$Mirror"
  cp /etc/resolv.conf "$Folder/etc/resolv.conf"
  # As Debian's installer does.
  printf '127.0.0.1 localhost %s\n' "$(hostname)" >"$Folder/etc/hosts"
  for Extra in /etc/apt/apt.conf.d/*proxy*; do
    [ -e "$Extra" ] && cp "$Extra" "$Folder/etc/apt/apt.conf.d/"
  done
  mount -t proc proc "$Folder/proc"
  mount --bind /dev "$Folder/dev"
  mount --bind /dev/pts "$Folder/dev/pts" # tests open terminals
  # Slurm's nodes look for processors and control groups. What is unmounted there stays mounted here.
  mount --rbind /sys "$Folder/sys"
  mount --make-rslave "$Folder/sys"
}

# showHelp "$@": with --help, says what the script's first lines say, and ends.
showHelp() {
  case "${1:-}" in -h | --help) sed -n '2,/^[^#]/s/^# \{0,1\}//p' "$0" && exit 0 ;; esac
}
