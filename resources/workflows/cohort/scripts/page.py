"""The page of a cohort, and everything else that is made of all cases at once."""

import html
import os
import urllib.parse

import gather
import plots
import table

STYLE = """
body { font: 15px/1.45 system-ui, sans-serif; margin: 24px auto; max-width: 1180px; padding: 0 16px; color: #1c2530; }
h1 { font-size: 26px; } h2 { font-size: 20px; margin-top: 36px; }
table { border-collapse: collapse; width: 100%; } th { text-align: left; font-weight: 600; }
th, td { padding: 6px 10px; border-bottom: 1px solid #dde3ea; vertical-align: top; }
td.case { width: 230px; overflow-wrap: anywhere; } td.check { min-width: 260px; } td.n { text-align: right; font-variant-numeric: tabular-nums; } .muted { color: #66717e; }
img.small { width: 200px; display: block; border-radius: 4px; background: #14181d; }
.failed { color: #a4241c; font-weight: 600; } .open { color: #8a5a00; font-weight: 600; } .done { color: #1b7a43; }
ul { margin: 0; padding-left: 18px; } figure { display: inline-block; margin: 0 12px 18px 0; width: 360px; vertical-align: top; }
figure img { width: 100%; } figcaption { font-size: 12px; color: #66717e; }
@media (prefers-color-scheme: dark) { body { background: #14181d; color: #dfe5ec; } th, td { border-color: #2b333c; }
  figure img { background: #fff; } .muted, figcaption { color: #94a0ad; } .failed { color: #ff8a80; }
  .open { color: #ffcc66; } .done { color: #6fd39a; } a { color: #7fb6f2; } }
"""


def link(path, text):
    return f'<a href="{html.escape(urllib.parse.quote(path))}">{text}</a>'


def picture(path, words, there):
    if not there:
        return ""
    return link(path, f'<img class="small" loading="lazy" src="{html.escape(urllib.parse.quote(path))}" alt="{html.escape(words)}">')


def number(value, digits=0):
    return "" if value is None else f"{value:,.{digits}f}"


def status_cell(row):
    if row["status"] == "failed":
        log = link(f"logs/{row['case']}/{row['stage']}.log", html.escape(row["stage"]))
        return (
            f'<span class="failed">failed</span> at {log}, exit code {row["exit_code"]} ({gather.meaning(row["exit_code"])})'
        )
    if row["status"] == "not finished":
        return f'<span class="open">not finished</span>, next: {html.escape(row["stage"])}'
    return '<span class="done">done</span>'


def check_cell(one):
    check = one["check"]
    if one["row"]["reason"]:
        check = [one["row"]["reason"], *check]
    if not check:
        return '<span class="muted">nothing</span>'
    return "<ul>" + "".join(f"<li>{html.escape(text)}</li>" for text in check) + "</ul>"


def case_row(one, methods):
    name, figures, done = one["row"]["case"], one["figures"], one["done"]
    folder = f"cases/{name}"
    title = html.escape(name)
    if "report" in done:
        title = link(f"{folder}/report.html", title)
    airways = picture(f"{folder}/pictures/{methods[0]}.png", f"lobes and airway tree of {name}", f"render-{methods[0]}" in done)
    slices = picture(f"{folder}/slices.png", f"coronal slice of {name} with its lobes", "slices" in done)
    numbers = [figures["right_lung_ml"], figures["left_lung_ml"], figures[f"{methods[0]}_terminals"]]
    return (
        f'<tr><td>{airways}</td><td>{slices}</td><td class="case"><b>{title}</b><br>{status_cell(one["row"])}</td>'
        + "".join(f'<td class="n">{number(value)}</td>' for value in numbers)
        + f'<td class="check">{check_cell(one)}</td></tr>\n'
    )


def order_of(one):
    """What needs a person first: failed, unfinished, with something to check, the others."""
    rank = {"failed": 0, "not finished": 1}.get(one["row"]["status"], 2 if one["check"] else 3)
    return rank, one["row"]["case"]


def page_text(found, methods, drawn):
    count = {status: sum(one["row"]["status"] == status for one in found) for status in ("done", "failed", "not finished")}
    checks = sum(bool(one["check"]) for one in found)
    rows = "".join(case_row(one, methods) for one in sorted(found, key=order_of))
    figures = "".join(
        f'<figure><img src="{html.escape(urllib.parse.quote(plot["file"]))}" alt="{html.escape(plot["title"])}">'
        f"<figcaption>{html.escape('; '.join(plot['sources']))}</figcaption></figure>\n"
        for plot in drawn
    )
    return (
        '<!DOCTYPE html>\n<html lang="en"><head><meta charset="utf-8"><title>Cohort</title>'
        '<meta name="viewport" content="width=device-width, initial-scale=1">'
        f"<style>{STYLE}</style></head><body>\n<h1>Cohort of {len(found):,} case{'' if len(found) == 1 else 's'}</h1>\n"
        f'<p><span class="done">{count["done"]:,} done</span>, <span class="failed">{count["failed"]:,} failed</span>, '
        f'<span class="open">{count["not finished"]:,} not finished</span>; in {checks:,} there is something to check. '
        f"All figures: {link('table.csv', 'table.csv')}, {link('table.h5', 'table.h5')}.</p>\n"
        "<table><thead><tr><th>Airways</th><th>Slice</th><th>Case</th><th>Right lung, ml</th><th>Left lung, ml</th>"
        f"<th>Terminals ({html.escape(methods[0])})</th><th>To check</th></tr></thead>\n<tbody>\n{rows}</tbody></table>\n"
        + (f"<h2>How figures are spread</h2>\n{figures}" if drawn else "")
        + '<p class="muted">Bands and dashed lines: what the papers below each plot say of adults. '
        "Research use only, not a medical device.</p>\n</body></html>\n"
    )


def write(cases, methods, breathing):
    """Writes table.csv, table.h5, plots/ and index.html of what is there by now; says what was written."""
    found = gather.gather(cases, methods, breathing)
    table.write_csv(found, "table.csv")
    table.write_hdf5(found, "table.h5")
    drawn = plots.draw(found, methods, "plots")
    part = f"index.html.{os.getpid()}.part"
    with open(part, "w", encoding="utf-8") as file:
        file.write(page_text(found, methods, drawn))
    os.replace(part, "index.html")
    count = {}
    for one in found:
        count[one["row"]["status"]] = count.get(one["row"]["status"], 0) + 1
    return "table.csv, table.h5, index.html: " + ", ".join(f"{n} {status}" for status, n in sorted(count.items()))
