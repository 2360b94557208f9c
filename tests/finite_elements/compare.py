#!/usr/bin/env python3
"""Static stresses at the charge's bottom against CalculiX, an independent finite element program.

    python3 tests/finite_elements/compare.py LAUNCHSAFE [-o DIR]

runs bodies at rest in the frame that accelerates with them, by particles on the mesh of studies/scene_155mm.toml and by
finite elements, and writes the comparison to summary.md and stresses.csv in DIR. Without ccx (Debian: calculix-ccx) the
exit code is 77; where a target is missed it is 1. Lengths are in m and stresses in MPa, hence masses in 1000 t: CalculiX
2.20 takes a compressibility as small as steel's in 1/Pa for zero and replaces it by a default.
"""
import argparse
import csv
import dataclasses
import math
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

BOX = 5e-3                            # stresses are means over boxes of this size at the bottom, by r dr dx
INNER, INNER_RADIUS = 0.01, 0.0575    # target for pressure and von Mises stress up to this radius
OUTER, SLIDING_OUTER = 0.04, 0.03     # beyond it, beside the wall; where the charge can slide
ALTERNATION, ALTERNATION_RADIUS = 1e-3, 0.056  # of a charge's pressure; beyond, it varies within a box
MOTION = 1e-3                         # what may still move
OWN_ERROR, SPRINGS = 0.25, 0.5        # of the elements, as a share of these targets

SHELL = {"nose": ("steel", 0, 0.118, 0, 0.0775), "charge": ("charge", 0.118, 0.678, 0, 0.065),
         "wall": ("steel", 0.118, 0.678, 0.065, 0.0775), "base": ("steel", 0.678, 0.74, 0, 0.0775)}
DENSITY = {"steel": 7830e-6, "charge": 1717e-6}
SHEAR = {"steel": 80e3, "charge": 944.0}  # of the charge what does not relax
HELD, OBSERVED, SAMPLES = 2.5, 0.5, 11    # ms, after the rise of the load


@dataclasses.dataclass
class Case:
    name: str
    pressure: float = 50.0
    plastic: bool = False
    sliding: dict = dataclasses.field(default_factory=dict)  # friction by the body on which the charge slides
    shell: bool = True             # else a bar

    def __post_init__(self):
        self.bodies, self.body = (SHELL, "charge") if self.shell else ({"bar": ("steel", 0, 0.1, 0, 0.02)}, "bar")
        _, _, self.bottom, _, radius = self.bodies[self.body]
        count = round(radius / BOX)
        self.stations = {f"{'G' if self.shell else 'B'}{k + 1}": (count - k - 0.5) * BOX for k in range(count)}
        # ms. Near critical for the slowest mode. With friction the state of rest depends on the path: while the charge
        # moves, the damping bears a part of its weight, and faces that stick afterwards keep the difference; slower, it
        # is a thirtieth instead of a tenth.
        slow = any(self.sliding.values())
        self.rise, self.damping = (4.0, 0.4) if slow else (1.0, 0.05 if self.shell else 0.012)

    def target(self, station):
        near = self.stations[station] < INNER_RADIUS + 1e-9
        return INNER if near else SLIDING_OUTER if self.sliding else OUTER


CASES = [Case("elastic shell, 50 MPa"), Case("plastic wall, 496 MPa", 496.0, plastic=True),
         Case("free bar, 50 MPa", shell=False),
         *(Case(f"sliding shell, friction {friction:g}", sliding=dict.fromkeys(("nose", "wall", "base"), friction))
           for friction in (0, 0.02, 0.1)),
         Case("smooth wall, base bonded", sliding={"nose": 0, "wall": 0})]


# --- particles ---

def shipped_mesh():
    """Cells and time step as in the shipped scene."""
    shipped = (pathlib.Path(__file__).parents[2] / "studies/scene_155mm.toml").read_text()
    keys = re.findall(r"^(?:cell_size|growth_x|growth_r|largest_cell|time_step_factor) = .*", shipped, re.MULTILINE)
    assert len(keys) == 5, "keys of [numerics]"
    return "".join(f"numerics.{key}\n" for key in keys)


