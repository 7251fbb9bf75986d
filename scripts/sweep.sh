#!/bin/bash
# `splat accuracy ARGUMENTS` or `splat explore ARGUMENTS` with its points under GNU
# parallel, or as a Slurm array: the same points, files and page. What is measured
# already, made from the same, is not measured again, so a broken sweep goes on where
# it stopped.
#   scripts/sweep.sh [--jobs N] [--slurm] accuracy|explore ARGUMENTS
#   scripts/sweep.sh --jobs 8 accuracy scene.ply --cameras cameras.json --out FOLDER
# With --slurm the folder must be one that all nodes see.
set -euo pipefail
. "$(dirname "$0")/env.sh"

Jobs=$(nproc)
Slurm=0
while :; do
  case ${1:-} in
  --jobs) Jobs=$2 && shift 2 ;;
  --slurm) Slurm=1 && shift ;;
  *) break ;;
  esac
done

measure() { # the points of standard input
  if [ "$Slurm" = 0 ]; then
    parallel --halt now,fail=1 --jobs "$Jobs" splat "${Arguments[@]}" --only {}
    return
  fi
  local List
  List=$(mktemp -p .)
  cat > "$List"
  sbatch --wait --array="1-$(wc -l < "$List")%$Jobs" --output=/dev/null --export=ALL --wrap "$(
    printf '%q ' splat "${Arguments[@]}" --only
  ) \"\$(sed -n \"\${SLURM_ARRAY_TASK_ID}p\" $(printf %q "$List"))\""
  rm "$List"
}

Arguments=("$@")
# What the first points find out says which the second are.
for _ in 1 2; do
  Points=$(splat "${Arguments[@]}" --list)
  [ -z "$Points" ] || measure <<< "$Points"
done
splat "${Arguments[@]}"
