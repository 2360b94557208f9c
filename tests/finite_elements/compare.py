#!/usr/bin/env python3
"""Static stresses at the charge's bottom against CalculiX, an independent finite element program.

    python3 tests/finite_elements/compare.py LAUNCHSAFE [--scene SCENE.toml] [--case NAME] [-o DIR]

runs bodies at rest in the frame that accelerates with them, by particles on the mesh of a scene, by default
studies/scene_155mm.toml, and by finite elements; and launches this scene, whose stresses and plastic strains at the peak
of its load are compared with those of finite elements at rest. Writes the comparison to summary.md and stresses.csv in
DIR. Without ccx (Debian: calculix-ccx) the exit code is 77; where a target is missed it is 1. Lengths are
in m and stresses in MPa.
"""
import argparse
import csv
import math
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

from cases import (ALTERNATION, ALTERNATION_RADIUS, BOX, CASES, FLOW_TIME, HELD, INNER, INNER_RADIUS, LAUNCH, LITTLE,
                   MEASURES, MOTION, OBSERVED, OUTER, OWN_ERROR, SAMPLES, SLAB, SLIDING_OUTER, SPRINGS, STRAIN, differences,
                   launch_of, measures, slab_means)
from elements import elements, pressures_of

# --- particles ---

def mesh_of(scene):
    """Cells and time step of a scene."""
    keys = re.findall(r"^(?:cell_size|growth_x|growth_r|largest_cell|time_step_factor) = .*", scene, re.MULTILINE)
    assert len(keys) == 5, "keys of [numerics]"
    return "".join(f"numerics.{key}\n" for key in keys)


def scene_of(case, given):
    """A case on the mesh of the given scene, or its launch."""
    if case.launch:
        stored = '[output]\nsnapshots = "0 ms"\nsnapshot_events = "peak-pressure"'
        return re.sub(r"^\[output\]$", stored, given, flags=re.MULTILINE)
    def listed(values, unit):
        return '"' + ", ".join(f"{value:.12g}" for value in values) + f' {unit}"'
    shares = [k / 64 for k in range(65)]
    rising = [case.pressure * s**3 * (10 - s * (15 - 6 * s)) for s in shares]
    end = case.rise + HELD
    bodies = ",\n".join(f'  {{ name = "{name}", material = "{material}", x = "{x0} to {x1} m", r = "{r0} to {r1} m" }}'
                       for name, (material, x0, x1, r0, r1) in case.bodies.items())
    faces = "".join(f'interface.{body} = {{ condition = "sliding", friction = {friction} }}\n'
                    for body, friction in case.sliding.items())
    moduli = "" if case.yield_stress else ', shear_moduli = "944, 1e-6, 1e-6, 1e-6, 1e-6 MPa"'
    charge = f'charge = {{ flaw_size = "0 mm", tension_cutoff = "1 TPa"{moduli} }}\n' if case.shell else ""
    return f"""title = "{case.name}"
constants = "none"
barrel = "{'rigid' if case.shell else 'none'}"
body = [\n{bodies}\n]
steel = {{ {'rate_sensitivity = 0' if case.yield_stress else 'yield_stress = "1 TPa"'} }}
{charge}{faces}physics = {{ conduction = "off", bulk_reaction = "off" }}
gap.thickness = "0 cm"
load.duration = "{end} ms"
load.curve_time = {listed([case.rise * s for s in shares] + [end], "ms")}
load.curve_pressure = {listed(rising + [case.pressure], "MPa")}
numerics.damping_time = "{case.damping} ms"
{mesh_of(given)}output.trace_interval = "0.1 ms"
output.snapshots = {listed([0.0] + [end - OBSERVED * k / (SAMPLES - 1) for k in reversed(range(SAMPLES))], "ms")}
"""


def alternation_of(rows):
    """Root mean square over rows of (r, value) of what alternates from one to the next, as a share of the values': the
    fourth divided difference, 0 for what is cubic over five, scaled to +-a for +-a in turn."""
    alternating = whole = 0.0
    for row in rows:
        for five in zip(row, row[1:], row[2:], row[3:], row[4:]):
            if five[2][0] < ALTERNATION_RADIUS:
                weights = [1 / math.prod(r - other for other, _ in five if other != r) for r, _ in five]
                alternating += (sum(w * p for w, (_, p) in zip(weights, five)) / sum(map(abs, weights)))**2
                whole += five[2][1]**2
    return math.sqrt(alternating / whole)


