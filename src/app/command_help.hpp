// The words of --help.
#pragma once

namespace launchsafe::app {

inline constexpr const char* description =
    "launchsafe: how thick may the gap under an explosive charge be before a launch can ignite it?\n"
    "Simulates shells under launch loads by the material point method.";

inline constexpr const char* footer = R"(
Examples:
  launchsafe run studies/scene_155mm.toml -o results
  launchsafe study studies/critical_gap_155mm.toml -o results --jobs 2
  launchsafe status results
  launchsafe merge sweep.toml -o results shard-1 shard-2
  launchsafe emit slurm sweep.toml -o results --shards 20
  launchsafe ask results --set load.peak="510 MPa"
  launchsafe verify
  launchsafe explain studies/scene_155mm.toml
  launchsafe plot results/scene_155mm.h5
  launchsafe init --calibre "105 mm" -o shell
  launchsafe import-curve gauge.csv -o pressure.csv
  launchsafe report results -o safety

Results go to stdout, progress and messages to stderr. Nothing is written but what --output names, the
picture of explain --grid, and the pictures of plot.
Exit codes: 0 done, 2 bad usage or input, 3 some cases or checks failed, 4 a verdict is indeterminate,
70 the machine or the program failed (memory, disk, internal error), 75 interrupted.)";

inline constexpr const char* run_footer = R"(
Examples:
  launchsafe run studies/scene_155mm.toml                print the table, write nothing
  launchsafe run studies/scene_155mm.toml -o results     write results/scene_155mm.h5 as well
  launchsafe run studies/scene_155mm.toml --json --quiet > case.json

A file with the result of another input is never overwritten.)";

inline constexpr const char* study_footer = R"(
Examples:
  launchsafe study studies/critical_gap_155mm.toml -o results
  launchsafe study studies/critical_gap_155mm.toml -o results --jobs 2 --json > study.json
  launchsafe study sweep.toml -o results --dry-run           the runs it needs, why, and their cost
  launchsafe study sweep.toml -o results --memory 8GB --time-limit 30min
  launchsafe study sweep.toml -o results --until 06:00       stop then; the same command goes on
  launchsafe study sweep.toml -o results --update            after a change of the study
  launchsafe study studies/critical_gap_155mm.toml -o results --tolerance 5K
                                                             the cheapest numerics that know T max to 5 K
  launchsafe study sweep.toml -o results --shard 2/4         one of four processes; then launchsafe merge

Every mechanical run is kept in DIR as soon as it ends: after an interruption, a kill or a full disk the same
command goes on where it was. What did not change is not computed again.)";

inline constexpr const char* status_footer = R"(
Examples:
  launchsafe status results                      one study, or all shards that use its folder, as in Slurm
  launchsafe status shard-1 shard-2              shards with folders of their own
  launchsafe status results --watch

It reads what the study tells in DIR every second, and never its results: it may be asked on another machine that
sees DIR, also while the study runs. DIR/index.html says the same in a browser. When a study will end is an estimate
from the runs so far. Critical gaps are preliminary, of ignition alone. The exit code is that of a study that has
ended (75 where it was killed), and 0 while it runs.)";

inline constexpr const char* merge_footer = R"(
Examples:
  launchsafe merge sweep.toml -o results                     shards that all used results
  launchsafe merge sweep.toml -o results shard-1 shard-2     shards with folders of their own

The report is the one that a single `launchsafe study` writes. Where runs are missing they are listed, and there
is no report.)";

inline constexpr const char* emit_footer = R"(
Examples:
  launchsafe emit slurm sweep.toml -o results --shards 20 --jobs 4 --memory 8GB
  launchsafe emit slurm sweep.toml -o results --shards 20 --sbatch=--partition=long
  sh results/slurm/submit.sh                                 submits an array job, and a merge that waits for it

The scripts are written to results/slurm. --memory is what each shard asks Slurm for.)";

inline constexpr const char* ask_footer = R"(
Examples:
  launchsafe ask results                                                 the launch of the study's scene
  launchsafe ask results --set load.peak="510 MPa" --set initial_temperature="305 K" --gap "0.25 mm"
  launchsafe ask results --set load.peak="480, 490, 500, 510 MPa" --set initial_temperature="290, 300, 310 K" --csv

