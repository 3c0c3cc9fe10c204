#!/usr/bin/env bash
# The Debian packages: names, versions, what they need, and what lies in which.
# usage: packages.sh BUILD CPACK
set -euo pipefail
build=$1 cpack=$2
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
fail() { echo "packages: $*" >&2; exit 1; }

(cd "$build" && "$cpack" -G DEB -B "$scratch" >"$scratch/log") || { cat "$scratch/log"; exit 1; }
cd "$scratch"
shopt -s nullglob
program=(muster_[0-9]*.deb) dev=(muster-dev_*.deb) python=(python3-muster_*.deb)  # the last where the build has it
((${#program[@]} == 1 && ${#dev[@]} == 1)) || fail "made $(echo ./*.deb)"
field() { dpkg-deb -f "$1" "$2"; }
version=$(field "${program[0]}" Version)

for package in "${program[0]}" "${dev[0]}" "${python[@]}"; do
  dpkg-deb -I "$package" >/dev/null
  [[ $(field "$package" Architecture) == $(dpkg --print-architecture) ]] || fail "$package: $(field "$package" Architecture)"
  [[ -n $(field "$package" Description) && -n $(field "$package" Maintainer) ]] || fail "$package has no description"
  dpkg-deb -c "$package" >list
  # Owned by root, writable by it alone, and below /usr.
  if awk '$2 != "root/root" || $1 ~ /^[-d].......w/ || $1 ~ /^[-d]....w/' list | grep .; then fail "$package: owners or modes"; fi
  if awk '{ print $6 }' list | grep -vE '^\./(usr/.*)?$'; then fail "$package: files outside of /usr"; fi
  grep -qE "\./usr/share/doc/$(field "$package" Package)/copyright$" list || fail "$package has no copyright"
  grep -qE "\./usr/share/doc/$(field "$package" Package)/changelog.Debian.gz$" list || fail "$package has no changelog"
done

needs=$(field "${program[0]}" Depends)
for library in libc6 libstdc++6 libfmt libtbb libtinyxml2 libsimbody; do
  grep -qF "$library" <<<"$needs" || fail "muster does not depend on $library: $needs"
done
grep -qF "muster (= $version)" <<<"$(field "${dev[0]}" Depends)" || fail "muster-dev: $(field "${dev[0]}" Depends)"

dpkg-deb -c "${program[0]}" >list
for file in bin/muster lib/muster/muster_exam lib/muster/plugins/radio_multiwall.so lib/muster/plugins/models/scarab.urdf \
  share/muster/worlds/connectivity/world.xml share/muster/templates/radio/CMakeLists.txt share/man/man1/muster.1.gz \
  share/bash-completion/completions/muster; do
  grep -qF " ./usr/$file" list || fail "muster lacks $file"
done
if grep -E '/include/|/cmake/|\.a$' list; then fail "muster holds what is of muster-dev"; fi
dpkg-deb -c "${dev[0]}" >list
for file in include/muster/plugin.h include/muster_kernel/kernel/simulation.hpp lib/muster/libmuster_kernel.a \
  lib/cmake/muster/muster-config.cmake lib/cmake/muster/exports.map; do
  grep -qF " ./usr/$file" list || fail "muster-dev lacks $file"
done
for package in "${python[@]}"; do
  needs=$(field "$package" Depends)
  for other in "muster (= $version)" 'python3 (<< 3.' python3-numpy libtbb; do
    grep -qF "$other" <<<"$needs" || fail "python3-muster does not depend on $other: $needs"
  done
  dpkg-deb -c "$package" >list
  for file in __init__.py gym.py py.typed _muster.cpython; do
    grep -qF " ./usr/lib/python3/dist-packages/muster/$file" list || fail "python3-muster lacks $file"
  done
  # Beside the program, `import muster` is enough.
  mkdir together
  dpkg-deb -x "${program[0]}" together
  dpkg-deb -x "$package" together
  PYTHONPATH=$PWD/together/usr/lib/python3/dist-packages /usr/bin/python3 -c '
import muster, sys
simulation = muster.Simulation(sys.argv[1], until=1)
simulation.run()
print(simulation.digest())' together/usr/share/muster/worlds/square_path >digest.txt
  grep -qF "$(cat digest.txt)" <(together/usr/bin/muster run together/usr/share/muster/worlds/square_path --until 1) ||
    fail "python3-muster: digest $(cat digest.txt), the program has another"
  if grep -rlF "$build" together; then fail "paths of the build are in python3-muster"; fi
done

# Stripped, and without a path of the build.
dpkg-deb -x "${program[0]}" root
if grep -rlF "$build" root; then fail "paths of the build are in the package"; fi
if readelf -S root/usr/bin/muster | grep -q '\.symtab'; then fail "muster is not stripped"; fi
if readelf -d root/usr/bin/muster root/usr/lib/muster/plugins/*.so | grep -E 'R(UN)?PATH'; then fail "a path to libraries is left"; fi
echo "packages: ${python[*]:-no python3-muster}; ${program[0]} $(du -k "${program[0]}" | cut -f1) kB, ${dev[0]} $(du -k "${dev[0]}" | cut -f1) kB"
