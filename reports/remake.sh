#!/usr/bin/env bash
# Makes reports anew: reports/remake.sh PROGRAM TESTS [FOLDER ...], from the root of the project, on an idle machine. TESTS is
# the folder of the test programs. Prints the seconds that each folder took.
set -euo pipefail
program=$(realpath "$1")
tests=$(realpath "$2")
shift 2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

study() { "$program" study "studies/$1.toml" -o "$2" --quiet >/dev/null; }
report() { "$program" report "${@:2}" -o "reports/$1" --quiet && rm -f "reports/$1/manifest.json"; }
draw() {
  "$program" run "studies/$1.toml" -o "$work/$1" --quiet
  "$program" plot "$work/$1/$1.h5" --what "$2" --times "$3" -o "$4" --quiet
}

make() {
  case $1 in
    publication) python3 tests/publication/statements.py "$program" -o reports/publication ;;
    finite_elements) python3 tests/finite_elements/compare.py "$program" -o reports/finite_elements ;;
    error_of_parts) "$tests/error_of_parts" reports/error_of_parts ;;
    pictures)
      draw combustion_040 combustion,fields "18.5 ms" reports/pictures
      draw table8_fields fields,profile "10, 18 ms" reports/pictures
      ;;
    safety_155mm)
      study safety_155mm "$work/envelope"
      report safety_155mm "$work/envelope" reports/{accuracy,sweep,sensitivity,stability}
      ;;
    safety_105mm)
      study critical_gap_105mm "$work/fictitious"
      report safety_105mm "$work/fictitious"
      ;;
    *) study "$1" "reports/$1" && rm -rf "reports/$1"/{cases,study.db*,study.lock} ;;
  esac
}

(($# > 0)) || set -- critical_gap_155mm publication calibrate_table8 accuracy accuracy_coarse sweep sweep_flaws sensitivity \
  stability pictures safety_155mm safety_105mm finite_elements error_of_parts
for folder in "$@"; do
  begin=$SECONDS
  rm -rf "reports/$folder"
  make "$folder"
  echo "$folder $((SECONDS - begin))"
done
