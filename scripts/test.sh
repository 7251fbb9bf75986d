#!/usr/bin/env bash
# Sets the machine up and runs every test; says what each layer took; the last line counts them.
# usage: scripts/test.sh [--quick] [--minutes N]
# --quick: without lint and sanitizer builds
# --minutes N: those two take what is left of N minutes, and say what they left out for want of time
source "$(dirname "$0")/lib.sh"
showHelp "$@"
Quick= Minutes=
while [ $# -gt 0 ]; do
  case "$1" in
  --quick) Quick=1 ;;
  --minutes)
    Minutes=${2:-}
    case "$Minutes" in "" | 0* | *[!0-9]*) fail "--minutes: '$Minutes', expected a whole number above 0" ;; esac
    shift
    ;;
  *) fail "unknown option $1, expected --quick or --minutes" ;;
  esac
  shift
done

# share PERCENT: so many percent of the seconds that are left, at least one; a day where nothing limits them.
share() {
  local Left=86400
  [ -z "$Minutes" ] || Left=$((Minutes * 60 - (SECONDS - Started)))
  echo $((Left > 100 ? Left * $1 / 100 : 1))
}

# buildWithSanitizers SECONDS: what is not built by then is left out, which Unfinished says.
Unfinished="$Root/build/asan/unfinished"
buildWithSanitizers() {
  local Status=0
  cmake --preset asan -S "$Root"
  rm -f "$Unfinished"
  timeout "$1" cmake --build "$Root/build/asan" -j "$Jobs" || Status=$?
  [ "$Status" -ne 124 ] || touch "$Unfinished"
  [ "$Status" -eq 0 ] || [ "$Status" -eq 124 ]
}

"$Root/scripts/setup.sh" --tests
source "$Root/scripts/env.sh"
Results="$Root/build/results"
rm -rf "$Results"
mkdir -p "$Results"
readJobs
Failed=0

printf '[%s] unit tests\n' "$(elapsed)"
# The lit suites are CTest tests too; below they are run and counted test by test.
ctest --test-dir "$Build" -j "$Jobs" -E '^lit\.' --output-on-failure --output-junit "$Results/ctest.xml" >"$Logs/ctest.log" 2>&1 ||
  { Failed=1; grep -E '\(Failed\)|\(Timeout\)|Not Run|error:' "$Logs/ctest.log" | tail -n 40 || true; }

printf '[%s] lit tests\n' "$(elapsed)"
python3 /usr/lib/llvm-19/build/utils/lit/lit.py -v -j "$Jobs" --param "build=$Build" \
  --xunit-xml-output "$Results/lit.xml" "$Root/test" >"$Logs/lit.log" 2>&1 ||
  { Failed=1; tail -n 20 "$Logs/lit.log"; }

# Of the time that is left the analysis of all files needs 30 %. The build with sanitizers needs 70 % of what it leaves,
# and its tests the rest.
if [ -z "$Quick" ]; then
  printf '[%s] format and static analysis\n' "$(elapsed)"
  "$Root/scripts/lint.sh" --seconds "$(share 30)" >"$Logs/lint.log" 2>&1 ||
    { Failed=1; echo "FAILED lint"; grep -E 'error:' "$Logs/lint.log" | head -n 40 || tail -n 5 "$Logs/lint.log"; }
  grep '^clang-tidy: ' "$Logs/lint.log" || true
  step "sanitizer build" asan-build buildWithSanitizers "$(share 70)"
  printf '[%s] tests under address and undefined-behaviour sanitizers\n' "$(elapsed)"
  ctest --test-dir "$Root/build/asan" -j "$Jobs" --output-on-failure --output-junit "$Results/asan.xml" \
    >"$Logs/asan.log" 2>&1 || [ -e "$Unfinished" ] ||
    { Failed=1; grep -E '\(Failed\)|\(Timeout\)|ERROR:|runtime error' "$Logs/asan.log" | tail -n 40 || true; }
fi

printf '[%s] done\n' "$(elapsed)"
# What may be missing is the private data, PyTorch, peers (scripts/peers.sh), and the right to mount; and the sanitizer build
# has no OpenCL device. A host without AVX-512 does not run what is translated for it.
Skips='(no|\w+: no) \.\./shared/data|\w+: Missing required feature\(s\): (data|torch|own-mounts|((python3-(pil|opencv)|colmap|ffmpeg|npm-[a-z0-9-]+)(, )?)+)$|\w+: the translation needs another host|asan: no OpenCL device'
[ ! -e "$Unfinished" ] || Skips="$Skips|asan: programs that are not built"
python3 "$Root/scripts/count-tests.py" --times --skips "$Skips" "$Results"/*.xml || Failed=1
exit "$Failed"
