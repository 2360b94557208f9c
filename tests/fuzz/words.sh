#!/bin/sh
# What the fuzzers start from, by what the program says of itself. Usage: words.sh PROGRAM FOLDER
# words.dict, a dictionary: units, numbers and words of records from keys.dict, keys and words of scenes and studies.
# every_key.toml, a seed: every key of a scene with its example.
set -eu
{
  cat "$(dirname "$0")/keys.dict"
  {
    "$1" explain --keys | grep -xE '[a-z_0-9]+(\.[a-z_0-9]+)*' | sed 's/.*/"&"/'
    "$1" explain --keys | tr -cs 'a-z_.@"-' '\n' | grep -xE '"[a-z@][a-z_-]*"'
  } | sort -u
} > "$2/words.dict"
"$1" explain --keys | awk '
  /^[a-z_]+(\.[a-zA-Z_]+)*( |$)/ { key = $1 }
  sub(/^ .*such as /, "") { sub(/ \(units:.*/, ""); print key " = " $0 }' > "$2/every_key.toml"
