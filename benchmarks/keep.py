#!/usr/bin/env python3
# SPDX-License-Identifier: Zlib
"""Keeps what Google Benchmark measured: a line for each, and of the machine what matters to compare.

keep.py MEASURED.json KEPT.json
"""

import json
import sys

OF_THE_MACHINE = ('date', 'num_cpus', 'mhz_per_cpu', 'cpu_scaling_enabled', 'caches', 'library_build_type')
NOT_A_RESULT = {'name', 'family_index', 'per_family_instance_index', 'run_name', 'run_type', 'repetitions', 'threads',
                'repetition_index', 'iterations', 'real_time', 'time_unit'}


def rounded(value):
    return float('%.4g' % value) if isinstance(value, float) else value


def main():
    with open(sys.argv[1], encoding='utf-8') as file:
        measured = json.load(file)
    context = {key: measured['context'][key] for key in OF_THE_MACHINE if key in measured['context']}
    lines = []
    for one in measured['benchmarks']:
        result = {'name': one['name'], 'time_unit': one.get('time_unit')}
        result.update((key, rounded(value)) for key, value in one.items() if key not in NOT_A_RESULT)
        lines.append('    ' + json.dumps(result))
    with open(sys.argv[2], 'w', encoding='utf-8') as file:
        file.write('{\n  "machine": %s,\n  "results": [\n%s\n  ]\n}\n' % (json.dumps(context), ',\n'.join(lines)))


if __name__ == '__main__':
    main()
