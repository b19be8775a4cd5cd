"""What is known of every case: out of the reports of its stages, and of how they ended."""

import json
import os
import re

# What the exit codes of `pneuma` mean (README of Pneuma).
EXITS = {
    1: "internal error",
    2: "wrong option",
    3: "input missing",
    4: "input damaged or invalid",
    5: "input of an unsupported kind",
    6: "output cannot be written",
    7: "a check does not hold",
    9: "out of memory",
    10: "no picture can be made",
    11: "out of time",
}

CHECK_FAILED = 7
STOPPED = (130, 143)  # by a person, or by the engine


def meaning(code):
    if code in EXITS:
        return EXITS[code]
    return "killed" if code > 128 else "the program could not be run"


LOBES = ["RUL", "RML", "RLL", "LUL", "LLL"]

# Columns of every tree, and where they stand in the report of `pneuma measure`.
TREE = {
    "terminals": "terminals",
    "branches": "branches",
    "terminal_generation": "morphometry/terminal_generation/mean",
    "path_length_mm": "morphometry/path_length_mm/mean",
    "branching_angle_deg": "morphometry/branching_angle_deg/mean",
    "length_to_diameter": "morphometry/length_to_diameter/mean",
    "strahler_Rb": "morphometry/strahler/Rb",
    "strahler_Rl": "morphometry/strahler/Rl",
    "strahler_Rd": "morphometry/strahler/Rd",
    "horsfield_Rb": "morphometry/horsfield/Rb",
    "dead_space_ml": "morphometry/dead_space_ml",
    "gap_mean": "morphometry/gap_mean",
    "gap_p95": "morphometry/gap_p95",
    "ends_outside": "outside/ends",
}


def stages(methods, breathing):
    """Names of the logs, in the order in which the stages depend on each other."""
    names = ["info", "import", "segment", "lobes"]
    names += [f"grow-{method}" for method in methods] + [f"measure-{method}" for method in methods]
    names += ["breathe"] if breathing else []
    return names + [f"render-{method}" for method in methods] + ["slices", "report"]


def results(name, methods, breathing):
    """The file by which each stage shows that it is done."""
    folder = os.path.join("cases", name)
    files = {
        "info": "info.json",
        "import": "import.json",
        "segment": "lungs.json",
        "lobes": "lobes/lobes.json",
        "breathe": "breath/breath.pvd",
        "slices": "slices.png",
        "report": "report.html",
    }
    for method in methods:
        files[f"grow-{method}"] = f"trees/{method}.vtp"
        files[f"measure-{method}"] = f"measures/{method}.json"
        files[f"render-{method}"] = f"pictures/{method}.png"
    return {stage: os.path.join(folder, files[stage]) for stage in stages(methods, breathing)}


def before(stage, methods):
    """The stages that a stage needs, the farthest first."""
    trunk = ["info", "import", "segment", "lobes"]
    if stage in trunk:
        return trunk[: trunk.index(stage)]
    kind, _, method = stage.partition("-")
    if kind in ("measure", "render"):
        return [*trunk, f"grow-{method}"]
    return [*trunk, f"grow-{methods[0]}"] if kind in ("breathe", "report") else trunk


def read_json(*path):
    """A report; an empty one if it is not there."""
    try:
        with open(os.path.join(*path), encoding="utf-8") as file:
            return json.load(file)
    except (OSError, ValueError):
        return {}


def at(report, path):
    """What stands at "a/b/c"; None if nothing does."""
    for key in path.split("/"):
        if not isinstance(report, dict) or key not in report:
            return None
        report = report[key]
    return report


def ending(name, stage):
    """How a stage ended: {"exit": 4, "seconds": 1.2, "peak_mb": 93.0, "started": "2026-11-02T09:30:00+0100", "node":
    "n1"}; only the last two if it still runs, or was killed with its job; empty if it did not run."""
    return read_json("logs", name, f"{stage}.exit")


def reason(name, stage):
    """What `pneuma` said as it ended: the last line of its log that is its own."""
    try:
        with open(os.path.join("logs", name, f"{stage}.log"), encoding="utf-8", errors="replace") as file:
            lines = [line.strip() for line in file if line.strip()]
    except OSError:
        return ""
    own = [line[len("pneuma: "):] for line in lines if line.startswith("pneuma: ") and not line.startswith("pneuma: warning")]
    return (own or lines or [""])[-1]


def anonymous(sentence, ct):
    """Without names of files and what else is quoted, which may tell who somebody is; the log has them."""
    harmless = re.sub(r"""(['"])(the CT|--[a-z-]+)\1""", "\0\\2\0", sentence.replace(ct, "the CT"))
    # From the first mark to the last: names may hold marks themselves.
    return re.sub(r"""(?<!\w)['"].*['"](?!\w)""", "'...'", harmless).replace("\0", "'")


def finished(name, ct, methods, breathing):
    """The stages whose results are there and belong to this CT, and to results of before that do."""
    done = set()
    read = read_json("cases", name, "info.json").get("inputs", [])
    if read and read[0].get("path") != ct:
        return done  # the list gives this name to another CT now
    for stage, file in results(name, methods, breathing).items():
        needed = all(one in done for one in before(stage, methods))
        if needed and os.path.exists(file) and ending(name, stage).get("exit") in (0, CHECK_FAILED):
            done.add(stage)
    return done