def scene_of(case):
    def listed(values, unit):
        return '"' + ", ".join(f"{value:.12g}" for value in values) + f' {unit}"'
    shares = [k / 64 for k in range(65)]
    rising = [case.pressure * s**3 * (10 - s * (15 - 6 * s)) for s in shares]
    end = case.rise + HELD
    bodies = ",\n".join(f'  {{ name = "{name}", material = "{material}", x = "{x0} to {x1} m", r = "{r0} to {r1} m" }}'
                       for name, (material, x0, x1, r0, r1) in case.bodies.items())
    faces = "".join(f'interface.{body} = {{ condition = "sliding", friction = {friction} }}\n'
                    for body, friction in case.sliding.items())
    moduli = "" if case.plastic else ', shear_moduli = "944, 1e-6, 1e-6, 1e-6, 1e-6 MPa"'
    charge = f'charge = {{ flaw_size = "0 mm", tension_cutoff = "1 TPa"{moduli} }}\n' if case.shell else ""
    return f"""title = "{case.name}"
barrel = "{'rigid' if case.shell else 'none'}"
body = [\n{bodies}\n]
steel = {{ {'rate_sensitivity = 0' if case.plastic else 'yield_stress = "1 TPa"'} }}
{charge}{faces}physics = {{ conduction = "off", bulk_reaction = "off" }}
gap.thickness = "0 cm"
load.duration = "{end} ms"
load.curve_time = {listed([case.rise * s for s in shares] + [end], "ms")}
load.curve_pressure = {listed(rising + [case.pressure], "MPa")}
numerics.damping_time = "{case.damping} ms"
{shipped_mesh()}output.trace_interval = "0.1 ms"
output.snapshots = {listed([0.0] + [end - OBSERVED * k / (SAMPLES - 1) for k in reversed(range(SAMPLES))], "ms")}
"""


def measures(rr, xx, tt, rx):
    """Pressure and von Mises stress of a stress, tension positive."""
    mean = (rr + xx + tt) / 3
    return -mean, math.sqrt(1.5 * ((rr - mean)**2 + (xx - mean)**2 + (tt - mean)**2 + 2 * rx**2))


def differences(found, reference):
    return [[a / b - 1 for a, b in zip(*pair)] for pair in zip(found, reference)]


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


def particles(case, program, folder):
    """Means of the stations over the last snapshots; what still moves, and what alternates in the cells of a charge."""
    (folder / "case.toml").write_text(scene_of(case))
    for words in (["run", "case.toml", "-o", "."], ["plot", "case.h5", "--csv", "--what", "fields", "-o", "."]):
        subprocess.run([program, *words, "--quiet"], check=True, stdout=subprocess.DEVNULL, cwd=folder)
    tables = []
    for file in sorted(folder.glob("field_*.csv"), key=lambda file: float(file.stem[len("field_"):-len("ms")])):
        with open(file, newline="") as text:
            tables.append([row for row in csv.DictReader(text) if row["body"] == case.body])
    rest, *loaded = ([[float(row[name]) for name in (
        "x_mm", "r_mm", "half_length_x_mm", "half_length_r_mm", "pressure_MPa", "deviator_rr_MPa", "deviator_xx_MPa",
        "deviator_rx_MPa")] for row in table] for table in tables)
    assert len(loaded) == SAMPLES, "snapshots"
    series, rows = [], {}
    for middle in case.stations.values():
        shares = {}
        for k, (x, r, half_x, half_r, *_) in enumerate(rest):
            length = min(x + half_x, 1e3 * case.bottom) - max(x - half_x, 1e3 * (case.bottom - BOX))
            inner, outer = max(r - half_r, 1e3 * (middle - BOX / 2)), min(r + half_r, 1e3 * (middle + BOX / 2))
            if length > 1e-9 and outer - inner > 1e-9:
                shares[k] = length * (outer**2 - inner**2)
                rows.setdefault(round(x, 5), {})[1e-3 * r] = sum(now[k][4] for now in loaded) / SAMPLES
        total = sum(shares.values())
        means = [[sum(w * now[k][i] for k, w in shares.items()) / total for i in range(4, 8)] for now in loaded]
        series.append([measures(rr - p, xx - p, -rr - xx - p, rx) for p, rr, xx, rx in means])
    means = [[sum(column) / SAMPLES for column in zip(*each)] for each in series]
    motion = max(abs(change) for now in zip(*series) for pair in differences(now, means) for change in pair)
    return means, motion, alternation_of([sorted(row.items()) for row in rows.values()]) if case.shell else 0.0


