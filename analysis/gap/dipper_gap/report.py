"""The answer as one HTML page that needs nothing but itself."""
from html import escape

import numpy as np

from . import svg
from .features import FEATURES
from .isolability import CONFUSABLE
from .match import strength
from .measured import KNOWN
from .phases import PHASES

SHOWN = 6  # effects in the ranking
CELL_P = 0.05

STYLE = """
body{margin:0;font:16px/1.5 system-ui,-apple-system,"Segoe UI",Roboto,sans-serif;color:#1c2733;background:#f7f8fa}
main{max-width:1080px;margin:0 auto;padding:20px 16px 60px}
h1{font-size:1.5rem;margin:.2em 0}h2{font-size:1.1rem;margin:2em 0 .5em}p{max-width:70ch}
.verdict{background:#fff;border-left:6px solid #1f7a8c;padding:14px 18px;border-radius:4px}
.verdict.unknown,.verdict.class{border-color:#b8652a}.verdict.no-gap{border-color:#6b7a89}
.verdict strong{font-size:1.25rem;display:block}
.facts{display:grid;grid-template-columns:repeat(auto-fit,minmax(150px,1fr));gap:10px;margin:14px 0}
.facts div{background:#fff;padding:10px 12px;border-radius:4px}.facts b{display:block;font-size:1.25rem}
.facts span{color:#6b7a89;font-size:.85rem}
.grid{display:grid;grid-template-columns:repeat(auto-fit,minmax(min(100%,470px),1fr));gap:14px}
.card{background:#fff;border-radius:4px;padding:12px;overflow-x:auto}.card svg{display:block;width:100%;height:auto}
.wide svg{min-width:480px}svg text{font-family:inherit}
table{border-collapse:collapse;font-size:.9rem;background:#fff}td,th{padding:4px 10px;text-align:left;
border-bottom:1px solid #e4e9ee;vertical-align:top}th{font-weight:600;color:#6b7a89}
td.n{text-align:right;font-variant-numeric:tabular-nums}
.scroll{overflow-x:auto}code,pre{font:13px/1.45 ui-monospace,Menlo,monospace}
pre{background:#fff;padding:10px;overflow-x:auto}
.key span{display:inline-block;width:12px;height:12px;margin:0 5px 0 14px;border-radius:2px}
.note{color:#6b7a89;font-size:.9rem}
"""


def write_report(out, answer, catalogue, file, case_name):
    file.write_text(page(out, answer, catalogue, case_name))


def page(out, answer, catalogue, case_name):
    parts = [_verdict(out, answer, catalogue), _warnings(out), _heat_maps(out), _ranking(out, catalogue),
             _alike(out), _before_after(out), _experiments(out), _rejected(out), _reproduce(out, answer)]
    return (f'<!doctype html><html lang="en"><head><meta charset="utf-8"><title>Gap: {escape(case_name)}</title>'
            '<meta name="viewport" content="width=device-width,initial-scale=1">'
            f"<style>{STYLE}</style></head><body><main><p class='note'>dipper gap, case {escape(case_name)}</p>"
            + "".join(parts) + "</main></body></html>\n")


def _verdict(out, a, catalogue):
    v = out.verdict
    titles = [catalogue[n].title for n in v.members]
    head = {"named": lambda: f"{titles[0]}: {_strength(a)}",
            "class": lambda: "One of: " + ", ".join(titles),
            "unknown": lambda: "There is a gap, and its cause is not known",
            "no-gap": lambda: "No gap that these data can show"}[v.verdict]()
    words = {"named": "The model misses this effect. With it added, fresh runs were compared with the passes "
                      "that had been held out.",
             "class": "These effects look alike in these data. The experiment below would tell them apart.",
             "unknown": "Model and mine disagree, but nothing in the catalogue may be named for it.",
             "no-gap": "Model and mine agree within instruments and seeds. That is no proof that nothing is missing."}
    if v.verdict == "unknown":
        words["unknown"] += f" It is clearest in {_clearest(out)}."
    reasons = "".join(f"<li>{escape(r)}</li>" for r in v.reasons)
    second = ""
    if out.second and out.second["verdict"] == "named":
        p = out.second["parameter"]
        second = (f"<p>A second effect shows: <b>{escape(catalogue[out.second['effect']].title)}</b>, "
                  f"{p['estimate']:.3g} {escape(_unit(p['unit']))}, probability {out.second['probability']:.2f}.</p>")
    elif out.second:
        second = "<p>Something else is left that has no name yet.</p>"
    g, held = a["gap"], out.confirmed.get("holdout")
    passes = len(out.training.passes + out.holdout.passes)
    facts = [("passes of each truck, trucks", f"{passes}, {out.trucks}"), ("omnibus p", f"{a['omnibus_p']:.2g}"),
             ("probability", f"{100 * v.probability:.1f} %")]
    if v.verdict == "named":
        facts += [("leads again in resampled data", f"{100 * out.stability:.0f} %"),
                  ("gap closed, training", _share(g["closure"], g["closure_interval90"])),
                  ("gap closed, hold-out", _share(g["holdout_closure"], g["holdout_interval90"])),
                  ("by chance, hold-out", f"p {held.p:.2g}" if held else "-")]
    return (f'<h1>What does the model miss?</h1><div class="verdict {v.verdict}"><strong>{escape(head)}</strong>'
            f"{words[v.verdict]}{'<ul>' + reasons + '</ul>' if reasons else ''}{second}</div><div class='facts'>"
            + "".join(f"<div><b>{escape(x)}</b><span>{escape(k)}</span></div>" for k, x in facts) + "</div>")


