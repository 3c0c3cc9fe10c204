#!/bin/sh
# What the compiler says of a faulty plugin: compiler_words.sh COMPILER INCLUDE SOURCE
set -eu
said() {
  "$compiler" -std=c++17 -fsyntax-only -I"$include" "$@" "$source" 2>&1 || true
}
compiler=$1 include=$2 source=$3
expect() {  # words, then definitions
  words=$1
  shift
  if ! said "$@" | grep -qF "$words"; then
    echo "expected \"$words\" of $*, and the compiler says:"
    said "$@"
    exit 1
  fi
}

none=$(said)
if [ -n "$none" ]; then
  echo "of a plugin without a fault the compiler says: $none"
  exit 1
fi
expect 'a row type names its columns, one for each of its doubles, with units: struct State' -DNO_COLUMNS
real='real(name, default, min, max, unit, help): default, min and max are numbers without quotes'
expect "$real" '-DPARAM=muster::real("speed", "0.2", 0, 2, "m/s", "forward speed")'
expect "$real" '-DPARAM=muster::real("speed", 0.2, "m/s", 0, 2, "forward speed")'
expect "$real" '-DPARAM=muster::real("speed", 0.2, 0, "2", "m/s", "forward speed")'
expect 'integer(name, default, min, max, help): default, min and max are numbers without quotes' \
  '-DPARAM=muster::integer("retries", "3", 0, 9, "again")'
expect 'flag(name, default, help): the default is true or false without quotes' \
  '-DPARAM=muster::flag("loop", "false", "again")'
expect "a plugin's declarations are called params: static constexpr muster::Param params[] = {...};" -DPARAMS=parameters
