#!/usr/bin/env python3
"""The panel of a fit in a browser against `launchsafe ask`: the same numbers and words; needs chromium.

A script of this test puts values into a copy of ask.html and writes down what it shows. Fits are those of a small
sensitivity study and of a sweep of the 155 mm shell, of polynomials and Gaussian processes.
Usage: ask_page.py LAUNCHSAFE SOURCE_DIR; 77 without chromium.
"""
import html
import json
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

SENSITIVITY = """kind = "sensitivity"
scene = "SCENE"
method = "polynomial-chaos"
samples = 20
held_out = 30
gaps = "0.02 cm"
largest_gap = "0.4 cm"
vary = [
  { key = "peak_pressure", distribution = "normal", mean = "496 MPa", deviation = "10 MPa", range = "480 to 526 MPa" },
  { key = "initial_temperature", distribution = "uniform", range = "288 to 312 K" },
  { calibration = "SOURCE/reports/calibrate_table8/calibration.json" },
]
correlation = [
  { between = ["peak_pressure", "initial_temperature"], coefficient = 0.5 },
  { between = ["peak_pressure", "friction.localisation"], coefficient = -0.3 },
]
[set]
numerics.cell_size = "2.5 mm"
"""
SWEEP = """kind = "critical-gap"
scene = "SCENE"
gaps = "0.02, 0.04 cm"
largest_gap = "0.4 cm"
surrogate = true
numerical_uncertainty = { value = "5 K", because = "for a test" }
input_uncertainty = { value = "2 K", because = "for a test" }
model_form_uncertainty = { value = "1 K", because = "for a test" }
accept = [ { key = "gap.exchange_time", value = "0.2 to 0.4 ms", because = "for a test" } ]
[[vary]]
key = "peak_pressure"
range = "460 to 530 MPa"
count = 8
[[vary]]
key = "gap.exchange_time"
range = "0.2 to 0.4 ms"
count = 9
[set]
numerics.cell_size = "2.5 mm"
"""
# Values in the units of the page, by the names of its boxes, and a gap in cm; the names that `ask` has for them.
POINTS = {
    "sensitivity": [({}, 0.02), ({"peak_pressure": 505.5, "initial_temperature": 305}, 0.03),
                    ({"peak_pressure": 487, "load_width": 2.95, "gap_exchange_time": 0.29}, 0.05),
                    ({"initial_temperature": 313}, 0.02), ({"peak_pressure": 525.9, "initial_temperature": 311.9}, 0.02)],
    "sweep": [({"peak_pressure": 500, "gap_exchange_time": 0.33}, 0.03), ({"peak_pressure": 467.3}, 0.06),
              ({"peak_pressure": 500, "gap_exchange_time": 0.33}, 0.04), ({"gap_exchange_time": 0.21}, 0.0372),
              ({"gap_exchange_time": 0.41}, 0.03)],
}
UNITS = {"peak_pressure": "MPa", "initial_temperature": "K", "load_width": "ms", "gap_exchange_time": "ms"}

MEASURE = """
const results = [];
for (const [values, gap] of POINTS) {
  const before = {};
  for (const [name, value] of Object.entries({...values, gap_cm: gap})) {
    const box = document.getElementById(name);
    before[name] = box.value;
    box.value = value;
    box.dispatchEvent(new Event('input'));
  }
  results.push({rows: [...document.querySelectorAll('#outputs tr')].map(row => ({...row.dataset})),
                share: {...document.getElementById('share').dataset},
                word: document.getElementById('word').textContent, fault: document.getElementById('fault').textContent});
  for (const [name, value] of Object.entries(before)) document.getElementById(name).value = value;
}
const found = document.createElement('pre');
found.id = 'found';
found.textContent = JSON.stringify(results);
document.body.append(found);
"""