def _clearest(out, count=3):
    """The cells that disagree most, one a phase and channel."""
    d, cells = out.disagreement, out.training.baseline.cells
    seen = dict.fromkeys(f"{cells[i].channel.rsplit('_', 1)[0].replace('_', ' ')} in {cells[i].phase}"
                         for i in np.argsort(-np.abs(d.z)))
    return ", ".join(list(seen)[:count])


def _unit(unit):
    return "" if unit in ("-", "1") else unit


def _strength(a):
    p = a["parameter"]
    low, high = p["interval90"]
    return f"{p['name']} {p['estimate']:.3g} {_unit(p['unit'])} ({svg.number(low)} to {svg.number(high)}, 90 %)"


def _share(value, interval):
    if value is None:
        return "no gap there"
    return f"{100 * value:.0f} % ({100 * interval[0]:.0f} to {100 * interval[1]:.0f})"


def _warnings(out):
    return "".join(f"<p><b>Mind:</b> {escape(w)}</p>" for w in dict.fromkeys(out.warnings))


def _heat_maps(out):
    base, d = out.training.baseline, out.disagreement
    place = {(c.pass_number, *c.key): i for i, c in enumerate(base.cells)}
    rows = sorted({(c.channel, c.feature) for c in base.cells},
                  key=lambda r: (list(KNOWN).index(r[0]) if r[0] in KNOWN else 99, FEATURES.index(r[1])))
    names = {f"{c.removesuffix('_kN').removesuffix('_t').replace('_', ' ')}{'' if f == 'mass' else ' ' + f}": (c, f)
             for c, f in rows}
    cards = []
    for number in out.training.passes:
        def at(row, phase, number=number):
            return place.get((number, phase, *names[row]))

        def value(row, phase):
            i = at(row, phase)
            return None if i is None else float(d.z[i])

        def tip(row, phase):
            i = at(row, phase)
            return f"{row} in {phase}: z {d.z[i]:.2f}, adjusted p {d.p_adjusted[i]:.2g}"

        cards.append('<div class="card wide">' + svg.heat_map(
            f"Pass {number}", list(names), PHASES, value, lambda r, c: d.p_adjusted[at(r, c)] <= CELL_P, tip)
            + "</div>")
    held = ", ".join(map(str, out.holdout.passes))
    return ("<h2>Where and when they disagree</h2><p class='note'>z: measured less simulated, in standard "
            "deviations of instruments and seeds together. Framed: adjusted p of the cell at most "
            f"{CELL_P:g}, over all cells. Pass {held} is held out and not looked at here. Grey: no value, or one "
            "that says nothing beyond its neighbours.</p>" + "<div class='grid'>" + "".join(cards) + "</div>")


def _ranking(out, catalogue):
    m = out.matched
    names = sorted((s.name for s in out.training.signatures), key=m.presence, reverse=True)[:SHOWN]
    rows = []
    for n in names:
        low, middle, high = strength(m, n, out.training.signatures)
        low, high = out.intervals.get(n, (low, high))
        e = catalogue[n]
        estimate = out.effects.get(n, middle)
        rows.append((n, m.presence(n), estimate, low, high, _unit(e.unit), (e.low, e.high)))
    return ("<h2>Ranked effects</h2><p class='note'>Probability that the effect is there, alone or with others; "
            f"nothing at all {100 * m.probability['none']:.1f} %, something unknown "
            f"{100 * m.probability['unknown']:.1f} %. Strengths: if it is there.</p><div class='card wide'>"
            + svg.ranking(rows) + "</div>")


