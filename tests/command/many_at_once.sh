#!/usr/bin/env bash
# SPDX-License-Identifier: Zlib
# many_at_once.sh SCRIPTS WETCLOTH SCENE FOLDER: the scripts of docs/many_at_once.md. A run that is killed goes on from its
# checkpoint, by GNU parallel and as a task of a Slurm array, and ends as one that was left alone. Without GNU parallel or jq
# it is skipped.
set -euo pipefail
scripts=$1 real=$2 scene=$3 folder=$4
for tool in parallel jq; do
  command -v $tool >/dev/null || { echo "$tool was not found: skipped"; exit 77; }
done
rm -rf "$folder"
mkdir -p "$folder/scenes"
cd "$folder"
for name in alone first second; do cp "$scene" "scenes/$name.json"; done

# The command; the first time it is to run `first`, it is killed behind its first checkpoint.
cat >command <<END_OF_COMMAND
#!/usr/bin/env bash
if [[ "\$*" == *first.json* && ! -e killed ]]; then
  "$real" "\$@" &
  while [[ ! -e results/first.state ]]; do sleep 0.01; done
  touch killed
  kill -9 \$!
  wait \$!
  exit 137
else
  [[ "\$*" == *--resume* ]] && touch resumed
  exec "$real" "\$@"
fi
END_OF_COMMAND
chmod +x command

export WETCLOTH=$PWD/command EVERY=1 OPTIONS='--duration 0.5'
JOBS=2 "$scripts/on_this_machine.sh" results scenes/*.json
[[ -e killed && -e resumed ]]
printf '%s\n' "$PWD"/scenes/*.json >scenes.txt
SLURM_ARRAY_TASK_ID=1 RUN_ONE=$scripts/run_one.sh "$scripts/slurm_array.sh" scenes.txt by_slurm --duration 0.5
hashes=$(jq --raw-output .state_hash results/*.json by_slurm/first.json | sort -u | wc -l)
[[ $hashes == 1 ]]
[[ $("$scripts/gather.sh" results | wc -l) == 4 ]]
