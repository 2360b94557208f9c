#!/usr/bin/env python3
"""What the text of the publication says of the launch, line by line, against the main job.

    python3 tests/publication/statements.py LAUNCHSAFE [-o DIR]

runs the main job, and its scene for the temperatures over time; judges every row of statements.csv beside this file; and
writes statements.md to DIR. Exit code 1 where an outcome is not the one that the row expects.

A tolerance is half the last printed digit; of the instants between slow and fast rise, which the text gives in steps of
half a millisecond, half such a step. Used for "calibration": the load or a constant was fitted to the number; "selection":
it chose among models; "held out": neither; "input": it follows from what the scene states. Table 8 itself is
studies/table8.toml.
"""
import argparse
import collections
import csv
import json
import pathlib
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
STUDIES = HERE.parents[1] / "studies"
RINGS = [f"S{k}" for k in range(1, 14)]  # stations of 5 mm from the wall to the axis; Gk lies in Sk
PARTS = {"outer": RINGS[:4], "between": RINGS[4:9], "centre": RINGS[9:]}  # thirds of the radius, by middles of rings

# Unit, decimals and definition of what is said.
QUANTITIES = {
    "hottest region": ("K", 1, "lowest and highest temperature over the stations of the charge's bottom; it agrees where "
                       "both lie within the published range, whose ends are limits of colours"),
    "temperature": ("K", 1, "that of the station in which the point lies, or of the hottest; without a time the highest "
                    "of the launch"),
    "hottest point": ("", 0, "the station that is hottest at the time"),
    "hottest part": ("", 0, "the third of the bottom's radius in which that station lies: centre, between or outer"),
    "spread": ("K", 1, "highest less lowest temperature of the stations"),
    "fast rise begins": ("ms", 2, "when the rate of the highest temperature, over 0.5 ms, first rises "
                         "above 15 % of its largest before an ignition"),
    "fast rise ends": ("ms", 2, "when that rate last falls below that"),
    "reaches": ("ms", 2, "when the station, or the first one, comes to the level"),
    "ignition": ("ms", 2, "of the first station"),
    "ignition point": ("", 0, "that station"),
    "peak pressure": ("MPa", 1, "the highest on the shell's base"),
    "air temperature": ("K", 1, "on the adiabat of the scene's air"),
    "critical gap": ("cm", 4, "by bisection"),
    "slope": ("K/cm", 1, "of the least-squares line through the gaps that do not ignite"),
    "intercept": ("K", 1, "of that line at no gap"),
    "not computed": ("", 0, "listed for completeness"),
}


def columns_of(path):
    """A CSV file of numbers as its columns."""
    with open(path, newline="") as file:
        header, *rows = csv.reader(file)
    return dict(zip(header, zip(*(map(float, row) for row in rows))))


def interpolate(x, y, at):
    k = next((k for k in range(1, len(x)) if x[k] >= at), len(x) - 1)
    return y[k - 1] + (y[k] - y[k - 1]) * (at - x[k - 1]) / (x[k] - x[k - 1])


def crossings(x, y, level):
    """Where y passes a level: (x, whether it rises)."""
    for k in range(1, len(x)):
        if (y[k - 1] < level) != (y[k] < level):
            yield x[k - 1] + (x[k] - x[k - 1]) * (level - y[k - 1]) / (y[k] - y[k - 1]), y[k] >= level


class Launch:
    """The skin of one gap: ms and K."""

    def __init__(self, columns, verdict):
        self.time = columns["time_ms"]
        self.rings = {ring: columns[ring + "_K"] for ring in RINGS}
        self.highest = [max(values) for values in zip(*self.rings.values())]
        self.ignition, self.ignition_ring = verdict["ignition_time_ms"], verdict["ignition_place"]
        if abs(max(self.highest) - verdict["temperature_max_K"]) > 1e-3:
            sys.exit(f"T max of the run is not that of the main job: {max(self.highest)} K, {verdict}")

    def at(self, time):
        return {ring: interpolate(self.time, values, time) for ring, values in self.rings.items()}

    def fast_rise(self):
        """Begin and end of the fast rise: a rate of the highest temperature, in windows of 0.5 ms before an ignition, above
        15 % of its largest."""
        half, end = 0.25, self.ignition or float("inf")
        time = [t for t in self.time if t < end]
        highest = self.highest[:len(time)]
        middle = [t for t in time if time[0] + half <= t <= time[-1] - half]
        rate = [interpolate(time, highest, t + half) - interpolate(time, highest, t - half) for t in middle]
        passed = list(crossings(middle, rate, 0.15 * max(rate)))
        begin = next((t for t, rises in passed if rises), None)
        return begin, passed[-1][0] if passed and not passed[-1][1] else None