def particles(case, program, given, folder):
    """Means of the stations over the last snapshots; what still moves, and what alternates in the cells of a charge; mean
    plastic strains of the wall's slabs."""
    (folder / "case.toml").write_text(scene_of(case, given))
    for words in (["run", "case.toml", "-o", "."], ["plot", "case.h5", "--csv", "--what", "fields", "-o", "."]):
        subprocess.run([program, *words, "--quiet"], check=True, stdout=subprocess.DEVNULL, cwd=folder)
    tables = []
    def time_of(file):
        return float((re.search(r"field_([\d.]+)ms", file.stem) or [0, math.inf])[1])  # of an event: after all
    for file in sorted(folder.glob("field_*.csv"), key=time_of):
        with open(file, newline="") as text:
            tables.append(list(csv.DictReader(text)))
    wall = []
    for before, now in zip(tables[0], tables[-1]):
        if before["body"] == "wall":
            x, half_x, r, half_r = (1e-3 * float(before[name]) for name in ("x_mm", "half_length_x_mm", "r_mm",
                                                                            "half_length_r_mm"))
            wall.append((x - half_x, x + half_x, r * half_r, float(now["plastic_strain"])))
    rest, *loaded = ([[float(row[name]) for name in (
        "x_mm", "r_mm", "half_length_x_mm", "half_length_r_mm", "pressure_MPa", "deviator_rr_MPa", "deviator_xx_MPa",
        "deviator_rx_MPa")] for row in table if row["body"] == case.body] for table in tables)
    assert len(loaded) == (1 if case.launch else SAMPLES), "snapshots"
    series, rows = [], {}
    for middle in case.stations.values():
        shares = {}
        for k, (x, r, half_x, half_r, *_) in enumerate(rest):
            length = min(x + half_x, 1e3 * case.bottom) - max(x - half_x, 1e3 * (case.bottom - BOX))
            inner, outer = max(r - half_r, 1e3 * (middle - BOX / 2)), min(r + half_r, 1e3 * (middle + BOX / 2))
            if length > 1e-9 and outer - inner > 1e-9:
                shares[k] = length * (outer**2 - inner**2)
                rows.setdefault(round(x, 5), {})[1e-3 * r] = sum(now[k][4] for now in loaded) / len(loaded)
        total = sum(shares.values())
        means = [[sum(w * now[k][i] for k, w in shares.items()) / total for i in range(4, 8)] for now in loaded]
        series.append([measures(rr - p, xx - p, -rr - xx - p, rx) for p, rr, xx, rx in means])
    means = [[sum(column) / len(loaded) for column in zip(*each)] for each in series]
    motion = max(abs(change) for now in zip(*series) for pair in differences(now, means) for change in pair[:2])
    in_cells = alternation_of([sorted(row.items()) for row in rows.values()]) if case.shell else 0.0
    return means, motion, in_cells, slab_means(wall, case.bottom) if case.launch else []


# --- comparison ---

