#!/usr/bin/env bash
# Format and static analysis of the code we wrote; part of scripts/test.sh.
# usage: scripts/lint.sh [--all|--fix]   (--fix formats in place, without analysis;
# --all analyses the tests too, which takes twice as long)
source "$(dirname "$0")/lib.sh"
showHelp "$@"
cd "$Root"

mapfile -t Sources < <(git ls-files '*.cpp' '*.cc' '*.h' '*.c')
if [ "${1:-}" = --fix ]; then
  clang-format-19 -i "${Sources[@]}"
  exit 0
fi
clang-format-19 --dry-run -Werror "${Sources[@]}"

# clang-tidy looks at what the build compiles; each file once. LLVM's and PoCL's passes
# follow the naming of the code they extend and are left out. It reads each file without the
# headers that the build compiles once: a file that does not include what it uses is found here.
Commands=$Build/lint
mapfile -t Units < <(python3 - "$Build" "$Root" "$Commands" "${1:-}" <<'PY'
import json, os, re, sys
build, root, folder, option = sys.argv[1:]
ours = tuple(f"{root}/{part}/" for part in ("support", "isasim", "libdevice", "runtime", "apps", "reference", "test"))
commands = []
for entry in json.load(open(f"{build}/compile_commands.json")):
    path = os.path.realpath(entry["file"])
    if path.startswith(ours) and path.endswith(".cpp") and (option == "--all" or not path.endswith("_test.cpp")):
        entry["command"] = re.sub(r"-Xclang -include(-pch)? -Xclang \S+|-Winvalid-pch|-fpch-instantiate-templates", "", entry["command"])
        commands.append(entry | {"file": path})
os.makedirs(folder, exist_ok=True)
with open(f"{folder}/compile_commands.json", "w") as file:
    json.dump(commands, file)
print("\n".join(sorted({entry["file"] for entry in commands})))
PY
)
# Its checks would walk through every declaration of the system's headers, which takes three
# quarters of the time and finds nothing that is shown.
OwnDeclarations=$Build/lib/libvorion-own-declarations.so
[ -e "$OwnDeclarations" ] || fail "no $OwnDeclarations, expected what scripts/setup.sh builds"
printf '%s\n' "${Units[@]}" | xargs -P "$(nproc)" -n 4 clang-tidy-19 -p "$Commands" --quiet "--load=$OwnDeclarations"
