#!/bin/bash
# The JSON schemas of scenes and studies by an independent reader, @taplo/cli of npm: every shipped file must pass, and files
# with a fault must not.
#
#     tests/app/schema.sh build/release/launchsafe studies
#
# Everything happens in a temporary folder. Ends with 77 where there is no npm to install the reader with.
set -euo pipefail

readonly skipped=77
program=$(realpath "$1")
studies=$(realpath "$2")
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

say() { printf '%s\n' "== $*"; }
command -v npm >/dev/null || { say "skipped: npm is not installed"; exit "$skipped"; }
npm install --silent --prefix "$folder/npm" @taplo/cli@0.7.0 >"$folder/npm.log" 2>&1 ||
  { tail -n 5 "$folder/npm.log"; say "failed: @taplo/cli cannot be installed"; exit 1; }
for what in scene study references; do "$program" explain --schema $what >"$folder/$what.schema.json"; done

check() { "$folder/npm/node_modules/.bin/taplo" check --schema "file://$folder/$1.schema.json" "$2" >"$folder/log" 2>&1; }
# A study names a kind; a file of what is published has nothing else.
schema_for() {
  if grep -q '^kind' "$1"; then echo study; elif grep -q '^\(\[\[\)\?reference\b' "$1"; then echo references; else echo scene; fi
}

failed=0 passed=0
while IFS= read -r file; do
  if check "$(schema_for "$file")" "$file"; then
    passed=$((passed + 1))
  else
    failed=$((failed + 1))
    say "refused: $file"
    grep -v INFO "$folder/log"
  fi
# A table of decompositions ships and is no file of the user's.
done < <(find "$studies" -name '*.toml' ! -name decomposition.toml | sort)
say "$passed shipped files pass, $failed do not"

# broken SCHEMA NAME TEXT: the text is refused.
broken() {
  printf '%s\n' "$3" >"$folder/broken.toml"
  if check "$1" "$folder/broken.toml"; then
    failed=$((failed + 1))
    say "passes, though it has $2"
  fi
}
body='body = [ { name = "charge", material = "charge", x = "0 to 10 cm", r = "0 to 2 cm" } ]'
broken scene "an unknown key" "$body
pressure = 3"
broken scene "a number without its unit" "$body
load.peak = 496"
broken scene "a unit of something else" "$body
load.peak = \"496 mm\""
broken scene "an unknown word" "$body
symmetry = \"round\""
broken scene "a text in the place of a flag" "$body
load.rescale_to_peak = \"yes\""
broken scene "a body without a material" 'body = [ { name = "charge", x = "0 to 10 cm", r = "0 to 2 cm" } ]'
broken scene "a share above its range" "$body
numerics.pic_fraction = 2"
broken scene "faces without a condition" "$body
interface.wall.friction = 0.1"
broken study "no scene" 'kind = "critical-gap"'
broken study "an unknown kind" 'kind = "magic"
scene = "a.toml"'
broken study "a change of an unknown key" 'kind = "critical-gap"
scene = "a.toml"
set.load.peek = "3 MPa"'
broken study "a list with a wrong unit" 'kind = "critical-gap"
scene = "a.toml"
gaps = "0, 1 MPa"'
broken references "a row without a gap" '[[reference]]
spread = "3 K"'
((failed == 0))