Nothing is computed: the answer is a prediction, with the error of the fit found at launches that it has not seen. A
launch beyond those that were computed is refused. A prediction is never SAFE.)";

inline constexpr const char* verify_footer = R"(
Examples:
  launchsafe verify                      every check
  launchsafe verify --filter jwl         those with "jwl" in their name)";

inline constexpr const char* explain_footer = R"(
Examples:
  launchsafe explain studies/scene_155mm.toml            physics in and out, grid, steps, time, memory
  launchsafe explain studies/scene_155mm.toml --grid grid.svg
                                                         draws bodies, grid and observation points as well
  launchsafe explain studies/critical_gap_155mm.toml     the runs that the study needs
  launchsafe explain --keys                              every key of a scene file
  launchsafe explain --results critical_gap              columns of results that begin so, with their meaning

Nothing is overwritten: a FILE.svg that holds something else is refused.)";

inline constexpr const char* report_footer = R"(
Examples:
  launchsafe report results -o safety
  launchsafe report results sweep accuracy sensitivity models stability -o safety
  launchsafe report results -o safety --criterion "margin >= 2 uncertainty" --criterion-source "works standard 12"

STUDY_DIR is what launchsafe study wrote with -o DIR, finished or not, with or without its case files. The report is
about the study of kind critical-gap (without one, the sweep); accuracy, sweep, sensitivity, comparison and stability
studies of the same shell add their sections. Histories, profile and temperature field need the case files.

Written are report.html, report.md, report.json, the figures as SVG, and manifest.json, by which the files are known.

--criterion: a largest gap is recommended only under a criterion that you state with its source; none is built in.
  margin >= N uncertainty     N at least 1; the margin to the ignition temperature over its uncertainty
  margin >= N K
  distance >= N uncertainty   the distance to the critical gap over the uncertainty of that
  distance >= N cm
  Several are joined by "and". SAFE is asked for as well, of the gap and of all smaller ones. Only computed gaps count.

--templates: a folder with any of report.html.mustache, report.md.mustache and texts.mustache; what it lacks stays as
built in. The built-in ones are in src/report/templates, where texts.mustache says how to translate it.
The exit code is 0 once the report was written, whatever its verdicts say.)";

inline constexpr const char* plot_footer = R"(
Examples:
  launchsafe plot results/scene_155mm.h5                 all pictures, to results/scene_155mm_pictures
  launchsafe plot results/scene_155mm.h5 -o pictures --what pressure,histories
  launchsafe plot results/scene_155mm.h5 --what fields --times "10, 18 ms"
  launchsafe plot results/scene_155mm.h5 --csv -o numbers

Pictures are SVG files drawn by gnuplot, numbers CSV files without it; share/launchsafe/studies/pictures_and_reports.md
tells which there are of every kind. Snapshots are what output.snapshots and output.snapshot_events of the scene ask
for. Nothing is overwritten: a picture whose place holds something else is refused, and then none is written.)";

inline constexpr const char* init_footer = R"(
Examples:
  launchsafe init --calibre "105 mm" -o shell                            the analytic load of 496 MPa
  launchsafe init --calibre "105 mm" --peak "380 MPa" -o shell
  launchsafe init --calibre "105 mm" --curve pressure.csv -o shell       a measured load

Writes shell/scene.toml and shell/critical_gap.toml, with comments, and what they rest on. The shell is the 155 mm one,
scaled: lengths are to be replaced by those of a drawing. Nothing is overwritten.)";

inline constexpr const char* import_curve_footer = R"(
Examples:
  launchsafe import-curve gauge.csv                                      what the record holds
  launchsafe import-curve gauge.csv -o pressure.csv                      the cleaned curve, and pressure.svg
  launchsafe import-curve gauge.csv -o pressure.csv --pressure "P breech" --offset "0.3 MPa"

Headers such as Time (ms);P breech (bar). A semicolon, a tab or a comma stands between columns; decimal commas are
read.
Noise stays in the curve: load.smoothing of the scene averages it, and counts what that takes. Nothing is overwritten.)";

}  // namespace launchsafe::app
