#!/bin/bash
# Stands for Slurm's sbatch: runs the wrapped command for each number of the array.
for word in "$@"; do
  case $word in
  --array=1-*) last=${word#--array=1-} && last=${last%\%*} ;;
  --wrap) wrapped=next ;;
  *) [ "${wrapped-}" != next ] || wrapped=$word ;;
  esac
done
for ((task = 1; task <= last; ++task)); do
  SLURM_ARRAY_TASK_ID=$task bash -c "$wrapped" || exit 1
done
