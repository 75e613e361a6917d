#!/usr/bin/env bash
# SPDX-License-Identifier: Zlib
# on_this_machine.sh RESULTS SCENE...: all scenes, one on each processor at a time, by GNU parallel. A run that fails or is
# killed is tried three times. Called again, it does what is not done. JOBS, else the processors; OPTIONS go to each run.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
results=$1
shift
mkdir -p "$results"
# shellcheck disable=SC2086
exec parallel --will-cite --jobs "${JOBS:-100%}" --retries 3 --joblog "$results/jobs.log" \
  "$here/run_one.sh" "$results" {} ${OPTIONS:-} ::: "$@"