def compare(case, program, given):
    pressures = pressures_of(case)
    (coarse, springs, _), (fine, of_fine, wall) = elements(case, pressures, 1), elements(case, pressures, 2)
    springs = of_fine or springs
    with tempfile.TemporaryDirectory() as folder:
        means, motion, in_cells, wall_means = particles(case, program, given, pathlib.Path(folder))
    axial = case.pressure * (1 - 0.5 * BOX / case.bottom)  # of the bar, mean over a box
    exact = [] if case.shell else [(axial / 3, axial)] * len(fine)
    errors, own = differences(means, exact or fine), differences(fine, exact) if exact else differences(coarse, fine)
    ratios = [(r, mean[0] / other[0]) for r, mean, other in zip(case.stations.values(), means, exact or fine)]
    alternation = alternation_of([ratios]) if case.shell else 0.0
    missed = []
    def expect(what, value, limit):
        if not abs(value) <= limit:  # true for NaN too
            missed.append(f"{case.name}: {what} {100 * value:+.3g} %; allowed: {100 * limit:.3g} %")
    for station, error, own_error in zip(case.stations, errors, own):
        of_measures = dict(zip(MEASURES, zip(error, own_error)))
        for what, target in case.targets(station).items():
            value, own_value = of_measures[what]
            expect(f"{what} at {station} differs by", value, target)
            expect(f"the elements' own {what} at {station} errs by", own_value, 1e-4 if exact else OWN_ERROR * target)
    for k, (strain, other) in enumerate(zip(wall_means, wall)):
        if other > LITTLE:
            expect(f"the wall's plastic strain from {100 * k * SLAB:g} cm off the bottom differs by", strain / other - 1,
                   STRAIN)
    expect("the contact's springs change stresses by", springs, SPRINGS * (LAUNCH if case.launch else INNER))
    expect("the pressure alternates by", alternation, ALTERNATION)
    expect("it still moves, by", motion, MOTION)
    return {"case": case, "closed form": exact, "coarser finite elements": coarse, "finite elements": fine,
            "particles": means, "errors": errors, "own": own, "missed": missed,
            "others": [alternation, in_cells, None if case.launch else motion, springs if case.sliding else None],
            "wall": list(zip(wall_means, wall))}


def markdown(header, rows):
    lines = [header, ["---:"] * len(header), *rows]
    return "".join("| " + " | ".join(line) + " |\n" for line in lines)


