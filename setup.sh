#!/usr/bin/env bash
# Installs what launchsafe needs to be built and to draw its plots (Debian 12); with --tests or --package also what its
# tests need, or its Debian package. Silent when nothing is missing.
set -euo pipefail

packages=(
  g++ cmake ninja-build make
  libeigen3-dev libboost-dev libtbb-dev libhdf5-dev libsqlite3-dev libssl-dev libcli11-dev libfmt-dev libtomlplusplus-dev nlohmann-json3-dev
  libkainjow-mustache-dev
  gnuplot-nox
)
case "${1:-}" in
  "") ;;
  --tests) packages+=(libgtest-dev libbenchmark-dev librapidcheck-dev) ;;
  --package) packages+=(file help2man) ;; # file tells cpack what is a program
  *)
    echo "setup.sh: unknown option $1; there are --tests and --package" >&2
    exit 2
    ;;
esac

if ! command -v dpkg-query >/dev/null || ! command -v apt-get >/dev/null; then
  echo "setup.sh: this is no Debian system; install what matches these Debian packages: ${packages[*]}" >&2
  exit 1
fi

# dpkg-query fails when it does not know one of the packages, which only means that it is missing.
installed=$(dpkg-query --show --showformat='${db:Status-Status} ${Package}\n' "${packages[@]}" 2>/dev/null || true)
missing=()
for package in "${packages[@]}"; do
  grep -qx "installed $package" <<<"$installed" || missing+=("$package")
done
((${#missing[@]} == 0)) && exit 0

as_root=(env DEBIAN_FRONTEND=noninteractive)
if ((EUID != 0)); then
  if ! command -v sudo >/dev/null; then
    echo "setup.sh: missing packages, and neither root nor sudo to install them: ${missing[*]}" >&2
    exit 1
  fi
  as_root=(sudo "${as_root[@]}")
fi

echo "setup.sh: installing ${missing[*]}" >&2
"${as_root[@]}" apt-get -o DPkg::Lock::Timeout=300 -qq update
"${as_root[@]}" apt-get -o DPkg::Lock::Timeout=300 -qq install -y --no-install-recommends "${missing[@]}"
