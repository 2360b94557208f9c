"""The cases by CalculiX, with CAX8R elements of 8 nodes and 2 x 2 points: meshes, laws, input decks, stresses. Stresses are in
MPa, hence masses in 1000 t: CalculiX 2.20 takes a compressibility as small as steel's in 1/Pa for zero and replaces it by
a default."""
import math
import pathlib
import subprocess
import sys
import tempfile

from cases import BOX, DENSITY, SHEAR, differences, measures, slab_means


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


def hardening(yield_stress, flow_time):
    """Johnson-Cook, adiabatic: stress and plastic strain. At low rates, or at that of a strain reached in a time, ms."""
    def flow(strain, temperature):
        rate = max(1.0, 1e3 * strain / flow_time) if flow_time else 1.0
        return ((yield_stress + 510 * strain**0.26) * (1 + 0.014 * math.log(rate))
                * (1 - ((temperature - 298) / (1793 - 298))**1.03))
    temperature, strain = 300.0, 1e-6
    points = [(flow(0.0, temperature), 0.0)]
    while strain < 1:
        stress, before = points[-1]
        work = (stress + flow(strain, temperature)) / 2 * (strain - before)
        temperature += 0.9 * work / (DENSITY["steel"] * 460)
        points.append((flow(strain, temperature), strain))
        strain *= 1.25
    return points


def law_of(case, material, pressure):
    """A law with the secant moduli from rest to a pressure; the charge's bulk modulus rises by 8 % under 141 MPa. With J
    the relative volume, p = -K ln J where it yields, in logarithmic strains; else p = K (1 - J) with the tangent shear
    modulus G/J, neo-Hookean: CalculiX's linear law for large strains would add twice the pressure times the strain."""
    low, high = 0.8, 1.2
    pressure = pressure if abs(pressure) > 1e-3 else 1e-3
    for _ in range(60):
        volume = (low + high) / 2
        low, high = (volume, high) if pressure_at(material, volume) > pressure else (low, volume)
    shear = SHEAR[material] * volume
    if not case.yield_stress or material != "steel":
        return f"*HYPERELASTIC,NEO HOOKE\n{shear / 2:.10g},{2 / (pressure / (1 - volume)):.10g}\n"
    bulk = -pressure / math.log(volume)
    young, poisson = 9 * bulk * shear / (3 * bulk + shear), (3 * bulk - 2 * shear) / (6 * bulk + 2 * shear)
    return (f"*ELASTIC\n{young:.10g},{poisson:.10g}\n*PLASTIC\n"
            + "".join(f"{s:.10g},{e:.10g}\n" for s, e in hardening(case.yield_stress, case.flow_time)))


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
                        f"{law_of(self.case, material, pressure)}"
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
        four times this on at a friction of 0.1, and from this on where the wall yields, points stick and slide in turn,
        and there is no equilibrium."""
        shear, lines = 5e7 if self.case.yield_stress else 2e8, []
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
                lines.append(f"*FRICTION\n{friction},{min(friction, 0.1) * shear * self.softness:.10g}")
        return lines

    def steps(self):
        """Little yields under the first half of the load; plastic flow is integrated over an increment: one of 0.2
        changes the pressure at the bottom by 0.3 %. With contact all is loaded at once: all grows in proportion, slip
        and its limit too; the default tolerances would exceed the differences to be measured."""
        case = self.case
        mass = sum(DENSITY[m] * (x1 - x0) * (r1**2 - r0**2) / 2 for m, x0, x1, r0, r1 in case.bodies.values())
        acceleration = case.pressure * self.r[-1]**2 / 2 / mass
        shares = [(0.5, 0.25), (1.0, 2 * self.increment)] if case.yield_stress else [(1.0, 1.0 if case.sliding else 0.2)]
        for share, increment in shares:
            yield f"*STEP,NLGEOM,INC=1000\n*STATIC\n{increment},1.,1e-5,{increment}"
            if case.sliding:
                yield "*CONTROLS,PARAMETERS=FIELD\n1e-4,1e-5,,,1e-4"
            yield f"*DLOAD\nELEMENTS,GRAV,{share * acceleration:.12g},0.,1.,0."
            for j in range(len(self.r) - 1):
                yield f"{self.number[len(self.x) - 2, j]},P3,{share * case.pressure:.12g}"
            yield f"*EL PRINT,ELSET=ELEMENTS,FREQUENCY=1000\nS{',PEEQ' if case.yield_stress else ''}\n*END STEP"

    def stresses(self):
        """Runs ccx: (rr, xx, tt, rx), tension positive, at the points of every element. Of the wall's, `wall` has the
        plastic strains."""
        with tempfile.TemporaryDirectory() as folder:
            job = pathlib.Path(folder) / "job"
            job.with_suffix(".inp").write_text(self.deck())
            run = subprocess.run(["ccx", "-i", "job"], cwd=folder, capture_output=True, text=True)
            if "Job finished" not in run.stdout:  # the exit code is 0 after most failures too
                sys.exit(f"{self.case.name}: ccx did not finish:\n{run.stdout[-2000:]}")
            blocks = job.with_suffix(".dat").read_text().split("stresses (elem, integ.pnt.")[-1].split("\n\n")
            table, plastic_strains = blocks[1], blocks[3] if self.case.yield_stress else ""
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
        self.wall = []
        for line in plastic_strains.splitlines():
            element, _, strain = line.split()
            i, j = elements[int(element) - 1]
            if self.body[i, j] == "wall":
                self.wall.append((self.x[i], self.x[i + 1], self.r[j + 1]**2 - self.r[j]**2, float(strain)))
        assert len(stresses) == len(elements) and all(len(each) == 4 for each in stresses.values()), "stresses of ccx"
        return stresses

    def means(self):
        """Measures of the stations."""
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
    """Means of the stations, their largest change from contact springs of half the stiffness, and plastic strains of the
    wall's slabs. With contact means are extrapolated to rigid faces; not so where the wall yields too, where fine elements
    take long: there the springs' change comes from coarse ones alone."""
    increment = 0.05 if case.launch else 0.02
    model = Model(case, pressures, finer, increment)
    stiff = model.means()
    wall = slab_means(model.wall, case.bottom) if case.launch else []
    if not case.sliding or case.launch and finer > 1:
        return stiff, 0.0, wall
    soft = Model(case, pressures, finer, increment, softness=0.5).means()
    springs = max(abs(change) for pair in differences(soft, stiff) for change in pair[:2])
    return stiff if case.launch else [[2 * a - b for a, b in zip(*pair)] for pair in zip(stiff, soft)], springs, wall
