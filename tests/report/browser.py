#!/usr/bin/env python3
"""The shipped safety reports in a browser, on a phone, a laptop and A4 paper; needs chromium.

A copy of the page is laid out in a frame of each width by a script of this test, which measures it: nothing may reach
beyond the frame, no letter be smaller than 11 pixels on a screen, the answer fill one page of paper at the most where
nothing is accepted, every figure must say what it shows, text must stand out (WCAG 2.1, ratio 4.5), nothing may be
fetched, and markup in a title must be shown and not obeyed. Usage: browser.py LAUNCHSAFE SOURCE_DIR; 77 without chromium.
"""
import hashlib
import html
import json
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

# Width in CSS pixels; paper: 210 mm less the margins of 15 mm at both sides.
VIEWS = {"phone": (390, False), "tablet": (768, False), "laptop": (1280, False), "A4": (680, True)}
PAGE = 1031  # pixels: 297 mm less the margins of 12 mm
MARKUP = "<script>document.title='obeyed'</script><b>bold</b> & \"quotes\""

MEASURE = """
const channels = colour => (colour.match(/[0-9.]+/g) || []).map(Number);
const luminance = c => { const l = c.slice(0, 3).map(v => { v /= 255; return v <= .03928 ? v / 12.92 :
  Math.pow((v + .055) / 1.055, 2.4); }); return .2126 * l[0] + .7152 * l[1] + .0722 * l[2]; };
function background(element) {
  for (let e = element; e; e = e.parentElement) {
    const c = channels(getComputedStyle(e).backgroundColor);
    if (c.length && (c.length < 4 || c[3] > 0)) return c;
  }
  return [255, 255, 255];
}
function measure(frame) {
  const page = frame.contentDocument, width = frame.clientWidth, found = {wide: [], dim: [], mute: [], lowest: 99, smallest: 99};
  for (const e of page.body.querySelectorAll('*')) {
    const box = e.getBoundingClientRect(), style = frame.contentWindow.getComputedStyle(e);
    if (box.width === 0 || style.position === 'absolute' || e.closest('thead') && box.width < 2) continue;
    if (style.position !== 'absolute' && !(e.closest('thead') && getComputedStyle(e.closest('thead')).position ===
        'absolute') && (box.right > width + 1 || box.left < -1)) found.wide.push(e.tagName + ' ' + e.textContent.slice(0, 40));
    const own = [...e.childNodes].some(n => n.nodeType === 3 && n.textContent.trim());
    if (own) {
      found.smallest = Math.min(found.smallest, parseFloat(style.fontSize));
      const a = luminance(channels(style.color)), b = luminance(background(e));
      const ratio = (Math.max(a, b) + .05) / (Math.min(a, b) + .05);
      found.lowest = Math.min(found.lowest, ratio);
      if (ratio < 4.5) found.dim.push(e.tagName + ' ' + ratio.toFixed(2) + ' ' + e.textContent.slice(0, 40));
    }
    if (e.scrollWidth > e.clientWidth + 1 && style.overflowX !== 'visible') found.wide.push('scrolls: ' + e.tagName);
    if (e.tagName === 'IMG') {
      if (!(e.alt || '').trim() || !e.complete || e.naturalWidth === 0) found.mute.push(e.src.slice(0, 40));
    }
  }
  found.page = page.documentElement.scrollWidth;
  found.answer = page.getElementById('answer').getBoundingClientRect().bottom;
  found.title = page.title;
  found.scripts = page.scripts.length;
  found.bold = page.querySelectorAll('header b').length;
  found.images = page.images.length;
  return found;
}
"""


def chromium(arguments):
    return subprocess.run(["chromium", "--headless", "--no-sandbox", "--disable-gpu", "--virtual-time-budget=8000"]
                          + arguments, check=True, capture_output=True, text=True, timeout=120).stdout


