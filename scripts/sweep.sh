#!/usr/bin/env bash
# `splat accuracy ARGUMENTS` or `splat explore ARGUMENTS` with its points under GNU
# parallel, or as a Slurm array: the same points, files and page. What is measured
# already, made from the same, is not measured again, so a broken sweep goes on where
# it stopped.
# usage: scripts/sweep.sh [--jobs N] [--slurm] accuracy|explore ARGUMENTS
#        scripts/sweep.sh --jobs 8 accuracy scene.ply --cameras cameras.json -o FOLDER
# With --slurm the folder must be one that all nodes see. --jobs is how many points are
# measured at the same time; default: the number of processors.
source "$(dirname "$0")/lib.sh"
showHelp "$@"
source "$Root/scripts/env.sh"

Jobs=$(nproc)
Slurm=0
while :; do
  case ${1:-} in
  --jobs)
    Jobs=${2:-}
    case "$Jobs" in '' | 0* | *[!0-9]*) fail "--jobs: '$Jobs', expected a whole number above 0" ;; esac
    shift 2
    ;;
  --slurm) Slurm=1 && shift ;;
  accuracy | explore) break ;;
  *) fail "'${1:-}', expected accuracy or explore with arguments, --jobs N or --slurm" ;;
  esac
done

measure() { # the points of standard input
  if [ "$Slurm" = 0 ]; then
    parallel --halt now,fail=1 --jobs "$Jobs" splat "${Arguments[@]}" --only {}
    return
  fi
  local Folder Failed=0 List Log
  Folder=$(mktemp -d -p . sweep.XXXXXX)
  # A Slurm that was not told otherwise takes arrays of 1,000 jobs.
  split --lines=1000 - "$Folder/list."
  for List in "$Folder"/list.*; do
    Log=$(printf %q "$List.log.")\$SLURM_ARRAY_TASK_ID
    sbatch --quiet --wait --array="1-$(wc -l < "$List")%$Jobs" --output=/dev/null --export=ALL --wrap "$(
      printf '%q ' splat "${Arguments[@]}" --only
    ) \"\$(sed -n \"\${SLURM_ARRAY_TASK_ID}p\" $(printf %q "$List"))\" > $Log 2>&1 && rm $Log" || Failed=1
  done
  if [ "$Failed" = 1 ]; then # what jobs said that failed
    cat "$Folder"/*.log.* >&2 2>/dev/null || true
    fail "not all jobs ended well, expected a Slurm whose nodes see this folder; the same command goes on"
  fi
  rm -r "$Folder"
}

# Figures are of the page, which only the last command writes.
Arguments=() Figures=()
while [ $# != 0 ]; do
  case $1 in
  --figures) Figures=("${@:1:2}") && shift "${#Figures[@]}" ;;
  --figures=*) Figures=("$1") && shift ;;
  *) Arguments+=("$1") && shift ;;
  esac
done
# What the first points find out says which the second are.
for _ in 1 2; do
  Points=$(splat "${Arguments[@]}" --list)
  [ -z "$Points" ] || measure <<< "$Points"
done
splat "${Arguments[@]}" "${Figures[@]}"