def page_of(results, version):
    def percent(*values):
        return " / ".join("" if value is None else f"{100 * value:.3f}" for value in values)
    def largest(pairs):
        return percent(*(max(column, key=abs) for column in zip(*(pair[:2] for pair in pairs))))
    missed = "".join(f"- {sentence}\n" for result in results for sentence in result["missed"])
    summary = markdown(
        ["case", "at the axis [MPa]", "largest difference [%]", "elements' own error [%]", "alternation [%]",
         "in cells [%]", "motion left [%]", "springs [%]"],
        [[result["case"].name, "{:.3f} / {:.3f}".format(*(result["closed form"] or result["finite elements"])[-1][:2]),
          largest(result["errors"]), largest(result["own"]), *map(percent, result["others"])] for result in results])
    shells = [result for result in results if result["case"].shell]
    points = markdown(["point", "r [cm]", *(result["case"].name for result in shells)],
                      [[name, f"{100 * r:.2f}", *(percent(*result["errors"][n][:2]) for result in shells)]
                       for n, (name, r) in enumerate(CASES[0].stations.items())])
    launches = "".join(f"""
**{case.name.capitalize()}: {case.pressure:g} MPa, A of steel {case.yield_stress:g} MPa, friction \
{", ".join(f"{value:g} on the {body}" for body, value in case.sliding.items())}**

Particles / finite elements, MPa, and their difference, %:

{markdown(["point", *MEASURES], [[name, *(f"{own:.2f} / {other:.2f} ({100 * error:+.2f})" for own, other, error in zip(*rows))]
          for name, *rows in zip(case.stations, result["particles"], result["finite elements"], result["errors"])])}
Plastic strain of the wall, mean over its thickness:

{markdown(["from the bottom [cm]", "particles [%]", "finite elements [%]", "difference [%]"],
          [[f"{100 * k * SLAB:g} to {100 * (k + 1) * SLAB:g}", f"{100 * own:.3f}", f"{100 * other:.3f}",
            f"{100 * (own / other - 1):+.1f}" if other else ""] for k, (own, other) in enumerate(result["wall"])])}"""
        for result in results for case in [result["case"]] if case.launch)
    return f"""# Static stresses at the charge's bottom against finite elements

Made by `python3 tests/finite_elements/compare.py launchsafe -o reports/finite_elements` with CalculiX {version}.

The bodies rest in the frame that accelerates with them, under a pressure on the base that rises over 1 ms (4 ms with
friction, where motion leaves its mark) and then stays; what moves is damped. The elastic shell has bonded bodies in a
rigid barrel, steel that never yields, and a charge without cracks and tension cut-off that has kept only the spring of
its Maxwell elements. In the plastic one these relax, and the steel is Johnson-Cook's without its factor of the rate. The
steel bar of 100 mm and 40 mm diameter is free all around: its axial stress falls linearly to 0 at the far end. The charge
of a sliding shell is elastic, can slide on wall, base and nose, and part from them.

The launch at its peak is that of the scene, with its interfaces and the yield stress of its steel: particles at the
instant of the largest pressure on the base, elements at rest under it. The elements' steel has the factor of the rate at
which its plastic strain is reached in {FLOW_TIME:g} ms, as in the launch (strain over its rate, 0.75 to 1.05 ms where the wall
yields); without the factor the wall strains by up to a quarter more. The rest is as in the plastic case.

Particles are on the mesh of [the shipped scene](../../studies/scene_155mm.toml). Stresses are means over 5 mm x 5 mm at
the bottom with the weight r dr dx; pairs are of pressure and von Mises stress. The elements (axisymmetric, quadratic,
reduced integration) are of large strain, neo-Hookean where they do not yield; each has the secant bulk modulus of its
equation of state at its own pressure. Faces that can slide press on each other by springs (face-to-face penalty);
stresses are extrapolated from two stiffnesses to rigid faces, except for the launch. All numbers are in
[stresses.csv](stresses.csv).

Targets: {100 * INNER:g} % of pressure and von Mises stress up to r = {100 * INNER_RADIUS:g} cm, beyond it \
{100 * OUTER:g} %, or {100 * SLIDING_OUTER:g} % where the charge can slide. Of the launch
{100 * LAUNCH:g} % of pressure and of radial, axial and hoop stress everywhere, and {100 * STRAIN:g} % of the wall's plastic
strain in slabs of {100 * SLAB:g} cm where it is above {100 * LITTLE:g} % (its von Mises stress, a
seventh of the pressure, has no target: beside the wall it still falls as particles' cells shrink). In all cases
{100 * ALTERNATION:g} % for what alternates in the charge's pressure from point to point, and for what still moves. The
elements' own error is to be at most {OWN_ERROR:g} of the first ones, and what springs change {SPRINGS:g}.

{missed or "All are met." + chr(10)}
{summary}

Own error: from elements each cut in four; of the bar from the closed form, from which its particles differ too.
Alternation: root mean square of the fourth divided difference of the pressure along r for r < {100 * ALTERNATION_RADIUS:g} cm,
scaled to the amplitude of what alternates: from point to point, over that of the elements; and from cell to cell, which
are up to 5 mm wide (verdicts rest on means over stations). Motion left: the largest departure of a stress from its mean
over the last 0.5 ms.

**Particles against finite elements, %**

{points}{launches}"""


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("launchsafe", type=shutil.which)
    shipped = pathlib.Path(__file__).parents[2] / "studies/scene_155mm.toml"
    parser.add_argument("--scene", type=pathlib.Path, default=shipped, help="of the mesh, and of the launch")
    parser.add_argument("--case", default="", help="only cases whose names begin so")
    parser.add_argument("-o", "--output", type=pathlib.Path)
    given = parser.parse_args()
    if not shutil.which("ccx"):
        print("skipped: no program ccx (Debian: calculix-ccx)")
        return 77
    results, scene = [], given.scene.read_text()
    for case in [*CASES, launch_of(scene)]:
        if not case.name.startswith(given.case):
            continue
        results.append(compare(case, given.launchsafe, scene))
        print(f"{case.name}:", *results[-1]["missed"] or ["all targets are met"], sep="\n  ", flush=True)
    if given.output:
        version = subprocess.run(["ccx", "-v"], capture_output=True, text=True).stdout.split()[-1]
        given.output.mkdir(parents=True, exist_ok=True)
        (given.output / "summary.md").write_text(page_of(results, version))
        with open(given.output / "stresses.csv", "w", newline="") as file:
            table = csv.writer(file, lineterminator="\n")
            table.writerow(["case", "computed_by", "point", "r_cm", "pressure_MPa", "von_mises_MPa", "radial_MPa", "axial_MPa",
                            "hoop_MPa"])
            table.writerows([result["case"].name, by, name, f"{100 * r:g}", *(f"{value:.9g}" for value in mean)]
                            for result in results for by in ("closed form", "coarser finite elements", "finite elements",
                                                             "particles")
                            for (name, r), mean in zip(result["case"].stations.items(), result[by]))
    return 1 if any(result["missed"] for result in results) else 0


if __name__ == "__main__":
    sys.exit(main())