def _alike(out):
    t = out.table
    head = "".join(f"<th>{escape(h)}</th>" for h in
                   ("effect", "at strength", "d", "found from", "taken for (distinguishability)"))
    rows = []
    for i, n in enumerate(t.names):
        near = sorted((t.d_prime[i, j], o) for j, o in enumerate(t.names) if j != i)[:3]
        said = ", ".join(f"<b>{escape(o)} {x:.1f}</b>" if x < CONFUSABLE else f"{escape(o)} {x:.1f}" for x, o in near)
        limit = svg.number(t.limits[i]) if np.isfinite(t.limits[i]) else "not within its bounds"
        rows.append(f"<tr><td>{escape(n)}</td><td class=n>{svg.number(t.strengths[i])}</td><td class=n>{t.d[i]:.1f}</td>"
                    f"<td class=n>{limit}</td><td>{said}</td></tr>")
    return ("<h2>What these data can tell apart</h2><p class='note'>Known before the measured numbers are looked "
            "at. d: how far the effect stands out from instruments, seeds and nuisances. Found from: the strength "
            f"from which it is found, about. Bold: below {CONFUSABLE}, the two form one class.</p>"
            f"<div class='scroll'><table><tr>{head}</tr>{''.join(rows)}</table></div>")


def _before_after(out):
    key = ("<p class='key note'>" + "".join(f"<span style='background:{c}'></span>{n}" for c, n in (
        (svg.MEASURED, "measured"), (svg.BEFORE, "model, ± 2 sd by its seeds"), (svg.AFTER, "with the effect")))
        + "</p>")
    bars = []
    for name, c in out.confirmed.items():
        bars.append("<div class='card'>" + svg.bars(
            f"Gap G on {'hold-out' if name == 'holdout' else name} passes",
            [("before", c.before, svg.BEFORE), ("after", c.after, svg.AFTER), ("floor", c.floor, svg.GREY)],
            max(c.before, c.after)) + "</div>")
    cards = []
    for c in sorted(out.curves, key=lambda c: (c.held_out, c.pass_number)):
        title = f"{c.channel.removesuffix('_kN').replace('_', ' ')}, pass {c.pass_number}"
        cards.append("<div class='card'>" + svg.curves(title + (" (held out)" if c.held_out else ""), c, "kN")
                     + "</div>")
    rows = "".join(
        f"<tr><td>{m.pass_number}{' (held out)' if m.held_out else ''}</td><td class=n>{m.measured:.1f}</td>"
        f"<td class=n>{m.before:.1f} ± {m.spread:.1f}</td><td class=n>{'-' if m.after is None else f'{m.after:.1f}'}"
        "</td></tr>" for m in out.masses)
    table = ("<div class='scroll'><table><tr><th>pass</th><th>truck mass, t: measured</th><th>model</th>"
             f"<th>with the effect</th></tr>{rows}</table></div>" if rows else "")
    return ("<h2>Before and after</h2>" + key + f"<div class='grid'>{''.join(bars + cards)}</div>"
            + ("<p></p>" + table if table else ""))


def _experiments(out):
    if not out.proposals:
        return ""
    items = []
    for p in out.proposals[:3]:
        said = "".join(f"<li>{escape(seen)}: {escape(', '.join(names))}</li>" for seen, names in p.answers)
        items.append(f"<li><b>{escape(p.title)}</b> ({p.minutes:g} min, {p.bits:.1f} bits)<ul>{said}</ul></li>")
    return "<h2>Next experiment</h2><ol>" + "".join(items) + "</ol>"


def _rejected(out):
    rows = "".join(f"<tr><td>{escape(n)}</td><td class=n>{100 * p:.2f} %</td><td>{escape(r)}</td></tr>"
                   for n, p, r in out.verdict.rejected)
    rivals = ""
    held = out.confirmed.get("holdout")
    if held:
        lines = "".join(f"<tr><td>{escape(k)}</td><td class=n>{t:.0f}</td></tr>" for k, t in held.rivals.items())
        rivals = ("<p class='note'>On the hold-out, T<sup>2</sup> (small is good); a rival that makes the data ten times likelier would object."
                  f"</p><table><tr><td><b>the effect, fresh runs</b></td><td class=n>{held.t2:.0f}</td></tr>{lines}"
                  "</table>")
    if not rows and not rivals:
        return ""
    return f"<h2>Rejected</h2>{rivals}<p></p><div class='scroll'><table>{rows}</table></div>"


def _reproduce(out, a):
    patch = "\n".join(f"--set {k}={v:g}" for k, v in a["patch"].items()) or "nothing is added"
    seeds = "; ".join(f"{k} {v[0]} to {v[-1]}" for k, v in a["seeds"].items() if v)
    hashes = "".join(f"<tr><td>{escape(k)}</td><td><code>{escape(v[:16])}</code></td></tr>"
                     for k, v in a["hashes"].items())
    return (f"<h2>The case's difference</h2><pre>{escape(patch)}</pre><h2>To do it again</h2>"
            f"<p>{a['runs']} runs; seeds: {escape(seeds)}. Seeds' covariance times {out.inflation:.2f} "
            f"(leaving seeds out).</p><table>{hashes}</table>")
