#!/usr/bin/env bash
# SPDX-License-Identifier: Zlib
# A Slurm job array, a scene each; scenes.txt has one path a line. A task that was preempted goes on from its checkpoint:
#   sbatch --array=0-$(($(wc -l <scenes.txt) - 1)) slurm_array.sh scenes.txt results [OPTION...]
#SBATCH --job-name=wetcloth
#SBATCH --cpus-per-task=1
#SBATCH --mem=1G
#SBATCH --time=02:00:00
#SBATCH --requeue
#SBATCH --open-mode=append
set -euo pipefail
scenes=$1 results=$2
shift 2
scene=$(sed -n "$((SLURM_ARRAY_TASK_ID + 1))p" "$scenes")
# Slurm runs a copy of this file; run_one.sh is in the folder that sbatch was called with, or RUN_ONE says where.
exec "${RUN_ONE:-$SLURM_SUBMIT_DIR/run_one.sh}" "$results" "$scene" "$@"
