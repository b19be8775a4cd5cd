#!/usr/bin/env bash
# Installs everything that building, testing and running Pneuma needs on Debian 12, without questions.
#   packaging/install-dependencies.sh [--style | --full]
# --style: and what looks at the style of sources, as continuous integration does. --full: and what fuzzes, counts lines
# that tests run, looks at packages and schedules jobs (`packaging/test.sh --full`).
# The packages are those of cmake/Dependencies.cmake, the compiler, and a software display.
# Does nothing, in a moment, where all of them are there already.
set -euo pipefail

packages=(
  # compiler and build
  g++ cmake ninja-build git
  # values, threads, nearest neighbours
  libeigen3-dev libtbb-dev libnanoflann-dev
  # surfaces, pictures, window
  libcgal-dev libopencv-dev libvtk9-dev libvtk9-qt-dev qtbase5-dev libqt5svg5-dev
  # the part of the window that knows no widget is compiled against Qt 6 too
  qt6-base-dev
  # CT: DICOM series, zips of them, compressed volumes
  libvtk-dicom-dev libarchive-dev zlib1g-dev
  # command line, reports (JSON, PDF), hashes of inputs
  libcli11-dev nlohmann-json3-dev libhpdf-dev libssl-dev
  # tests and benchmarks, some with decimal commas
  libgtest-dev libgmock-dev libbenchmark-dev locales
  # cohorts: the workflow's engine, tables and plots
  snakemake python3-h5py python3-matplotlib
  # packages: cpack looks for what programs link
  dpkg-dev file
  # a display without a screen, OpenGL in software, the font of pictures and window
  xvfb xauth libgl1-mesa-dri libgl1-mesa-dev fonts-inter
)

case ${1:-} in
  '') ;;
  --style | --full) packages+=(clang-format codespell desktop-file-utils) ;;&
  --full) packages+=(clang-19 llvm-19 libclang-rt-19-dev gcovr lintian appstream flatpak-builder slurmctld slurmd slurm-client munge) ;;
  --style) ;;
  *)
    echo "install-dependencies: there is no option '$1'; usage: packaging/install-dependencies.sh [--style | --full]" >&2
    exit 2
    ;;
esac

missing=()
for package in "${packages[@]}"; do
  status=$(dpkg-query --show --showformat='${db:Status-Status}' "$package" 2>/dev/null || true)
  [[ $status == installed ]] || missing+=("$package")
done
if ((${#missing[@]} == 0)); then
  echo "install-dependencies: all ${#packages[@]} packages are installed"
  exit 0
fi

as_root=()
if ((EUID != 0)); then
  if ! command -v sudo >/dev/null; then
    echo "install-dependencies: run this as root, or install sudo; missing: ${missing[*]}" >&2
    exit 1
  fi
  as_root=(sudo)
fi

apt_get() {
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -q -y -o Dpkg::Use-Pty=0 "$@" </dev/null
}

echo "install-dependencies: installing ${missing[*]}"
apt_get update
apt_get install --no-install-recommends "${missing[@]}"