def outcome(name, ct, done, methods, breathing):
    """("done" | "failed" | "not finished", the stage, its exit code, the reason)."""
    left = [stage for stage in stages(methods, breathing) if stage not in done]
    unfinished = None
    for stage in left:
        end = ending(name, stage)
        if not end or not all(one in done for one in before(stage, methods)):
            continue
        code = end.get("exit")
        if code is None:
            why = f"no end was told of what started at {end.get('started')} on {end.get('node')}"
            why += ": it still runs, or was killed with its job"
            unfinished = unfinished or ("not finished", stage, None, why)
        elif code in STOPPED:
            unfinished = unfinished or ("not finished", stage, code, "it was stopped, by a person or for taking too long")
        elif code not in (0, CHECK_FAILED):
            return "failed", stage, code, anonymous(reason(name, stage), ct) or meaning(code)
    if not left:
        return "done", "", None, ""
    return unfinished or ("not finished", left[0], None, "")


def to_check(reports):
    """What a person should look at: warnings, and checks that do not hold and are in none of them, as sentences."""
    found = []
    for stage, report in reports.items():
        warnings = report.get("warnings", [])
        found += [f"{stage}: {warning}" for warning in warnings]
        for check in report.get("checks", []):
            if check.get("ok", True) or any(warning.startswith(f"{check.get('what')}:") for warning in warnings):
                continue
            limits = [f"{key} {check[key]:g}" for key in ("low", "high", "limit") if isinstance(check.get(key), (int, float))]
            value = check.get("value")
            found.append(
                f"{stage}: {check.get('what', check.get('id'))}"
                + (f" is {value:g} {check.get('unit', '')}".rstrip() if isinstance(value, (int, float)) else "")
                + (f" ({', '.join(limits)})" if limits else "")
            )
    return list(dict.fromkeys(found))


def volumes(lungs, lobes):
    row = {f"{side}_lung_ml": at(lungs, f"lungs/{side}/volume_ml") for side in ("right", "left")}
    row |= {f"{side}_mean_hu": at(lungs, f"lungs/{side}/mean_hu") for side in ("right", "left")}
    row["airways_ml"] = at(lungs, "airways/volume_ml")
    by_lobe = {lobe["lobe"]: lobe["volume_ml"] for lobe in lobes.get("lobes", [])}
    return row | {f"{lobe}_ml": by_lobe.get(lobe) for lobe in LOBES}


def breath(report):
    return {"tidal_ml": at(report, "breath/tidal_ml"), "drive_cmH2O": at(report, "breath/drive_cmH2O")}


def scan(info):
    files = info.get("files", [{}])
    size = at(files[0], "geometry/size") or [None] * 3
    spacing = at(files[0], "geometry/spacing_mm") or [None] * 3
    row = {f"voxels_{axis}": size[i] for i, axis in enumerate("xyz")}
    return row | {f"spacing_{axis}_mm": spacing[i] for i, axis in enumerate("xyz")}


def reports_of(folder, done, methods):
    """The reports of the stages that are done, by what they tell of."""
    reports = {}
    if "import" in done:
        reports["CT"] = read_json(folder, "import.json")
    if "segment" in done:
        reports["lungs"] = read_json(folder, "lungs.json")
    if "lobes" in done:
        reports["lobes"] = read_json(folder, "lobes", "lobes.json")
    for method in methods:
        if f"grow-{method}" in done:
            reports[f"tree ({method})"] = read_json(folder, "trees", f"{method}.json")
        if f"measure-{method}" in done:
            reports[f"measures ({method})"] = read_json(folder, "measures", f"{method}.json")
    if "breathe" in done:
        reports["breath"] = read_json(folder, "breath", "breath.json")
    return reports


def figures_of(folder, done, reports, measures, breathing):
    figures = scan(read_json(folder, "info.json") if "info" in done else {})
    figures |= volumes(reports.get("lungs", {}), reports.get("lobes", {}))
    for method, report in measures.items():
        figures |= {f"{method}_{column}": at(report, path) for column, path in TREE.items()}
    if breathing:
        figures |= breath(reports.get("breath", {}))
    return figures


def case_of(case, methods, breathing):
    """What the table, the plots and the page tell of a case: {"row": {...}, "figures": {...}, "done": {...}, "check":
    [...], "measures": {...}}. Figures are those of stages that are done; the row has columns of the list, too."""
    name, ct = case["case"], case["ct"]
    folder = os.path.join("cases", name)
    done = finished(name, ct, methods, breathing)
    status, stage, code, why = outcome(name, ct, done, methods, breathing)
    reports = reports_of(folder, done, methods)
    check = [anonymous(sentence, ct) for sentence in to_check(reports)]
    measures = {
        method: read_json(folder, "measures", f"{method}.json") if f"measure-{method}" in done else {} for method in methods
    }
    figures = figures_of(folder, done, reports, measures, breathing)

    ours = {"status": status, "stage": stage, "exit_code": code, "reason": why, "to_check": len(check)} | figures
    for one in stages(methods, breathing):
        end = ending(name, one)
        ours |= {f"{one}_exit": end.get("exit"), f"{one}_s": end.get("seconds"), f"{one}_peak_mb": end.get("peak_mb")}
    # Columns of the list of cases come first, and give way where they have a name of ours.
    row = {"case": name}
    for column, text in case.get("columns", {}).items():
        while column in ours or column in row:
            column = f"given_{column}"
        row[column] = text
    return {"row": row | ours, "figures": figures, "done": done, "check": check, "measures": measures}


def gather(cases, methods, breathing):
    return [case_of(case, methods, breathing) for case in cases.values()]
