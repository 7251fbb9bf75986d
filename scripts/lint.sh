#!/usr/bin/env bash
# Format and static analysis of the code we wrote; part of scripts/test.sh.
# usage: scripts/lint.sh [--all|--fix]   (--fix formats in place, without analysis;
# --all analyses the tests too, which takes twice as long)
source "$(dirname "$0")/lib.sh"
cd "$Root"

mapfile -t Sources < <(git ls-files '*.cpp' '*.cc' '*.h' '*.c')
if [ "${1:-}" = --fix ]; then
  clang-format-19 -i "${Sources[@]}"
  exit 0
fi
clang-format-19 --dry-run -Werror "${Sources[@]}"

# clang-tidy looks at what the build compiles; each file once. LLVM's and PoCL's passes
# follow the naming of the code they extend and are left out.
mapfile -t Units < <(python3 - "$Build/compile_commands.json" "$Root" "${1:-}" <<'PY'
import json, os, sys
root = sys.argv[2] + "/"
tests = sys.argv[3] == "--all"
ours = ("support/", "isasim/", "libdevice/", "runtime/", "apps/", "reference/", "test/")
files = {os.path.realpath(e["file"]) for e in json.load(open(sys.argv[1]))}
print("\n".join(sorted(f for f in files if f.startswith(root) and f[len(root):].startswith(ours)
                       and f.endswith(".cpp") and (tests or not f.endswith("_test.cpp")))))
PY
)
# Its checks would walk through every declaration of the system's headers, which takes three
# quarters of the time and finds nothing that is shown.
OwnDeclarations=$Build/lib/libvorion-own-declarations.so
[ -e "$OwnDeclarations" ] || fail "no $OwnDeclarations, expected what scripts/setup.sh builds"
printf '%s\n' "${Units[@]}" | xargs -P "$(nproc)" -n 4 clang-tidy-19 -p "$Build" --quiet "--load=$OwnDeclarations"