def shown(page, points, folder):
    script = "<script>" + MEASURE.replace("POINTS", json.dumps(points)) + "</script></body>"
    copy = folder / "copy.html"
    copy.write_text(page.replace("</body>", script))
    dom = subprocess.run(["chromium", "--headless", "--no-sandbox", "--disable-gpu", "--virtual-time-budget=8000",
                          "--dump-dom", f"file://{copy}"], check=True, capture_output=True, text=True, timeout=120).stdout
    return json.loads(html.unescape(re.search(r'<pre id="found">(.*?)</pre>', dom, re.S).group(1)))


def asked(program, study, values, gap):
    settings = [word for name, value in values.items()
                for word in ("--set", f"{name.replace('gap_', 'gap.').replace('load_', 'load.')}={value} {UNITS[name]}")]
    return subprocess.run([program, "ask", study, *settings, "--gap", f"{gap} cm", "--json"], capture_output=True, text=True)


def close(a, b):
    return abs(a - b) <= 1e-6 * max(abs(b), 1e-3)


def faults_of(program, study, name, page, folder):
    """Where the page says another thing than the program; how many points both refused."""
    faults, refused = [], 0
    for (values, gap), page_says in zip(POINTS[name], shown(page, POINTS[name], folder)):
        what, outcome = f"{name}, {values}, {gap} cm", asked(program, study, values, gap)
        if outcome.returncode == 2:
            refused += 1
            if not page_says["fault"] or page_says["word"]:
                faults.append(f"{what}: the program refuses, the page says {page_says}")
            continue
        program_says = json.loads(outcome.stdout)
        numbers = program_says["launches"][0]
        if page_says["fault"]:
            faults.append(f"{what}: {page_says['fault']}")
            continue
        for row in page_says["rows"]:
            unit = "cm" if row["name"] == "critical_gap" else "K"
            for which, key in (("value", f"{row['name']}_{unit}"), ("error", f"{row['name']}_error_{unit}")):
                if not close(float(row[which]), numbers[key]):
                    faults.append(f"{what}: {key} is {row[which]}, not {numbers[key]}")
        if not page_says["rows"] or not page_says["word"].endswith(program_says.get("gap", "nothing")):
            faults.append(f"{what}: the page says {page_says['word']}, the program {program_says['gap']}")
        # The page draws all inputs, as `ask` does where none is set; of the ranges of a sweep neither draws.
        page_counts = {key: int(count) for key, count in page_says["share"].items()}
        if not values and page_counts != program_says.get("ignitions", {}):
            faults.append(f"{what}: of the draws the page says {page_counts}, the program {program_says.get('ignitions')}")
        print(f"{what}: {page_says['word']} {page_counts}")
    return faults, refused


def main():
    if not shutil.which("chromium"):
        print("no chromium")
        return 77
    program, source = sys.argv[1:]
    faults, kinds = [], set()
    with tempfile.TemporaryDirectory() as temporary:
        folder = pathlib.Path(temporary)
        for name, text in (("sensitivity", SENSITIVITY), ("sweep", SWEEP)):
            text = text.replace("SCENE", f"{source}/studies/scene_155mm.toml").replace("SOURCE", source)
            (folder / f"{name}.toml").write_text(text)
            study = folder / name
            subprocess.run([program, "study", folder / f"{name}.toml", "-o", study, "-q"], stdout=subprocess.DEVNULL,
                           stderr=subprocess.DEVNULL)
            page = (study / "ask.html").read_text()
            table = "surrogate" if name == "sweep" else "outputs"
            kinds.update(row["fit"] for row in json.loads((study / "study.json").read_text())[table])
            if "SAFE" in page or re.search(r"https?:|@import|<link|<iframe|<object|<img", page):
                faults.append(f"{name}: a word or a reference that the page must not have")
            more, refused = faults_of(program, study, name, page, folder)
            faults += more
            if refused == 0:
                faults.append(f"{name}: no point was refused")
    if not {"polynomial", "Gaussian process"} <= kinds:
        faults.append(f"fits are of {kinds} only")
    print("\n".join(faults))
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