def measured(page, folder, name):
    """What the script finds of a page in every view."""
    found = {}
    for view, (width, paper) in VIEWS.items():
        text = page.replace("@media print", "@media all") if paper else page
        frame = f"<iframe id='frame' style='border:0;width:{width}px;height:4000px' srcdoc='{html.escape(text)}'></iframe>"
        script = MEASURE + ("const frame = document.getElementById('frame'); frame.onload = () => setTimeout(() => {"
                            "document.getElementById('found').textContent = JSON.stringify(measure(frame)); }, 300);")
        file = folder / f"{name}_{view}.html"
        file.write_text(f"<!DOCTYPE html><meta charset='utf-8'><pre id='found'></pre>{frame}<script>{script}</script>")
        dom = chromium(["--dump-dom", "--window-size=1500,1000", f"file://{file}"])
        found[view] = json.loads(html.unescape(re.search(r"<pre id=\"found\">(.*?)</pre>", dom, re.S).group(1)))
    return found


def with_markup(study, folder):
    """A copy of a study whose title is markup, with the checksums that go with it."""
    copy = folder / "markup"
    shutil.copytree(study, copy)
    digest = lambda: hashlib.sha256((copy / "study.json").read_bytes()).hexdigest()
    before, results = digest(), json.loads((copy / "study.json").read_text())
    title, results["title"] = results["title"], MARKUP
    (copy / "study.json").write_text(json.dumps(results))
    manifest = json.loads((copy / "manifest.json").read_text().replace(before, digest()))
    # The study file that the manifest has asks for that title too: as TOML, whose strings are JSON's.
    asked, _, rest = manifest["input"].rpartition(f"'{title}'")
    manifest["input"] = asked + json.dumps(MARKUP) + rest
    manifest["input_sha256"] = hashlib.sha256(manifest["input"].encode()).hexdigest()
    (copy / "manifest.json").write_text(json.dumps(manifest))
    return copy


def main():
    if not shutil.which("chromium"):
        print("no chromium")
        return 77
    program, source = sys.argv[1], pathlib.Path(sys.argv[2])
    faults = []
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        pages = {each.name: (each / "report.html").read_text() for each in sorted(source.glob("reports/safety_*"))}
        study = with_markup(source / "reports/critical_gap_155mm", folder)
        subprocess.run([program, "report", study, "-o", folder / "out", "-q"], check=True, stdout=subprocess.DEVNULL)
        pages["markup"] = (folder / "out/report.html").read_text()
        for report, page in pages.items():
            external = [each for each in re.findall(r"(?:src|href|url)\s*[=(]\s*[\"']?([^\"')\s>]+)", page)
                        if not each.startswith(("data:", "#"))]
            if external or re.search(r"@import|<link|<iframe|<object", page):
                faults.append(f"{report}: external references {external[:3]}")
            for view, found in measured(page, folder, report).items():
                print(f"{report}, {view}: page {found['page']} wide, {found['images']} figures, "
                      f"lowest contrast {found['lowest']:.1f}")
                faults += [f"{report}, {view}: {what}: {found[what][:5]}" for what in ("wide", "dim", "mute") if found[what]]
                if found["page"] > VIEWS[view][0] + 1:
                    faults.append(f"{report}, {view}: the page is {found['page']} wide")
                paper = VIEWS[view][1]
                if not paper and found["smallest"] < 11:
                    faults.append(f"{report}, {view}: letters of {found['smallest']} pixels")
                # What somebody accepts stands on page one too, however much it is.
                if paper and report != "markup" and 'class="SAFE, accepted"' not in page and found["answer"] > PAGE:
                    faults.append(f"{report}, {view}: the answer takes {found['answer']} of {PAGE} pixels")
                if found["images"] == 0 or found["scripts"] or found["bold"] or "obeyed" == found["title"]:
                    faults.append(f"{report}, {view}: figures {found['images']}, scripts {found['scripts']}, {found['title']}")
                if report == "markup" and MARKUP not in found["title"]:
                    faults.append(f"{report}, {view}: the title is not shown: {found['title']}")
    print("\n".join(faults))
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