def judge_launch(said, launch):
    """(computed low, high) or a text, of a statement on the history of a gap."""
    quantity, time = said["quantity"], said["time_ms"]
    ring = said["point"].replace("G", "S")
    now = launch.at(float(time)) if time else {}
    hottest = max(now, key=now.get, default=None)
    if quantity == "hottest region":
        return min(now.values()), now[hottest]
    if quantity == "temperature":
        value = now.get(ring, now[hottest]) if time else max(launch.highest)
        return value, value
    if quantity == "spread":
        return (now[hottest] - min(now.values()),) * 2
    if quantity == "hottest part":
        return next(part for part, rings in PARTS.items() if hottest in rings)
    if quantity in ("hottest point", "ignition point"):
        return hottest if quantity == "hottest point" else launch.ignition_ring or "no ignition"
    if quantity == "reaches":
        values = launch.rings.get(ring, launch.highest)
        found, otherwise = next((t for t, rises in crossings(launch.time, values, float(said["level"])) if rises), None), \
            f"not reached: {max(values):.1f} K at most"
    elif quantity == "ignition":
        found, otherwise = launch.ignition, "no ignition"
    else:
        begin, end = launch.fast_rise()
        found, otherwise = (begin, "it does not rise fast") if quantity == "fast rise begins" else \
            (end, "it still rises fast at the end")
    return otherwise if found is None else (found, found)


def judge_case(said, main, pressure):
    """The same of what belongs to no gap."""
    return ({"peak pressure": lambda: max(pressure["chamber_MPa"]),
             "air temperature": lambda: 300 * float(said["level"])**(0.4 / 1.4),  # gap.air_heat_ratio is 1.4
             "critical gap": lambda: main["critical_gap"]["critical_gap_cm"],
             "slope": lambda: main["fit"][0]["slope_K_per_cm"],
             "intercept": lambda: main["fit"][0]["intercept_K"]}[said["quantity"]](),) * 2


def outcome_of(said, computed):
    """How a statement and what was computed compare: computed text, difference (None for a text), outcome."""
    unit, decimals, _ = QUANTITIES[said["quantity"]]
    if isinstance(computed, str):
        same = said["published"].replace("G", "S") == computed
        point = f"{computed} ({computed.replace('S', 'G')})" if computed in RINGS else computed
        return point, None, "agrees" if same else "differs"
    text = " to ".join(f"{value:.{decimals}f}" for value in dict.fromkeys(computed)) + " " + unit
    ends = [float(word) for word in said["published"].split() if word[0].isdigit()]
    difference = max(min(0.0, computed[0] - ends[0]), max(0.0, computed[1] - ends[-1]), key=abs)
    if abs(difference) <= float(said["tolerance"]) + 1e-9 * ends[-1]:
        return text, difference, "agrees"
    return text, difference, f"differs by {difference:+.{decimals}f} {unit}"


def circumstances(said):
    level = {"reaches": "{} K", "air temperature": "pressure ratio {}"}.get(said["quantity"], "").format(said["level"])
    return ", ".join(filter(None, [said["point"], said["time_ms"] and said["time_ms"] + " ms", level]))


def markdown(header, rows):
    lines = [header, ["---"] * len(header), *rows]
    return "".join("| " + " | ".join(str(cell).replace("|", "\\|") for cell in line) + " |\n" for line in lines)


