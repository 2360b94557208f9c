#!/usr/bin/env python3
"""report.json of many studies against its schema, by Debian's python3-jsonschema, and broken reports that must not pass.

The reports are of every shipped study, of all of them at once, of a study that is half done, and of one that is
indeterminate in every row. Usage: schema.py LAUNCHSAFE SOURCE_DIR; 77 without the validator.
"""
import copy
import hashlib
import json
import pathlib
import shutil
import subprocess
import sys
import tempfile

CRITERION = ["--criterion", "margin >= 2 uncertainty", "--criterion-source", "a standard"]


def indeterminate(results):
    """The results of a study whose runs all failed."""
    for row in results["verdicts"]:
        row.update(verdict="INDETERMINATE", reason="the run failed")
        row.update({key: None for key, value in row.items() if key.endswith("_K") or isinstance(value, float)
                    and key not in ("gap_cm", "peak_pressure_MPa", "crack_radius_um", "flaw_size_mm")})
    for row in results["cases"]:
        row.update({key: None for key in row if key.endswith("_cm")}, critical_gap_kind="indeterminate")
        row.update(critical_gap_reads_as="indeterminate", reason="the run failed", coupled_runs="not confirmed")
    for row in results["runs"]:
        row.update(status="failed", energy_drift=None)
    results["coupled_runs"] = []


def changed(study, copied, change):
    """A copy of a study with other results, and the checksums that go with them."""
    shutil.copytree(study, copied)
    manifest, file = json.loads((copied / "manifest.json").read_text()), copied / "study.json"
    if change is None:
        manifest["files"] = []
    else:
        results = json.loads(file.read_text())
        change(results)
        file.write_text(json.dumps(results))
        for each in manifest["files"]:
            each["sha256"] = hashlib.sha256((copied / each["name"]).read_bytes()).hexdigest()
    (copied / "manifest.json").write_text(json.dumps(manifest))
    return copied


def broken(report):
    """Reports with one fault each."""
    def without(*keys):
        made = copy.deepcopy(report)
        target = made
        for key in keys[:-1]:
            target = target[key]
        del target[keys[-1]]
        return made

    def other(value, *keys):
        made = copy.deepcopy(report)
        target = made
        for key in keys[:-1]:
            target = target[key]
        target[keys[-1]] = value
        return made

    yield "no format", without("format")
    yield "another format", other("launchsafe safety report 4", "format")
    yield "no recommended gap", without("answer", "recommended_gap_cm")
    yield "a gap as text", other("0.02 cm", "answer", "largest_safe_gap_cm")
    yield "a gap beside the others", other(0.02, "answer", "allowed_gap_cm")
    yield "an unknown kind of gap", other("safe", "answer", "cases", 0, "critical_gap_kind")
    yield "an unknown section", other("more", "sections", 0, "id")
    yield "a block without an origin", without("sections", 0, "blocks", 0, "origin")
    yield "a block of no kind", other("note", "sections", 0, "blocks", 0, "kind")


def main():
    try:
        import jsonschema
    except ImportError:
        print("no jsonschema (apt-get install python3-jsonschema)")
        return 77
    program, source = sys.argv[1], pathlib.Path(sys.argv[2])
    schema = json.loads((source / "src/report/templates/report.schema.json").read_text())
    jsonschema.Draft202012Validator.check_schema(schema)
    validator = jsonschema.Draft202012Validator(schema)
    faults = []
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        by_kind = {}
        for manifest in sorted(source.glob("reports/*/manifest.json")):
            study = manifest.parent / "study.json"
            if study.exists():
                by_kind.setdefault(json.loads(study.read_text())["kind"], manifest.parent)
        main_job = source / "reports/critical_gap_155mm"
        by_kind["critical-gap"], by_kind["accuracy"] = main_job, source / "reports/accuracy"
        together = [by_kind[kind] for kind in ("critical-gap", "accuracy", "sensitivity", "stability")]
        together.append(source / "reports/sweep_pressure_defect")
        reports = {kind: [study] for kind, study in by_kind.items()}
        reports["several kinds"] = together
        reports["several kinds under a criterion"] = together + CRITERION
        reports["a criterion and no verdicts"] = [by_kind["accuracy"]] + CRITERION
        reports["half done"] = [changed(main_job, folder / "half", None)]
        reports["half done beside finished ones"] = [folder / "half"] + together[1:]
        reports["indeterminate"] = [changed(main_job, folder / "none", indeterminate)] + CRITERION
        for number, (what, arguments) in enumerate(reports.items()):
            out = folder / f"report{number}"
            run = subprocess.run([program, "report", *arguments, "-o", out, "-q"], capture_output=True, text=True)
            if run.returncode != 0:
                faults.append(f"{what}: the program ended with {run.returncode}: {run.stderr.strip()}")
                continue
            report = json.loads((out / "report.json").read_text())
            errors = [f"{what}: {error.json_path}: {error.message[:200]}" for error in validator.iter_errors(report)]
            faults += errors[:5]
            print(f"{what}: {len(report['sections'])} sections, {len(errors)} faults")
            if what in ("half done", "indeterminate") and report["answer"]["largest_safe_gap_cm"] is not None:
                faults.append(f"{what}: a gap is called safe")
            if what != "several kinds":
                continue
            faults += [f"passes, though it has {fault}" for fault, made in broken(report) if validator.is_valid(made)]
    print("\n".join(faults))
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
