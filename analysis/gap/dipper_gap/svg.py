"""The drawings of the report, each a piece of SVG text that scales with the page."""
from html import escape

import numpy as np

NOTHING = 0.005  # probability below which a strength is not worth showing
INK, GREY, LINE = "#1c2733", "#6b7a89", "#d5dce3"
MEASURED, BEFORE, AFTER = "#1c2733", "#b8652a", "#1f7a8c"


def number(x):
    """Two digits that count, without powers of ten."""
    return f"{x:.2g}" if abs(x) < 100 else f"{x:.0f}"


def open_svg(width, height, label):
    return (f'<svg viewBox="0 0 {width:g} {height:g}" role="img" aria-label="{escape(label)}" '
            f'xmlns="http://www.w3.org/2000/svg">')


def text(x, y, said, size=12, colour=INK, anchor="start", weight="normal"):
    return (f'<text x="{x:.1f}" y="{y:.1f}" font-size="{size}" fill="{colour}" text-anchor="{anchor}" '
            f'font-weight="{weight}">{escape(said)}</text>')


def diverging(z, top=6.0):
    """Blue below, white at 0, orange above."""
    share = min(abs(z) / top, 1.0) ** 0.8
    end = (31, 122, 140) if z < 0 else (200, 94, 30)
    return "rgb(%d,%d,%d)" % tuple(round(255 + (e - 255) * share) for e in end)


def heat_map(title, rows, columns, value, marked, tip):
    """`value(row, column)` a number or None; `marked` draws a frame; `tip` is shown under the pointer."""
    left, top, w, h = 150, 44, 62, 22
    width, height = left + w * len(columns) + 4, top + h * len(rows) + 6
    out = [open_svg(width, height, title), text(0, 14, title, 13, weight="600")]
    for j, c in enumerate(columns):
        out.append(text(left + w * (j + 0.5), top - 8, c, 11, GREY, "middle"))
    for i, r in enumerate(rows):
        out.append(text(left - 8, top + h * i + 15, r, 11, anchor="end"))
        for j, c in enumerate(columns):
            z = value(r, c)
            x, y = left + w * j, top + h * i
            if z is None:
                out.append(f'<rect x="{x + 1}" y="{y + 1}" width="{w - 2}" height="{h - 2}" fill="#f2f4f6"/>')
                continue
            frame = f' stroke="{INK}" stroke-width="2"' if marked(r, c) else ""
            out.append(f'<g><title>{escape(tip(r, c))}</title><rect x="{x + 1}" y="{y + 1}" width="{w - 2}" '
                       f'height="{h - 2}" fill="{diverging(z)}"{frame}/>')
            out.append(text(x + w / 2, y + 15, f"{z:.1f}", 11, "white" if abs(z) > 4.2 else INK, "middle") + "</g>")
    return "".join(out) + "</svg>"


def ticks(low, high, count=4):
    span = max(high - low, 1e-12)
    step = 10 ** np.floor(np.log10(span / count))
    step *= next(m for m in (1, 2, 5, 10) if span / (m * step) <= count + 0.5)
    return [float(x) * step + 0.0 for x in np.arange(np.ceil(low / step), np.floor(high / step) + 0.5)]


