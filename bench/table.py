"""The results as one table, beside what it takes to read the same bytes once."""
import kernel_table
import results as measured

COLUMNS = ('', 'ms', 'GB/s', 'ns/px', 'ns/px/frame', 'x reading')
OURS, PEER = 'reconstruct/face', 'opencv/face'
GOAL_GROWTH = 1.3


def rate(results, name):
    """Bytes per second; 0 where it was not measured."""
    each = results.get(name)
    return each.bytes / each.seconds if each else 0


def row(name, seconds, work, memory_rate, cache_rate):
    """`work` is the result whose bytes, pixels and frames the time was spent on."""
    def each(amount):
        return f'{seconds / amount * 1e9:.3f}' if amount else ''
    # What is faster than reading them from cache has not gone through all bytes.
    reads = work.bytes and (not cache_rate or work.bytes / seconds < 1.01 * cache_rate)
    return (name, f'{seconds * 1e3:.3f}', f'{work.bytes / seconds / 1e9:.2f}' if reads else '',
            each(work.pixels), each(work.pixels * work.frames),
            f'{seconds * memory_rate / work.bytes:.1f}' if work.bytes and memory_rate else '')


def rows(results):
    rates = rate(results, 'bandwidth/memory'), rate(results, 'bandwidth/cache')
    for each in results.values():
        if kernel_table.is_kernel(each.name):
            continue
        yield row(each.name, each.seconds, each, *rates)
        for stage, seconds in each.stages.items():
            if stage != 'total':
                yield row('  ' + stage, seconds, each, *rates)


def aligned(lines):
    widths = [max(map(len, column)) for column in zip(*lines)]
    for first, *others in lines:
        cells = [first.ljust(widths[0]), *map(str.rjust, others, widths[1:])]
        yield '  '.join(cells).rstrip()


def comparison(results):
    """OpenCV's steps against our stages of the same names."""
    ours, peer = results.get(OURS), results.get(PEER)
    if not ours or not peer:
        return []
    lines = [('', 'OpenCV ms', 'ours ms', 'ratio')]
    for stage, seconds in peer.stages.items():
        own = ours.stages[stage]
        lines.append((stage, f'{seconds * 1e3:.3f}', f'{own * 1e3:.3f}', f'{seconds / own:.2f}'))
    decode, whole = peer.stages['decode'], ours.stages['total']
    lines.append(('its decode, our total', f'{decode * 1e3:.3f}', f'{whole * 1e3:.3f}',
                  f'{decode / whole:.2f}'))
    return ['', *aligned(lines)]


def table(results):
    lines = list(aligned([COLUMNS, *rows(results)]))
    if 'bandwidth/memory' in results:
        lines += ['', 'x reading: times as long as one core reads these bytes from memory']
    growth = measured.growth(results)
    if growth:
        lines += ['', f'growth: reconstruct/large takes {growth:.2f} times as long as '
                      f'reconstruct/small for a pixel and frame (goal: at most {GOAL_GROWTH})']
    kernels = list(kernel_table.lines(results, rate(results, 'bandwidth/cache')))
    if kernels:
        lines += ['', *aligned(kernels), '', 'bytes: of an item; GB/s: of the fastest form; '
                  'x cache: times as long as it reads these bytes from its cache']
    return '\n'.join(lines + comparison(results))
