"""What particles and finite elements both compute: bodies at rest in the frame that accelerates with them, the stations
at the bottom where their stresses are compared, and the targets. Lengths are in m and stresses in MPa."""
import dataclasses
import math
import pathlib
import tomllib

BOX = 5e-3                            # stresses are means over boxes of this size at the bottom, by r dr dx
INNER, INNER_RADIUS = 0.01, 0.0575    # target for pressure and von Mises stress up to this radius
OUTER, SLIDING_OUTER = 0.04, 0.03     # beyond it, beside the wall; where the charge can slide
ALTERNATION, ALTERNATION_RADIUS = 1e-3, 0.056  # of a charge's pressure; beyond, it varies within a box
LAUNCH, STRAIN = 0.02, 0.1            # of a launch at its peak: all stresses but von Mises', plastic strain of the wall,
SLAB, SLABS, LITTLE = 0.02, 6, 5e-4   # a mean over its slabs above the bottom, where it is more than little
MOTION = 1e-3                         # what may still move
OWN_ERROR, SPRINGS = 0.25, 0.5        # of the elements, as a share of these targets

SHELL = {"nose": ("steel", 0, 0.118, 0, 0.0775), "charge": ("charge", 0.118, 0.678, 0, 0.065),
         "wall": ("steel", 0.118, 0.678, 0.065, 0.0775), "base": ("steel", 0.678, 0.74, 0, 0.0775)}
DENSITY = {"steel": 7830e-6, "charge": 1717e-6}
SHEAR = {"steel": 80e3, "charge": 944.0}  # of the charge what does not relax
HELD, OBSERVED, SAMPLES = 2.5, 0.5, 11    # ms, after the rise of the load
FLOW_TIME = 0.8                           # ms: plastic strain over its rate at the peak of the shipped launch


@dataclasses.dataclass
class Case:
    name: str
    pressure: float = 50.0
    yield_stress: float = 0.0      # of steel that yields
    flow_time: float = 0.0         # ms, in which it reaches its plastic strain; 0: slowly
    sliding: dict = dataclasses.field(default_factory=dict)  # friction by the body on which the charge slides
    shell: bool = True             # else a bar
    launch: bool = False           # of the given scene, at its peak; else bodies at rest

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

    def targets(self, station):
        """Of the measures that have one."""
        if self.launch:
            return {what: LAUNCH for what in MEASURES if what != "von Mises stress"}
        near = self.stations[station] < INNER_RADIUS + 1e-9
        return dict.fromkeys(MEASURES[:2], INNER if near else SLIDING_OUTER if self.sliding else OUTER)


CASES = [Case("elastic shell, 50 MPa"), Case("plastic wall, 496 MPa", 496.0, yield_stress=792.0),
         Case("free bar, 50 MPa", shell=False),
         *(Case(f"sliding shell, friction {friction:g}", sliding=dict.fromkeys(("nose", "wall", "base"), friction))
           for friction in (0, 0.02, 0.1)),
         Case("smooth wall, base bonded", sliding={"nose": 0, "wall": 0})]


FACES = {"front": "nose", "side": "wall", "bottom": "base"}
CONSTANTS = pathlib.Path(__file__).parents[2] / "studies/constants"


def launch_of(scene):
    """A scene's launch at its peak. Of its keys those count in which models of the launch differ, with those of its
    constants where the scene says nothing; the shell is SHELL."""
    def metres(span):
        begin, _, end, unit = span.split()
        return [round(float(value) * {"cm": 1e-2, "mm": 1e-3, "m": 1}[unit], 9) for value in (begin, end)]
    def megapascals(text):
        number, unit = text.split()
        return float(number) * {"Pa": 1e-6, "MPa": 1, "GPa": 1e3}[unit]
    keys = tomllib.loads(scene)
    bodies = {body["name"]: (body["material"], *metres(body["x"]), *metres(body["r"])) for body in keys["body"]}
    assert bodies == SHELL, "another shell"
    constants = tomllib.loads((CONSTANTS / (keys.get("constants", "155mm") + ".toml")).read_text())["set"]
    held = {FACES[face]: how for face, how in constants["interface"].items()} | keys.get("interface", {})
    return Case("launch at its peak", megapascals(keys["load"]["peak"]),
                megapascals((constants["steel"] | keys.get("steel", {}))["yield_stress"]), FLOW_TIME,
                {body: how["friction"] for body, how in held.items() if how["condition"] == "sliding"}, launch=True)


def slab_means(cells, bottom):
    """Means over slabs above the bottom, from cells of (x from, x to, weight across, value)."""
    means = []
    for k in range(SLABS):
        shares = [(max(0.0, min(x1, bottom - k * SLAB) - max(x0, bottom - (k + 1) * SLAB)) * weight, value)
                  for x0, x1, weight, value in cells]
        means.append(sum(w * value for w, value in shares) / sum(w for w, _ in shares))
    return means


MEASURES = ("pressure", "von Mises stress", "radial stress", "axial stress", "hoop stress")


def measures(rr, xx, tt, rx):
    """MEASURES of a stress, tension positive."""
    mean = (rr + xx + tt) / 3
    return -mean, math.sqrt(1.5 * ((rr - mean)**2 + (xx - mean)**2 + (tt - mean)**2 + 2 * rx**2)), rr, xx, tt


def differences(found, reference):
    return [[a / b - 1 for a, b in zip(*pair)] for pair in zip(found, reference)]
