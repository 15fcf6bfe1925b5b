#!/bin/bash
# A batch as a job array of Slurm: sbatch --array=0-31 slurm.sh SOURCE RESULTS
# Each task computes a share of the trials. Submit the same line again after a failure: only what is missing is computed.
#SBATCH --cpus-per-task=1
#SBATCH --mem=1G
set -euo pipefail
exec ambulo batch "$1" -o "$2" --resume --jobs 1 --shard "$SLURM_ARRAY_TASK_ID/$SLURM_ARRAY_TASK_COUNT"
