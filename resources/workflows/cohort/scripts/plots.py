"""How figures are spread over the cohort, with what the literature says of them."""

import os

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot
import matplotlib.ticker

# Column, title, and the name of the figure among the published ones of `pneuma measure`.
LUNGS = [
    ("right_lung_ml", "Right lung, ml", None),
    ("left_lung_ml", "Left lung, ml", None),
    ("RUL_ml", "Right upper lobe, ml", None),
    ("RML_ml", "Right middle lobe, ml", None),
    ("RLL_ml", "Right lower lobe, ml", None),
    ("LUL_ml", "Left upper lobe, ml", None),
    ("LLL_ml", "Left lower lobe, ml", None),
]
TREE = [
    ("terminals", "terminals", "terminals"),
    ("terminal_generation", "generation of terminals", "terminal_generation.mean"),
    ("path_length_mm", "path to terminals, mm", "path_length_mm.mean"),
    ("branching_angle_deg", "branching angle, degrees", "branching_angle_deg.mean"),
    ("length_to_diameter", "length to diameter", "length_to_diameter.mean"),
    ("strahler_Rb", "Strahler branching ratio", "strahler.Rb"),
    ("strahler_Rl", "Strahler length ratio", "strahler.Rl"),
    ("strahler_Rd", "Strahler diameter ratio", "strahler.Rd"),
    ("gap_mean", "mean gap", "gap_mean"),
    ("dead_space_ml", "dead space, ml", "dead_space_ml"),
]


def bands_of(found, method, quantity):
    """[(low, high, source)] of one figure, as the first case's report of measures has them."""
    for one in found:
        published = one["measures"].get(method, {}).get("published", [])
        if published:
            return [(p["low"], p["high"], p["source"]) for p in published if quantity and p["quantity"] == quantity]
    return []


def bins_of(values, bands):
    """Twenty of them, over all that is shown, so that a bar beside a far-off band can still be seen."""
    shown = values + [end for low, high, _ in bands for end in (low, high)]
    low, high = min(shown), max(shown)
    margin = 0.05 * (high - low) or 0.05 * abs(low) or 1.0
    return [low - margin + (high - low + 2 * margin) * i / 20 for i in range(21)]


def one_plot(values, title, bands, path):
    figure, axes = matplotlib.pyplot.subplots(figsize=(4.2, 2.8), dpi=110)
    axes.hist(values, bins=bins_of(values, bands), color="#3f7fbf", edgecolor="white")
    axes.xaxis.set_major_locator(matplotlib.ticker.MaxNLocator(5))
    axes.xaxis.get_major_formatter().set_useOffset(False)
    for number, (low, high, _) in enumerate(bands):
        label = "published" if number == 0 else None
        if high > low:
            axes.axvspan(low, high, color="#f7e0bb", zorder=0, label=label)
        else:
            axes.axvline(low, color="#c9821a", linestyle="--", label=label)
    axes.set_xlabel(title)
    axes.set_ylabel("cases")
    axes.yaxis.get_major_locator().set_params(integer=True)
    axes.spines[["top", "right"]].set_visible(False)
    if bands:
        axes.legend(frameon=False, fontsize=8, loc="lower right", bbox_to_anchor=(1.0, 1.0), borderaxespad=0.0)
    figure.tight_layout()
    part = f"{path}.{os.getpid()}.part"
    figure.savefig(part, format="svg", metadata={"Date": None})
    matplotlib.pyplot.close(figure)
    os.replace(part, path)


def draw(found, methods, folder):
    """[{"file", "title", "sources"}] of what was drawn; a figure that fewer than two cases have is left out."""
    matplotlib.rcParams["svg.hashsalt"] = "pneuma"  # the same figures give the same bytes
    os.makedirs(folder, exist_ok=True)
    wanted = [(column, title, None, "") for column, title, _ in LUNGS]
    for method in methods:
        wanted += [(f"{method}_{column}", f"{title} ({method})", method, name) for column, title, name in TREE]
    drawn = []
    for column, title, method, quantity in wanted:
        values = [one["figures"].get(column) for one in found]
        values = [value for value in values if isinstance(value, (int, float))]
        if len(values) < 2:
            continue
        bands = bands_of(found, method, quantity)
        path = os.path.join(folder, f"{column}.svg")
        one_plot(values, title, bands, path)
        sources = [f"{low:g}" + (f" to {high:g}" if high > low else "") + f": {source}" for low, high, source in bands]
        drawn.append({"file": path, "title": title, "sources": sources})
    return drawn