def summary_of(judged):
    for quantity in QUANTITIES:
        rows = [row for row in judged if row["quantity"] == quantity != "not computed"]
        if not rows:
            continue
        agree = [row["outcome"] == "agrees" for row in rows]
        held_out = [row["used_for"] == "held out" for row in rows]
        others = [row for row, agrees in zip(rows, agree) if not agrees]
        worst = max(others, key=lambda row: abs(float("inf") if row["difference"] is None else row["difference"]),
                    default=None)
        text = ""
        if worst:
            text = f"{worst['computed']} instead of {worst['published']}" if worst["difference"] is None else \
                worst["outcome"].removeprefix("differs by ")
            where = [worst["gap_cm"] and f"at {worst['gap_cm']} cm", worst["at"]]
            text = ", ".join(filter(None, [" ".join(filter(None, [text, where[0]])), where[1]]))
        yield quantity, len(rows), sum(agree), sum(held_out), sum(map(bool.__and__, agree, held_out)), text


def page_of(judged, version):
    columns = ["source", "gap_cm", "quantity", "at", "published", "computed", "outcome", "used_for", "remark"]
    return "".join([
        "# What the publication says, line by line\n\nMade by `python3 tests/publication/statements.py launchsafe -o "
        f"reports/publication` with {version}, from [the main job](../critical_gap_155mm/report.md) and its scene. "
        "\"Agrees\": within the digits printed, or what a figure shows.\n\n",
        markdown(["quantity", "statements", "agree", "held out", "of these agree", "largest difference"],
                 summary_of(judged)),
        "\n", markdown([name.replace("gap_cm", "gap [cm]").replace("_", " ") for name in columns],
                       ([row[name] for name in columns] for row in judged)),
        "\n", *(f"- {quantity}: {definition}\n" for quantity, (_, _, definition) in QUANTITIES.items())])


def main():
    arguments = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    arguments.add_argument("launchsafe")
    arguments.add_argument("-o", "--output", type=pathlib.Path)
    given = arguments.parse_args()

    def launchsafe(*words):
        done = subprocess.run([given.launchsafe, *map(str, words)], stdout=subprocess.PIPE, text=True)
        if done.returncode != 0:
            sys.exit(f"launchsafe {words[0]} ended with code {done.returncode}")
        return done.stdout

    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        launchsafe("study", STUDIES / "critical_gap_155mm.toml", "-o", folder / "main", "--quiet")
        launchsafe("run", STUDIES / "scene_155mm.toml", "-o", folder, "--quiet")
        launchsafe("plot", folder / "scene_155mm.h5", "--csv", "-o", folder, "--what", "pressure,histories", "--quiet")
        main_job = json.loads((folder / "main/study.json").read_text())
        pressure = columns_of(folder / "pressure.csv")
        launches = {f"{row['gap_cm']:g}": Launch(columns_of(folder / f"histories_{row['gap_cm']:g}cm.csv"), row)
                    for row in main_job["verdicts"]}
    judged, unexpected = [], 0
    with open(HERE / "statements.csv", newline="") as file:
        statements = list(csv.DictReader(file))
    for said in statements:
        computed, difference, outcome = "", None, "not computed"
        if said["quantity"] != "not computed":
            found = judge_launch(said, launches[said["gap_cm"]]) if said["gap_cm"] else judge_case(said, main_job, pressure)
            computed, difference, outcome = outcome_of(said, found)
        judged.append({**said, "at": circumstances(said), "computed": computed, "difference": difference,
                       "outcome": outcome})
        if outcome.split(" by ")[0] != said["expected"]:
            unexpected += 1
            print(f"not as expected: {judged[-1]}")
    counts = collections.Counter(row["outcome"].split(" by ")[0] for row in judged)
    print(", ".join(f"{count} {outcome}" for outcome, count in counts.items()), f"of {len(judged)} statements")
    if given.output:
        given.output.mkdir(parents=True, exist_ok=True)
        version = launchsafe("--version").splitlines()[0]
        (given.output / "statements.md").write_text(page_of(judged, version))
    return 1 if unexpected or not judged else 0


if __name__ == "__main__":
    sys.exit(main())
