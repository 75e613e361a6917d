#!/usr/bin/env bash
# SPDX-License-Identifier: Zlib
# run_one.sh RESULTS SCENE [OPTION...]: RESULTS/NAME.json of one scene. Killed and called again, it goes on from the last
# checkpoint; what is done is not done again. OPTIONs are those of `wetcloth run`, and must be the same each time.
set -euo pipefail
results=$1 scene=$2
shift 2
name=$(basename "$scene" .json)
done_file=$results/$name.json state=$results/$name.state
mkdir -p "$results"
if [[ -e $done_file ]]; then exit 0; fi

resume=()
if [[ -e $state ]]; then resume=(--resume "$state"); fi
"${WETCLOTH:-wetcloth}" run "$scene" --no-comparison --checkpoint "$state" --every "${EVERY:-600}" "${resume[@]}" \
  --json "$done_file.part" "$@" >&2
# A result is there whole, or not at all.
mv "$done_file.part" "$done_file"
rm -f "$state"
