#!/usr/bin/env bash
# Breaks ten laws, one by one, in a copy of the sources, and runs the tests of the modules that compute: every slip must
# turn at least one of them red. A quarter of an hour: ctest --test-dir build/release -L broken-laws
#   broken_laws.sh SOURCE_DIR BUILD_DIR     BUILD_DIR is made; what it holds of an earlier run is used again
set -euo pipefail
source_dir=$(realpath "$1") build_dir=$2
test_programs=(materials_tests surface_tests mpm_tests)

# what is wrong | file | the command of sed that makes it so
slips=(
  "Johnson-Cook: rates count from 0.99 of the reference rate|steel.hpp|s/plastic_rate \/ Real(k.reference_rate)/plastic_rate \/ Real(0.99 * k.reference_rate)/"
  "Mie-Grueneisen: 1 - s instead of s - 1, as printed|mie_gruneisen.hpp|s/a = Real(1.0) - Real(m.slope - 1.0) \* x/a = Real(1.0) - Real(1.0 - m.slope) * x/"
  "JWL: thermal pressure of the isentrope with V^-w|jwl.hpp|s/Real(thermal) \* pow(v, Real(-1.0 - m.omega))/Real(thermal) * pow(v, Real(-m.omega))/"
  "VLW: T*^4 for T*^(1/4)|vlw.cpp|s/std::pow(reduced, 0.25)/std::pow(reduced, 4.0)/"
  "Visco-SCRAM: stress relaxes one per cent faster|visco_scram.cpp|s/decay = std::exp(-x)/decay = std::exp(-1.01 * x)/"
  "crack growth: speed at K' off by the exponent's one|visco_scram.hpp|s/slow_speed = 1.0 \/ (1.0 + half_exponent_)/slow_speed = 1.0 \/ half_exponent_/"
  "toughness: friction between crack faces without its square|visco_scram.hpp|s/Real(pi) \* ratio \* (Real(1.0) + ratio)/Real(pi) * ratio/"
  "kinetics: activation temperature one per mille too large|kinetics.hpp|s/-k.activation_temperature \/ temperature/-1.001 * k.activation_temperature \/ temperature/"
  "exchange with the air: the air's specific heat for the charge's|skin.cpp|s/s.skin_thickness \* model.specific_heat/s.skin_thickness * s.air.specific_heat/"
  "conduction: whole cells between two bodies instead of half ones|conduction.cpp|s/0.5 \* (la.length_x/(la.length_x/"
)

copy=$build_dir/source
mkdir -p "$copy"
# A file keeps its time, so that only what a slip changes is compiled again.
cp --recursive --preserve=timestamps "$source_dir"/{CMakeLists.txt,.cmake,include,src,studies,reports,tests} "$copy"
cmake -S "$copy" -B "$build_dir/build" -G Ninja -D CMAKE_BUILD_TYPE=Release -D CMAKE_CXX_FLAGS_RELEASE="-O1 -DNDEBUG" >/dev/null

run_tests() {
  cmake --build "$build_dir/build" --target "${test_programs[@]}" >/dev/null || { echo "does not compile" >&2; exit 1; }
  for program in "${test_programs[@]}"; do
    (cd "$copy" && "$build_dir/build/tests/$program" --gtest_filter=-*Slow* --gtest_brief=1) || return 1
  done
}

run_tests >"$build_dir/sound.txt" || { echo "tests are red without a slip: $build_dir/sound.txt" >&2; exit 1; }
missed=0
for slip in "${slips[@]}"; do
  IFS='|' read -r name file change <<<"$slip"
  path=$(find "$copy/include" "$copy/src" -name "$file")
  cp --preserve=timestamps "$path" "$build_dir/whole"
  sed --in-place "$change" "$path"
  if cmp --quiet "$path" "$build_dir/whole"; then echo "$name: $file no longer has what it changes" >&2; exit 1; fi
  if run_tests >"$build_dir/broken.txt"; then
    echo "NOT SEEN  $name"
    missed=$((missed + 1))
  else
    echo "red       $name ($(grep --count '^\[  FAILED  \]' "$build_dir/broken.txt") lines FAILED, first $(grep --max-count=1 --only-matching '^\[  FAILED  \] [^ ,]*' "$build_dir/broken.txt"))"
  fi
  cp --preserve=timestamps "$build_dir/whole" "$path"
  touch "$path"
done
echo "${#slips[@]} slips, $missed not seen"
exit $((missed > 0))