# --- finite elements: CAX8R, 8 nodes and 2 x 2 points ---

def graded(begin, end, first, last):
    """Lines whose distances change geometrically from `first` to `last`, each rounded down to fit."""
    length, ratio = end - begin, last / first
    even = abs(ratio - 1) < 1e-9
    parts = max(1, math.ceil((length / first if even else length * math.log(ratio) / (last - first)) - 1e-9))
    return [begin + length * (k / parts if even else math.expm1(k / parts * math.log(ratio)) / (ratio - 1))
            for k in range(parts)] + [end]


def mesh(case):
    """Lines along x and r: fine at the bottom and toward its edge, with lines along all boxes."""
    _, begin, bottom, _, radius = case.bodies[case.body]
    finest, far, near = (0.5e-3, 50e-3, 3e-3) if case.shell else (1.25e-3, 10e-3, 2.5e-3)
    x = graded(begin, bottom - BOX, far, near) + graded(bottom - BOX, bottom, near, finest if case.shell else near)[1:]
    r = [k * BOX for k in range(len(case.stations))] + graded(radius - BOX, radius, BOX / 2, finest)[1:]
    if case.shell:
        x = graded(0, begin, 40e-3, 20e-3) + x[1:] + graded(bottom, case.bodies["base"][2], finest, 15e-3)[1:]
        r += graded(radius, case.bodies["wall"][4], finest, 4e-3)[1:]
    if case.sliding:
        # On the axis a face degenerates to a line, and CalculiX 2.20 does not find its contact. Hence a bore, held
        # radially; radii of 10 and 100 um give the same stresses to all digits.
        r[0] = 1e-5
    return x, r


def pressure_at(material, volume):
    """MPa on the isentrope through rest at a relative volume: unreacted JWL, Mie-Grueneisen."""
    if material == "charge":
        def cold(v):
            return 778.1e5 * math.exp(-11.3 * v) - 5031 * math.exp(-1.13 * v)
        return cold(volume) - cold(1) * volume**-1.8938
    mu = 1 / volume - 1
    hugoniot = DENSITY["steel"] * 4610**2 * mu * (1 + (1 - 1.67 / 2) * max(mu, 0)) / (1 - 0.73 * max(mu, 0))**2
    return hugoniot / (1 - 1.67 / 2 * (1 - volume))


def hardening():
    """Johnson-Cook at low rates, adiabatic: stress and plastic strain."""
    def flow(strain, temperature):
        return (792 + 510 * strain**0.26) * (1 - ((temperature - 298) / (1793 - 298))**1.03)
    temperature, strain = 300.0, 1e-6
    points = [(flow(0.0, temperature), 0.0)]
    while strain < 1:
        stress, before = points[-1]
        work = (stress + flow(strain, temperature)) / 2 * (strain - before)
        temperature += 0.9 * work / (DENSITY["steel"] * 460)
        points.append((flow(strain, temperature), strain))
        strain *= 1.25
    return points


def law_of(material, yields, pressure):
    """A law with the secant moduli from rest to a pressure; the charge's bulk modulus rises by 8 % under 141 MPa. With J
    the relative volume, p = -K ln J where it yields, in logarithmic strains; else p = K (1 - J) with the tangent shear
    modulus G/J, neo-Hookean: CalculiX's linear law for large strains would add twice the pressure times the strain."""
    low, high = 0.8, 1.2
    pressure = pressure if abs(pressure) > 1e-3 else 1e-3
    for _ in range(60):
        volume = (low + high) / 2
        low, high = (volume, high) if pressure_at(material, volume) > pressure else (low, volume)
    shear = SHEAR[material] * volume
    if not yields:
        return f"*HYPERELASTIC,NEO HOOKE\n{shear / 2:.10g},{2 / (pressure / (1 - volume)):.10g}\n"
    bulk = -pressure / math.log(volume)
    young, poisson = 9 * bulk * shear / (3 * bulk + shear), (3 * bulk - 2 * shear) / (6 * bulk + 2 * shear)
    return f"*ELASTIC\n{young:.10g},{poisson:.10g}\n*PLASTIC\n" + "".join(f"{s:.10g},{e:.10g}\n" for s, e in hardening())


