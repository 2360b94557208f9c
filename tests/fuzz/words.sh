#!/bin/sh
# The dictionary of the fuzzers: units, numbers and words of records from keys.dict, keys and words of scenes and
# studies from what the program says of them. Usage: words.sh PROGRAM
set -eu
cat "$(dirname "$0")/keys.dict"
{
  "$1" explain --keys | grep -xE '[a-z_0-9]+(\.[a-z_0-9]+)+' | sed 's/.*/"&"/'
  for schema in scene study; do "$1" explain --schema "$schema"; done | tr -cs 'a-z_.@"-' '\n' | grep -xE '"[a-z@][a-z_-]*"'
} | sort -u
