# SPDX-License-Identifier: MIT
# Sourced by app/run.sh and tests/run.sh: Debian packages, configuration, build. Idempotent: what is
# installed and built already is left alone. Needs $root; uses $MOTE_BUILD (default $root/build/release).
say() { printf 'mote: %s\n' "$*" >&2; }

mote_packages="g++ cmake ninja-build ccache pkg-config
  libvulkan-dev mesa-vulkan-drivers glslang-dev glslang-tools spirv-tools libspirv-cross-c-shared-dev
  libglm-dev libopencolorio-dev libtomlplusplus-dev libcli11-dev nlohmann-json3-dev libfmt-dev
  libglfw3-dev libimgui-dev
  libpng-dev libopenexr-dev zlib1g-dev liblzma-dev libzstd-dev libpugixml-dev"
mote_test_packages="libgtest-dev libgmock-dev vulkan-validationlayers xvfb xdotool"

# install_packages NAME...: those that are missing, with apt-get; sudo if not root.
install_packages() {
  missing=""
  for package in "$@"; do
    if [ "$(dpkg-query -W -f='${db:Status-Status}' "$package" 2>/dev/null)" != installed ]; then missing="$missing $package"; fi
  done
  [ -z "$missing" ] && return 0
  if ! command -v apt-get >/dev/null 2>&1; then
    say "these packages are missing and there is no apt-get here:$missing"
    say "install your system's packages of the same libraries, then run cmake --preset release && cmake --build --preset release"
    exit 1
  fi
  sudo=""
  if [ "$(id -u)" != 0 ]; then
    command -v sudo >/dev/null 2>&1 || { say "not root and no sudo; as root run: apt-get install$missing"; exit 1; }
    sudo=sudo
  fi
  say "installing:$missing"
  $sudo apt-get update -qq || { say "apt-get update failed: is there a network?"; exit 1; }
  # shellcheck disable=SC2086
  $sudo env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends $missing >/dev/null ||
    { say "apt-get could not install:$missing"; exit 1; }
}

# build TESTS(ON|OFF) [TARGET...]
build() {
  tests=$1
  shift
  build_dir=${MOTE_BUILD:-$root/build/release}
  werror=OFF
  [ "${CI:-}" = true ] && werror=ON
  # Configure once, and again when this script is newer or another set of options is wanted; ninja does the rest.
  stamp="$build_dir/configured-tests-$tests-werror-$werror"
  if [ ! -f "$build_dir/build.ninja" ] || [ ! -f "$stamp" ]; then
    rm -f "$build_dir"/configured-*
    cmake -S "$root" -B "$build_dir" -G Ninja -DCMAKE_BUILD_TYPE=Release -DMOTE_BUILD_TESTS="$tests" -DMOTE_WERROR="$werror" >&2
    : >"$stamp"
  fi
  cmake --build "$build_dir" ${1:+--target "$@"} >&2
}
