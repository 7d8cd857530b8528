"""What Google Benchmark measured, as its JSON tells it."""
import json
import re
import statistics
from collections import namedtuple

# seconds: processor time of one iteration (wall time where the benchmark asks for it).
# stages: seconds by name, in their order and `total` last; empty where the benchmark has none.
# items: of a kernel's call; 0 elsewhere.
Result = namedtuple('Result', 'name seconds bytes pixels frames stages items')

STAGE = 'stage:'  # stage:<two digits>:<name>
SETTINGS = re.compile('/(real_time$|min_time:.*)')  # as the library adds them to names
UNITS = {'ns': 1e-9, 'us': 1e-6, 'ms': 1e-3, 's': 1.0}


def median(runs, value):
    return statistics.median(value(run) for run in runs)


def seconds(run):
    clock = 'real_time' if run['run_name'].endswith('/real_time') else 'cpu_time'
    return run[clock] * UNITS[run['time_unit']]


def result(name, runs):
    first = runs[0]
    stages = {key.split(':')[2]: median(runs, lambda run, key=key: run[key])
              for key in sorted(first) if key.startswith(STAGE)}
    return Result(SETTINGS.sub('', name), median(runs, seconds), first.get('bytes', 0),
                  first.get('pixels', 0), first.get('frames', 0), stages,
                  first.get('items', 0))


def load(path):
    """{name: Result}, in the order of the program: medians of the repetitions."""
    with open(path, encoding='utf-8') as file:
        document = json.load(file)
    runs = {}
    for run in sorted(document['benchmarks'], key=lambda run: run.get('family_index', 0)):
        if run.get('error_occurred'):
            raise SystemExit(f'{run["run_name"]}: {run["error_message"]}')
        if run.get('run_type') == 'iteration':
            runs.setdefault(run['run_name'], []).append(run)
    results = [result(name, repetitions) for name, repetitions in runs.items()]
    return {each.name: each for each in results}


def per_pixel_and_frame(each):
    return each.seconds / (each.pixels * each.frames)


def growth(results):
    """How many times the small scan's time a pixel and frame the large one takes; or None."""
    small, large = results.get('reconstruct/small'), results.get('reconstruct/large')
    return per_pixel_and_frame(large) / per_pixel_and_frame(small) if small and large else None