def curves(title, c, unit):
    """Measured dots, the model before (with its seeds' spread) and after, against time."""
    left, top, width, height = 52, 34, 460, 198
    lines = [c.measured, c.before - 2 * c.spread, c.before + 2 * c.spread] + ([c.after] if c.after is not None else [])
    low, high = min(v.min() for v in lines), max(v.max() for v in lines)
    end = float(c.time_s[-1])
    right, bottom = width - 8, height - 26

    def x(t):
        return left + (right - left) * np.asarray(t) / end

    def y(v):
        return bottom - (bottom - top) * (np.asarray(v) - low) / max(high - low, 1e-9)

    def path(v):
        return " ".join(f"{a:.1f},{b:.1f}" for a, b in zip(x(c.time_s), y(v)))

    out = [open_svg(width, height, title), text(0, 13, title, 13, weight="600")]
    for v in ticks(low, high):
        out.append(f'<line x1="{left}" x2="{right}" y1="{y(v):.1f}" y2="{y(v):.1f}" stroke="{LINE}"/>')
        out.append(text(left - 6, float(y(v)) + 4, f"{v:g}", 10, GREY, "end"))
    for t in (v for v in ticks(0, end, 6) if x(v) < right - 20):  # the unit stands at the end
        out.append(text(float(x(t)), height - 10, f"{t:g}", 10, GREY, "middle"))
    out.append(text(right, height - 10, "s", 10, GREY, "end") + text(left - 6, top - 7, unit, 10, GREY, "end"))
    band = path(c.before + 2 * c.spread) + " " + " ".join(reversed(path(c.before - 2 * c.spread).split()))
    out.append(f'<polygon points="{band}" fill="{BEFORE}" opacity="0.18"/>')
    out.append(f'<polyline points="{path(c.before)}" fill="none" stroke="{BEFORE}" stroke-width="1.8"/>')
    if c.after is not None:
        out.append(f'<polyline points="{path(c.after)}" fill="none" stroke="{AFTER}" stroke-width="2.2"/>')
    out += [f'<circle cx="{a:.1f}" cy="{b:.1f}" r="2.2" fill="{MEASURED}"/>'
            for a, b in zip(x(c.time_s), y(c.measured))]
    return "".join(out) + "</svg>"


def ranking(rows):
    """[(title, probability, estimate, low, high, unit, bounds)]: bars of probability, interval beside them."""
    h, left, bar, far = 30, 130, 130, 760
    height = h * len(rows) + 26
    out = [open_svg(far, height, "ranked effects"), text(left, 12, "probability", 11, GREY),
           text(left + bar + 60, 12, "strength, 90 % interval, within its bounds", 11, GREY)]
    for i, (title, p, estimate, low, high, unit, bounds) in enumerate(rows):
        y = 24 + h * i
        out.append(text(left - 8, y + 14, title, 12, anchor="end"))
        out.append(f'<rect x="{left}" y="{y + 4}" width="{bar}" height="13" fill="#eef1f4"/>'
                   f'<rect x="{left}" y="{y + 4}" width="{max(bar * p, 1):.1f}" height="13" fill="{AFTER}"/>')
        out.append(text(left + bar + 6, y + 15, f"{100 * p:.1f} %", 11))
        if p < NOTHING:
            continue
        start, end = left + bar + 60, far - 250

        def at(v):
            return start + (end - start) * (v - bounds[0]) / (bounds[1] - bounds[0])

        out.append(f'<line x1="{start}" x2="{end}" y1="{y + 11}" y2="{y + 11}" stroke="{LINE}" stroke-width="2"/>'
                   f'<line x1="{at(0):.1f}" x2="{at(0):.1f}" y1="{y + 5}" y2="{y + 17}" stroke="{GREY}"/>'
                   f'<line x1="{at(low):.1f}" x2="{at(high):.1f}" y1="{y + 11}" y2="{y + 11}" stroke="{AFTER}" '
                   f'stroke-width="5"/><circle cx="{at(estimate):.1f}" cy="{y + 11}" r="4" fill="{INK}"/>')
        out.append(text(end + 8, y + 15, f"{number(estimate)} ({number(low)} ... {number(high)}) {unit}", 11))
    return "".join(out) + "</svg>"


def bars(title, values, top):
    """[(label, value, colour)] as horizontal bars up to `top`."""
    h, left, width = 22, 90, 420
    out = [open_svg(width, h * len(values) + 24, title), text(0, 13, title, 13, weight="600")]
    for i, (label, v, colour) in enumerate(values):
        y = 22 + h * i
        long = (width - left - 60) * min(v / max(top, 1e-9), 1.0)
        out.append(text(left - 8, y + 13, label, 11, anchor="end"))
        out.append(f'<rect x="{left}" y="{y + 2}" width="{max(long, 1):.1f}" height="14" fill="{colour}"/>')
        out.append(text(left + long + 6, y + 13, f"{v:.2f}", 11))
    return "".join(out) + "</svg>"
