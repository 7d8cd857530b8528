"""The kernels, a line each: what an item takes in each form, and how near the best comes to reading."""
PREFIX = 'kernel/'  # kernel/<name>/<form>


def is_kernel(name):
    return name.startswith(PREFIX)


def by_form(results):
    """{kernel: {form: Result}}"""
    kernels = {}
    for each in results.values():
        if is_kernel(each.name):
            _, kernel, form = each.name.split('/')
            kernels.setdefault(kernel, {})[form] = each
    return kernels


def lines(results, cache_rate):
    """Rows of cells, the heading first; none where no kernel was measured."""
    kernels = by_form(results)
    forms = list(dict.fromkeys(form for measured in kernels.values() for form in measured))
    if kernels:
        yield ('ns an item', *forms, 'bytes', 'GB/s', 'x cache')
    for kernel, measured in kernels.items():
        times = {form: each.seconds / each.items * 1e9 for form, each in measured.items()}
        best = min(measured.values(), key=lambda each: each.seconds)
        yield (kernel, *(f'{times[form]:.3f}' if form in times else '' for form in forms),
               f'{best.bytes / best.items:.3g}', f'{best.bytes / best.seconds / 1e9:.1f}',
               f'{best.seconds * cache_rate / best.bytes:.1f}' if cache_rate else '')
