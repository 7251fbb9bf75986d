#!/usr/bin/env bash
# Sets the machine up and runs every test; says what each layer took; the last line counts them.
# usage: scripts/test.sh [--quick]   (--quick: without lint and sanitizer builds)
source "$(dirname "$0")/lib.sh"
showHelp "$@"
Quick=${1:-}
case "$Quick" in "" | --quick) ;; *) fail "unknown option $Quick, expected --quick" ;; esac

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
  { Failed=1; tail -n 60 "$Logs/lit.log"; }

if [ -z "$Quick" ]; then
  step "sanitizer build" asan-build sh -c "cmake --preset asan -S '$Root' && cmake --build '$Root/build/asan' -j $Jobs"
  printf '[%s] tests under address and undefined-behaviour sanitizers\n' "$(elapsed)"
  ctest --test-dir "$Root/build/asan" -j "$Jobs" --output-on-failure --output-junit "$Results/asan.xml" \
    >"$Logs/asan.log" 2>&1 || { Failed=1; grep -E '\(Failed\)|\(Timeout\)|ERROR:|runtime error' "$Logs/asan.log" | tail -n 40 || true; }
  printf '[%s] format and static analysis\n' "$(elapsed)"
  "$Root/scripts/lint.sh" >"$Logs/lint.log" 2>&1 || { Failed=1; echo "FAILED lint"; grep -E 'error:' "$Logs/lint.log" | head -n 40 || tail -n 5 "$Logs/lint.log"; }
fi

printf '[%s] done\n' "$(elapsed)"
# What may be missing is the private data, PyTorch, and the right to mount; and the sanitizer build has no OpenCL device.
python3 "$Root/scripts/count-tests.py" --times \
  --skips '(no|\w+: no) \.\./shared/data|\w+: Missing required feature\(s\): (data|torch|own-mounts)$|asan: no OpenCL device' \
  "$Results"/*.xml || Failed=1
exit "$Failed"