class Model:
    """Elements (i along x, j along r), each cut in `finer` along both; `pressures` of the coarse ones for their moduli.
    Contact springs are softer by `softness`."""

    def __init__(self, case, pressures=None, finer=1, increment=0.02, softness=1.0):
        self.case, self.finer, self.increment, self.softness = case, finer, increment, softness
        self.x, self.r = ([a + (b - a) * k / finer for a, b in zip(edges, edges[1:]) for k in range(finer)] + edges[-1:]
                          for edges in mesh(case))
        self.pressures = pressures
        elements = [(i, j) for j in range(len(self.r) - 1) for i in range(len(self.x) - 1)]
        self.number = {element: k + 1 for k, element in enumerate(elements)}
        self.body = {(i, j): next(name for name, (_, x0, x1, r0, r1) in case.bodies.items() if
                                  x0 < self.x[i] + 1e-9 < x1 and r0 < self.r[j] + 1e-9 < r1) for i, j in elements}

    def material(self, element):
        return self.case.bodies[self.body[element]][0]

    def points(self, i, j):
        """x, r and weight (m3 per radian) of the integration points in CalculiX's order."""
        half_x, half_r = (self.x[i + 1] - self.x[i]) / 2, (self.r[j + 1] - self.r[j]) / 2
        for gauss_x in (-1, 1):
            for gauss_r in (-1, 1):
                r = self.r[j] + half_r * (1 + gauss_r / math.sqrt(3))
                yield self.x[i] + half_x * (1 + gauss_x / math.sqrt(3)), r, r * half_x * half_r

    def deck(self):
        nodes = {}
        def node(element, da, db):
            """Bonded bodies share a node; the charge has its own where it can part from all that is around."""
            a, b = 2 * element[0] + da, 2 * element[1] + db
            around = {self.body.get((k, m)) for k in ((a - 1) // 2, a // 2) for m in ((b - 1) // 2, b // 2)}
            others = around - {"charge", None}
            parts = self.body[element] == "charge" and others and others <= self.case.sliding.keys()
            return nodes.setdefault((a, b, bool(parts)), len(nodes) + 1)
        # Corners, then mid-sides: faces 1 (x least), 2 (r most), 3 (x most), 4 (r least).
        places = ((0, 0), (0, 2), (2, 2), (2, 0), (0, 1), (1, 2), (2, 1), (1, 0))
        parts = {}
        for i, j in self.number:
            pressure = self.pressures[i // self.finer, j // self.finer] if self.pressures else 0.0
            parts.setdefault((self.material((i, j)), pressure), []).append((i, j))
        lines, laws = [], []
        for k, ((material, pressure), elements) in enumerate(parts.items()):
            lines.append(f"*ELEMENT,TYPE=CAX8R,ELSET=PART{k}")
            lines += [",".join(map(str, [self.number[e], *(node(e, *place) for place in places)])) for e in elements]
            laws.append(f"*MATERIAL,NAME=MATERIAL{k}\n"
                        f"{law_of(material, self.case.plastic and material == 'steel', pressure)}"
                        f"*DENSITY\n{DENSITY[material]:.10g}\n*SOLID SECTION,ELSET=PART{k},MATERIAL=MATERIAL{k}")
        def middle(edges, k):
            return (edges[k // 2] + edges[(k + 1) // 2]) / 2
        head = [f"{n},{middle(self.r, b):.12g},{middle(self.x, a):.12g}" for (a, b, _), n in nodes.items()]
        held = {0, 2 * (len(self.r) - 1)} if self.case.shell else {0}
        # Pressure and body force balance; one node is held against rigid motion, at the far end, for it bears the change
        # of the pressed face's area.
        supports = [f"{n},1,1" for (_, b, _), n in nodes.items() if b in held] + [f"{nodes[0, 0, False]},2,2"]
        return "\n".join(["*NODE", *head, *lines, f"*ELSET,ELSET=ELEMENTS,GENERATE\n1,{len(self.number)}", *laws,
                          "*BOUNDARY", *supports, *self.contacts(), *self.steps()]) + "\n"

    def contacts(self):
        """Face-to-face penalty contact: pressure for an overlap of 1e9 MPa/m, and shear over the elastic slip of faces
        that stick, in proportion to a friction up to 0.1, so that the slip at the onset of sliding is the same. From
        four times this on at a friction of 0.1 points stick and slide in turn, and there is no equilibrium."""
        lines = []
        for body, friction in self.case.sliding.items():
            own, other = [], []
            for i, j in (element for element, name in self.body.items() if name == "charge"):
                for neighbour, face, opposite in (((i - 1, j), 1, 3), ((i + 1, j), 3, 1), ((i, j + 1), 2, 4)):
                    if self.body.get(neighbour) == body:
                        own.append(f"{self.number[i, j]},S{face}")
                        other.append(f"{self.number[neighbour]},S{opposite}")
            lines += [f"*SURFACE,NAME=OWN{body},TYPE=ELEMENT", *own, f"*SURFACE,NAME=OTHER{body},TYPE=ELEMENT", *other,
                      f"*CONTACT PAIR,INTERACTION=FACES{body},TYPE=SURFACE TO SURFACE\nOWN{body},OTHER{body}\n"
                      f"*SURFACE INTERACTION,NAME=FACES{body}\n*SURFACE BEHAVIOR,PRESSURE-OVERCLOSURE=LINEAR\n"
                      f"{1e9 * self.softness:.10g}"]
            if friction:
                lines.append(f"*FRICTION\n{friction},{min(friction, 0.1) * 2e8 * self.softness:.10g}")
        return lines

    def steps(self):
        """Little yields under the first half of the load; plastic flow is integrated over an increment: one of 0.2
        changes the pressure at the bottom by 0.3 %. With contact all is loaded at once: all grows in proportion, slip
        and its limit too; the default tolerances would exceed the differences to be measured."""
        case = self.case
        mass = sum(DENSITY[m] * (x1 - x0) * (r1**2 - r0**2) / 2 for m, x0, x1, r0, r1 in case.bodies.values())
        acceleration = case.pressure * self.r[-1]**2 / 2 / mass
        shares = [(0.5, 0.25), (1.0, 2 * self.increment)] if case.plastic else [(1.0, 1.0 if case.sliding else 0.2)]
        for share, increment in shares:
            yield f"*STEP,NLGEOM,INC=1000\n*STATIC\n{increment},1.,1e-5,{increment}"
            if case.sliding:
                yield "*CONTROLS,PARAMETERS=FIELD\n1e-4,1e-5,,,1e-4"
            yield f"*DLOAD\nELEMENTS,GRAV,{share * acceleration:.12g},0.,1.,0."
            for j in range(len(self.r) - 1):
                yield f"{self.number[len(self.x) - 2, j]},P3,{share * case.pressure:.12g}"
            yield "*EL PRINT,ELSET=ELEMENTS,FREQUENCY=1000\nS\n*END STEP"

    def stresses(self):
        """Runs ccx: (rr, xx, tt, rx), tension positive, at the points of every element."""
        with tempfile.TemporaryDirectory() as folder:
            job = pathlib.Path(folder) / "job"
            job.with_suffix(".inp").write_text(self.deck())
            run = subprocess.run(["ccx", "-i", "job"], cwd=folder, capture_output=True, text=True)
            if "Job finished" not in run.stdout:  # the exit code is 0 after most failures too
                sys.exit(f"{self.case.name}: ccx did not finish:\n{run.stdout[-2000:]}")
            table = job.with_suffix(".dat").read_text().split("stresses (elem, integ.pnt.")[-1].split("\n\n")[1]
        # An axisymmetric element is a wedge of 2 degrees. Points 1 to 4 lie at the Gauss place of its lower half, 5 to 8
        # mirror them: stresses are turned about the axis to the radial direction of the point.
        angle = math.atan(math.tan(math.radians(1)) / math.sqrt(3))
        c, s = math.cos(angle), math.sin(angle)
        elements, stresses = list(self.number), {}
        for line in table.splitlines():
            element, point, *values = line.split()
            if int(point) <= 4:
                rr, xx, tt, rx, rt, _ = map(float, values)
                stresses.setdefault(elements[int(element) - 1], []).append(
                    (c * c * rr + s * s * tt - 2 * s * c * rt, xx, s * s * rr + c * c * tt + 2 * s * c * rt, rx / c))
        assert len(stresses) == len(elements) and all(len(each) == 4 for each in stresses.values()), "stresses of ccx"
        return stresses

    def means(self):
        """Pressure and von Mises stress of the stations."""
        boxes = [[] for _ in self.case.stations]
        for element, stresses in self.stresses().items():
            for (x, r, weight), stress in zip(self.points(*element), stresses):
                for box, middle in zip(boxes, self.case.stations.values()):
                    if self.case.bottom - BOX < x < self.case.bottom and abs(r - middle) < BOX / 2:
                        box.append((weight, stress))
        return [measures(*(sum(w * stress[k] for w, stress in box) / sum(w for w, _ in box) for k in range(4)))
                for box in boxes]


def pressures_of(case):
    """Every element's pressure for its secant moduli, in one of 40 classes a material; two passes settle it."""
    classes = None
    for _ in range(2):
        model = Model(case, classes, increment=0.1)  # the moduli need the pressures to some per cent only
        pressure, classes = {}, {}
        for element, stresses in model.stresses().items():
            weights = [weight for _, _, weight in model.points(*element)]
            pressure[element] = sum(w * measures(*stress)[0] for w, stress in zip(weights, stresses)) / sum(weights)
        for material in {body[0] for body in case.bodies.values()}:
            own = {element: p for element, p in pressure.items() if model.material(element) == material}
            low, high = min(0.0, *own.values()), max(0.0, *own.values())
            for element, p in own.items():
                classes[element] = low + (min(int((p - low) / (high - low) * 40), 39) + 0.5) / 40 * (high - low)
    return classes


def elements(case, pressures, finer):
    """Means of the stations, and their largest change from contact springs of half the stiffness; with contact they are
    extrapolated to rigid faces."""
    stiff = Model(case, pressures, finer).means()
    if not case.sliding:
        return stiff, 0.0
    soft = Model(case, pressures, finer, softness=0.5).means()
    rigid = [[2 * a - b for a, b in zip(*pair)] for pair in zip(stiff, soft)]
    return rigid, max(abs(change) for pair in differences(soft, stiff) for change in pair)


# --- comparison ---

def compare(case, program):
    pressures = pressures_of(case)
    (coarse, _), (fine, springs) = elements(case, pressures, 1), elements(case, pressures, 2)
    with tempfile.TemporaryDirectory() as folder:
        means, motion, in_cells = particles(case, program, pathlib.Path(folder))
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
        for what, value, own_value in zip(("pressure", "von Mises stress"), error, own_error):
            target = case.target(station)
            expect(f"{what} at {station} differs by", value, target)
            expect(f"the elements' own {what} at {station} errs by", own_value, 1e-4 if exact else OWN_ERROR * target)
    expect("the contact's springs change stresses by", springs, SPRINGS * INNER)
    expect("the pressure alternates by", alternation, ALTERNATION)
    expect("it still moves, by", motion, MOTION)
    return {"case": case, "closed form": exact, "coarser finite elements": coarse, "finite elements": fine,
            "particles": means, "errors": errors, "own": own, "missed": missed,
            "others": [alternation, in_cells, motion, springs if case.sliding else None]}


def markdown(header, rows):
    lines = [header, ["---:"] * len(header), *rows]
    return "".join("| " + " | ".join(line) + " |\n" for line in lines)


def page_of(results, version):
    def percent(*values):
        return " / ".join("" if value is None else f"{100 * value:.3f}" for value in values)
    def largest(pairs):
        return percent(*(max(column, key=abs) for column in zip(*pairs)))
    missed = "".join(f"- {sentence}\n" for result in results for sentence in result["missed"])
    summary = markdown(
        ["case", "at the axis [MPa]", "largest difference [%]", "elements' own error [%]", "alternation [%]",
         "in cells [%]", "motion left [%]", "springs [%]"],
        [[result["case"].name, "{:.3f} / {:.3f}".format(*(result["closed form"] or result["finite elements"])[-1]),
          largest(result["errors"]), largest(result["own"]), *map(percent, result["others"])] for result in results])
    shells = [result for result in results if result["case"].shell]
    points = markdown(["point", "r [cm]", *(result["case"].name for result in shells)],
                      [[name, f"{100 * r:.2f}", *(percent(*result["errors"][n]) for result in shells)]
                       for n, (name, r) in enumerate(CASES[0].stations.items())])
    return f"""# Static stresses at the charge's bottom against finite elements

Made by `python3 tests/finite_elements/compare.py launchsafe -o reports/finite_elements` with CalculiX {version}.

The bodies rest in the frame that accelerates with them, under a pressure on the base that rises over 1 ms (4 ms with
friction, where motion leaves its mark) and then stays; what moves is damped. The elastic shell has bonded bodies in a
rigid barrel, steel that never yields, and a charge without cracks and tension cut-off that has kept only the spring of
its Maxwell elements. In the plastic one these relax, and the steel is Johnson-Cook's without its factor of the rate. The
steel bar of 100 mm and 40 mm diameter is free all around: its axial stress falls linearly to 0 at the far end. The charge
of a sliding shell is elastic, can slide on wall, base and nose, and part from them.

Particles are on the mesh of [the shipped scene](../../studies/scene_155mm.toml). Stresses are means over 5 mm x 5 mm at
the bottom with the weight r dr dx; pairs are of pressure and von Mises stress. The elements (axisymmetric, quadratic,
reduced integration) are of large strain, neo-Hookean where they do not yield; each has the secant bulk modulus of its
equation of state at its own pressure. Faces that can slide press on each other by springs (face-to-face penalty);
stresses are extrapolated from two stiffnesses to rigid faces. All numbers are in [stresses.csv](stresses.csv).

Targets: {100 * INNER:g} % of pressure and von Mises stress up to r = {100 * INNER_RADIUS:g} cm, beyond it \
{100 * OUTER:g} %, or {100 * SLIDING_OUTER:g} % where the charge can slide;
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

{points}"""


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("launchsafe", type=shutil.which)
    parser.add_argument("-o", "--output", type=pathlib.Path)
    given = parser.parse_args()
    if not shutil.which("ccx"):
        print("skipped: no program ccx (Debian: calculix-ccx)")
        return 77
    results = []
    for case in CASES:
        results.append(compare(case, given.launchsafe))
        print(f"{case.name}:", *results[-1]["missed"] or ["all targets are met"], sep="\n  ", flush=True)
    if given.output:
        version = subprocess.run(["ccx", "-v"], capture_output=True, text=True).stdout.split()[-1]
        given.output.mkdir(parents=True, exist_ok=True)
        (given.output / "summary.md").write_text(page_of(results, version))
        with open(given.output / "stresses.csv", "w", newline="") as file:
            table = csv.writer(file, lineterminator="\n")
            table.writerow(["case", "computed_by", "point", "r_cm", "pressure_MPa", "von_mises_MPa"])
            table.writerows([result["case"].name, by, name, f"{100 * r:g}", *(f"{value:.9g}" for value in mean)]
                            for result in results for by in ("closed form", "coarser finite elements", "finite elements",
                                                             "particles")
                            for (name, r), mean in zip(result["case"].stations.items(), result[by]))
    return 1 if any(result["missed"] for result in results) else 0


if __name__ == "__main__":
    sys.exit(main())
