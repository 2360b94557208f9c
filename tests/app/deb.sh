#!/bin/bash
# The Debian package on a bare Debian: a clean root is made, the package is installed there with what it depends on, and the
# program must run the main job within a minute, find its manual page, its completion and its schemas, and be removed
# without a trace. Root, and a network for the packages, are needed.
#
#     .ci/package && tests/app/deb.sh build/package/launchsafe_*.deb
#
# Everything happens in a temporary folder. Ends with 77 where no clean root can be made.
set -euo pipefail

readonly skipped=77
package=$(realpath "$1")

say() { printf '%s\n' "== $*"; }
fail() {
  say "failed: $*"
  exit 1
}

((EUID == 0)) || { say "skipped: a clean root takes root"; exit "$skipped"; }
command -v mmdebstrap >/dev/null || { say "skipped: mmdebstrap is not installed"; exit "$skipped"; }

folder=$(mktemp -d)
trap 'rm -rf --one-file-system "$folder"' EXIT
root=$folder/root

say "a clean root"
mmdebstrap --quiet --variant=minbase --include=bash-completion bookworm "$root" >"$folder/mmdebstrap.log" 2>&1 ||
  { tail -n 20 "$folder/mmdebstrap.log"; fail "no clean root"; }
cp "$package" "$root/tmp/launchsafe.deb"
cp /etc/resolv.conf "$root/etc/resolv.conf" 2>/dev/null || true
inside() { chroot "$root" /usr/bin/env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin DEBIAN_FRONTEND=noninteractive HOME=/root "$@"; }

say "install"
inside apt-get -qq update
inside apt-get -qq install -y --no-install-recommends /tmp/launchsafe.deb >"$folder/install.log" 2>&1 ||
  { tail -n 20 "$folder/install.log"; fail "apt-get install"; }
mount --bind /proc "$root/proc" 2>/dev/null && trap 'umount "$root/proc"; rm -rf --one-file-system "$folder"' EXIT

say "which program this processor is given"
inside launchsafe --version

say "the first verdict"
start=$SECONDS
inside launchsafe study /usr/share/launchsafe/studies/critical_gap_155mm.toml -o /root/results --quiet \
  >"$folder/study.log" || (($? == 4)) || fail "the main job"
((SECONDS - start < 60)) || fail "the main job took $((SECONDS - start)) s"
say "after $((SECONDS - start)) s: $(grep -m 1 'critical gap is' "$folder/study.log")"
grep -q 'SAFE' "$root/root/results/verdicts.md" || fail "no verdict"

say "every choice of program gives the verdicts"
for architecture in x86-64 x86-64-v3 x86-64-v4; do
  inside env LAUNCHSAFE_ARCHITECTURE=$architecture launchsafe study /usr/share/launchsafe/studies/critical_gap_155mm.toml \
    -o "/root/$architecture" --quiet >/dev/null || (($? == 4)) || fail "$architecture"
  cut -d, -f1-7,8 "$root/root/$architecture/verdicts.csv" | head -n 2
  cmp <(grep -o 'SAFE\|UNSAFE\|INDETERMINATE' "$root/root/results/verdicts.csv") \
    <(grep -o 'SAFE\|UNSAFE\|INDETERMINATE' "$root/root/$architecture/verdicts.csv") || fail "other verdicts: $architecture"
done

say "manual page, completion, schemas"
[[ -s $root/usr/share/man/man1/launchsafe.1.gz || -s $root/usr/share/man/man1/launchsafe.1 ]] || fail "no manual page"
inside bash -c '. /usr/share/bash-completion/completions/launchsafe; COMP_WORDS=(launchsafe st); COMP_CWORD=1; _launchsafe; [[ ${COMPREPLY[*]} == study ]]' ||
  fail "no completion"
for schema in scene study; do
  cmp "$root/usr/share/launchsafe/schema/$schema.schema.json" <(inside launchsafe explain --schema $schema) || fail "schema"
done

say "removal"
inside apt-get -qq purge -y launchsafe >/dev/null
[[ -z $(find "$root/usr" -name '*launchsafe*') ]] || fail "left behind: $(find "$root/usr" -name '*launchsafe*')"
say "passed"
