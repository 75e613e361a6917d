#!/usr/bin/env bash
# SPDX-License-Identifier: Zlib
# gather.sh RESULTS: one line of CSV for each result, by jq
set -euo pipefail
jq --raw-output --slurp '
  ["scene", "held_kg", "dripped_kg", "evaporated_kg", "mean_saturation", "max_stretch", "ms_per_step", "state_hash"],
  (sort_by(.scene)[] |
    [.scene, .ledger.held, .ledger.dripped, .ledger.evaporated, .saturation.mean, .max_stretch, .wall_ms_per_step, .state_hash])
  | @csv' "$1"/*.json
