#!/usr/bin/env bash
# Installs a build into a scratch folder, moves that, and uses it as its user does: no file of the build or of the sources is opened.
# Each skeleton of `muster new` builds, passes its test and runs; so does a program that embeds the kernel.
# usage: installed.sh BUILD SOURCE CMAKE COMPILER
set -euo pipefail
build=$1 source=$2 cmake=$3 compiler=$4
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
unset MUSTER_PLUGIN_PATH
fail() { echo "installed: $*" >&2; exit 1; }

"$cmake" --install "$build" --prefix "$scratch/at first" >"$scratch/log" || { cat "$scratch/log"; exit 1; }
prefix="$scratch/moved here"
mv "$scratch/at first" "$prefix"
cd "$scratch"
muster=$prefix/bin/muster

# Its own plugins, and no others.
"$muster" plugins >list
grep -q '^radio\.multiwall/' list || fail "does not list its plugins: $(head -3 list)"
[[ $(grep -c '^[a-z0-9_]*\.[a-z0-9_]*/' list) -ge 60 ]] || fail "lists $(wc -l <list) plugins"
"$muster" describe radio.multiwall | grep -qF "from $prefix/lib/muster/plugins/radio_multiwall.so" || fail "takes a plugin from elsewhere"
# MUSTER_PLUGIN_PATH comes first.
mkdir own
cp "$prefix/lib/muster/plugins/radio_multiwall.so" own/
MUSTER_PLUGIN_PATH=$PWD/own "$muster" describe radio.multiwall | grep -qF "from $PWD/own/" || fail "MUSTER_PLUGIN_PATH does not come first"

# A world, its page, and an exam, which starts muster again, open nothing of the tree.
strace -f -qq -e trace=%file -o opened "$muster" run "$prefix/share/muster/worlds/connectivity" --until 1 --out out >run.txt
strace -f -qq -e trace=%file -o opened_too "$muster" exam make --generator run --mix clean --rows 300 400 --seed 1 --cases 1 --out exam >exam.txt
if grep -F -e "\"$build" -e "\"$source/" opened opened_too | grep -v ENOENT; then fail "opens files of the tree"; fi
[[ ! -f $build/viewer/page.html || -f out/run.html ]] || fail "wrote no page of the run"
for world in "$prefix"/share/muster/worlds/*/world.xml; do
  "$muster" check "$world" >check.txt || fail "$world: $(cat check.txt)"
done

# The package of Python, where the build has it: the program's digest, from its own plugins.
if [[ -d $prefix/lib/python3/dist-packages/muster ]]; then
  PYTHONPATH=$prefix/lib/python3/dist-packages PYTHONDONTWRITEBYTECODE=1 strace -f -qq -e trace=%file -o opened /usr/bin/python3 -c '
import muster, sys
simulation = muster.Simulation(sys.argv[1], until=1)
simulation.run()
print(simulation.digest())' "$prefix/share/muster/worlds/connectivity" >digest.txt
  grep -qF "digest $(cat digest.txt)" run.txt || fail "Python: digest $(cat digest.txt); the program: $(cat run.txt)"
  if grep -F -e "\"$build" -e "\"$source/" opened | grep -v ENOENT; then fail "Python opens files of the tree"; fi
fi

# What man and bash are given.
gzip -dc "$prefix/share/man/man1/muster.1.gz" | grep -q '^\.SH MUSTER diagnose$' || fail "the manual page lacks a verb"
if command -v man >/dev/null; then
  man --warnings=w -l "$prefix/share/man/man1/muster.1.gz" 2>warnings >page || true
  [[ ! -s warnings ]] || fail "the manual page: $(cat warnings)"
fi
bash -n "$prefix/share/bash-completion/completions/muster"

# Every kind, in one project.
{
  echo 'cmake_minimum_required(VERSION 3.25)'
  echo 'project(authors LANGUAGES CXX)'
  echo 'enable_testing()'
} >CMakeLists.txt
kinds=$(find "$prefix/share/muster/templates" -mindepth 1 -maxdepth 1 -type d -printf '%f\n' | sort)
for kind in $kinds; do
  "$muster" new "$kind" "my_$kind" >new.txt
  grep -q "^wrote my_$kind: CMakeLists.txt, README.md, " new.txt || fail "$(cat new.txt)"
  if grep -ri skeleton "my_$kind"; then fail "muster new $kind leaves the skeleton's name"; fi
  echo "add_subdirectory(my_$kind)" >>CMakeLists.txt
done
cp -r "$source/tests/install/embed" embed
echo 'add_subdirectory(embed)' >>CMakeLists.txt
"$cmake" -G Ninja -S . -B built -D CMAKE_BUILD_TYPE=Debug -D CMAKE_CXX_FLAGS=-O0 -D CMAKE_CXX_COMPILER="$compiler" \
  -D CMAKE_PREFIX_PATH="$prefix" >log || { cat log; exit 1; }
grep -q "muster_DIR:PATH=$prefix/lib/cmake/muster" built/CMakeCache.txt || fail "another muster was found"
"$cmake" --build built --parallel 1 >log || { cat log; exit 1; }
(cd built && "${cmake%cmake}ctest" --output-on-failure --no-tests=error >../tested) || { cat tested; exit 1; }
passed=$(grep -c ' Passed ' tested)
((passed == $(wc -w <<<"$kinds") + 1)) || fail "$passed tests passed: $(cat tested)"
for kind in $kinds; do
  "$muster" check "my_$kind/world.xml" --plugins built/plugins >check.txt || fail "my_$kind: $(cat check.txt)"
done
echo "installed: $(wc -l <list) plugins; $passed tests of authors passed"
