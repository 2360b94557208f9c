#!/bin/bash
# The Debian package on a bare Debian: a clean root is made and the package installed there with what it depends on. A user
# without rights outside his folder must get the first verdict within a minute, the same ones from every program of the
# package, and what the walkthroughs print; the manual page must be there, and nothing be left after
# removal. Root, and a network for the packages, are needed.
#
#     .ci/package && tests/app/deb.sh build/release/tests/app_tests build/package/launchsafe_*.deb
#
# Everything happens in a temporary folder. Ends with 77 where no clean root can be made.
set -euo pipefail

readonly skipped=77
say() { printf '%s\n' "== $*"; }
fail() {
  say "failed: $*"
  exit 1
}

((EUID == 0)) || { say "skipped: a clean root takes root"; exit "$skipped"; }
command -v mmdebstrap >/dev/null || { say "skipped: mmdebstrap is not installed"; exit "$skipped"; }
walkthroughs=$(realpath "$1")
[[ -f $2 ]] || { say "skipped: no package $2; .ci/package makes it"; exit "$skipped"; }
package=$(realpath "$2")

folder=$(mktemp -d)
root=$folder/root
clean_up() {
  if mountpoint -q "$root/proc"; then umount "$root/proc"; fi
  rm -rf --one-file-system "$folder"
}
trap clean_up EXIT

as_root() { chroot "$root" env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin DEBIAN_FRONTEND=noninteractive HOME=/root "$@"; }
as_user() { chroot --userspec=1000:1000 "$root" env -i --chdir=/home PATH=/usr/bin:/bin LC_ALL=C.UTF-8 HOME=/home "$@"; }
install_packages() {
  as_root apt-get -qq install -y --no-install-recommends "$@" >"$folder/install.log" 2>&1 ||
    { tail -n 20 "$folder/install.log"; fail "apt-get install $*"; }
}

say "a clean root"
mmdebstrap --quiet --variant=minbase bookworm "$root" >"$folder/mmdebstrap.log" 2>&1 ||
  { tail -n 20 "$folder/mmdebstrap.log"; fail "no clean root"; }
cp "$package" "$root/launchsafe.deb"
cp /etc/resolv.conf "$root/etc/resolv.conf" 2>/dev/null || true
mount -t proc proc "$root/proc"
chown 1000:1000 "$root/home"

say "install"
as_root apt-get -qq update
start=$SECONDS
install_packages /launchsafe.deb
say "after $((SECONDS - start)) s, with what it depends on; $(stat -c %s "$package") bytes"

say "which program this processor is given"
as_user launchsafe --version

say "the first verdict, without gnuplot"
main_job=/usr/share/launchsafe/studies/critical_gap_155mm.toml
start=$SECONDS
as_user launchsafe study $main_job -o results >"$folder/study.log" || (($? == 4)) || fail "the main job"
((SECONDS - start < 60)) || fail "the main job took $((SECONDS - start)) s"
say "after $((SECONDS - start)) s: $(tail -n 1 "$folder/study.log")"
verdicts() { grep -o '\<SAFE\|UNSAFE\|INDETERMINATE' "$root/home/$1/verdicts.csv"; }
verdicts results >"$folder/verdicts" || fail "no verdict"
grep -q 'gnuplot was not found' "$root/home/results/report.md" || fail "the page does not say why it has no pictures"

say "every program of the package gives the verdicts"
for architecture in x86-64 x86-64-v3 x86-64-v4; do
  as_user env LAUNCHSAFE_ARCHITECTURE=$architecture launchsafe study $main_job -o $architecture --quiet >"$folder/study.log" ||
    (($? == 4)) || fail "$architecture"
  as_user env LAUNCHSAFE_ARCHITECTURE=$architecture launchsafe --version | grep flags
  tail -n 1 "$folder/study.log"
  verdicts $architecture | cmp - "$folder/verdicts" || fail "other verdicts: $architecture"
done

say "the shipped scenes and studies"
for file in $(cd "$root" && grep -rLE '^(\[\[)?reference\b' --include='*.toml' usr/share/launchsafe/studies); do
  as_user launchsafe explain "/$file" >/dev/null || fail "$file"
done

say "manual page"
install_packages gnuplot-nox man-db
as_user man --warnings launchsafe >"$folder/manual" 2>"$folder/warnings" || fail "man launchsafe"
[[ ! -s $folder/warnings ]] || fail "the manual page: $(cat "$folder/warnings")"
grep -q 'launchsafe import-curve' "$folder/manual" || fail "the manual page lacks import-curve"

say "the walkthroughs"
TMPDIR=$root/tmp LAUNCHSAFE_ROOT=$root "$walkthroughs" --gtest_filter='Pages/Walkthrough.*' || fail "a walkthrough"

say "removal"
as_root apt-get -qq purge -y launchsafe >"$folder/purge.log" 2>&1 || fail "apt-get purge"
rm "$root/launchsafe.deb"
left=$(find "$root" -xdev -name '*launchsafe*')
[[ -z $left ]] || fail "left behind: $left"
say "passed"
